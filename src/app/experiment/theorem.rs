use std::f64::consts::TAU;

use num_complex::Complex64;
use serde_json::json;

use super::surface::SurfaceSpec;
use super::{ConfigError, Document, ExperimentKind, RunError, Task, Yield};
use crate::laplacian::ConformalLaplacian;
use crate::map::{self, Boundary, MapOptions, Valid};
use crate::report::ErrorRecord;
use crate::solver::Silent;
use crate::solver::boundary::{self, BoundaryError, CirclePin, Linearised, singular_values};

/// The kind of experiment that computes the circle map with H = 0 and the conditioning of its
/// equations.
pub(super) struct TheoremKind;

struct TheoremTask {
    surface: SurfaceSpec,
    options: MapOptions,
}

impl ExperimentKind for TheoremKind {
    fn name(&self) -> &'static str {
        "theorem"
    }

    fn description(&self) -> &'static str {
        "the circle map with H = 0: ε, and singular values of its equations with two and three points, with and without ε"
    }

    fn tables(&self) -> &'static [&'static str] {
        &["surface", "map"]
    }

    fn columns(&self) -> &'static [(&'static str, &'static str)] {
        &[
            ("result.boundary", "black boundary vertices"),
            ("result.epsilon", "ε"),
            ("result.epsilon_by_h2", "ε/h²"),
            ("result.error.max", "distance, max"),
            ("result.three_with_epsilon.least", "σ min: three points and ε"),
            ("result.three.least", "three points"),
            ("result.two_with_epsilon.least", "two points and ε"),
            ("result.two.least", "two points"),
            ("result.two.next", "two points, the next σ"),
        ]
    }

    fn task(&self, config: &Document) -> Result<Box<dyn Task>, ConfigError> {
        let options: MapOptions = config.table("map")?;
        let options =
            MapOptions { boundary: Boundary::CIRCLE, valid: Valid::Off, solver: boundary::NAME.into(), ..options };
        Ok(Box::new(TheoremTask { surface: SurfaceSpec::of(config)?, options }))
    }
}

impl Task for TheoremTask {
    fn run(&self) -> Result<Yield, RunError> {
        let input = self.surface.open()?;
        let mapped = map::map_input(&input, &self.options, &mut Silent)?;
        let (graph, map) = (&mapped.domain.graph, &mapped.map);
        let laplacian =
            ConformalLaplacian::new(graph, || ()).map_err(|error| map::MapError::from(BoundaryError::from(error)))?;
        let epsilon = map.epsilon.unwrap_or_default();
        // Maps of triangle meshes are written with their black boundary on the unit circle.
        let scale = if graph.primal < graph.vertices { (1.0 + epsilon).sqrt() } else { 1.0 };
        let at = |&v: &u32| scale * map.z[v as usize];
        let b: Vec<Complex64> = laplacian.black_boundary().iter().map(at).collect();
        let w: Vec<Complex64> = laplacian.white_boundary().iter().map(at).collect();
        let n = b.len();
        let w_0 = w.iter().sum::<Complex64>() / n as f64;
        let pinned = graph.boundary.iter().enumerate();
        let pins: Vec<CirclePin> = pinned
            .filter_map(|(position, &v)| Some(CirclePin { position, angle: map.fixed.place(v)?.arg() }))
            .collect();
        // The two smallest.
        let singular = |count: usize, with_epsilon: bool| {
            let pins = &pins[..count.min(pins.len())];
            let values = singular_values(&laplacian, graph, Linearised { b: &b, w_0, pins, with_epsilon });
            let mut last = values.iter().rev();
            json!({ "least": last.next(), "next": last.next() })
        };
        let off = |points: &[Complex64], square: f64| {
            points.iter().map(|z| (z.norm_sqr() - square).abs()).fold(0.0, f64::max)
        };
        // The mean distance of black boundary points on the circle.
        let h = TAU / n as f64;
        Ok(Yield {
            result: json!({
                "source": input.source,
                "vertices": laplacian.inner().len() + n,
                "boundary": n,
                "iterations": map.iterations,
                "epsilon": epsilon.abs(),
                "epsilon_by_h2": epsilon.abs() / (h * h),
                "residual": laplacian.residual(graph, &map.z),
                "circles": off(&b, 1.0 + epsilon).max(off(&w, 1.0 - epsilon)),
                "error": input.exact.as_ref().map(|exact| ErrorRecord::new(exact, &mapped.domain.disc, map)),
                "three_with_epsilon": singular(3, true),
                "three": singular(3, false),
                "two_with_epsilon": singular(2, true),
                "two": singular(2, false),
            }),
            ..Yield::default()
        })
    }
}
