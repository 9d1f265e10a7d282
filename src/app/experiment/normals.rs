use serde::Deserialize;
use serde_json::json;

use super::surface::SurfaceSpec;
use super::{ConfigError, Document, ExperimentKind, RunError, Task, Yield};
use crate::app::measure::stopwatch::Stopwatch;
use crate::geometry::vector::{cross, dot, norm};
use crate::surface::edges::Edges;
use crate::surface::normals::{Facets, NormalSpec};

/// The kind of experiment that compares estimated normals of a digitised shape with exact ones.
pub(super) struct NormalsKind;

/// `[normals]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct EstimatorSpec {
    /// The estimator with its parameters.
    name: NormalSpec,
}

struct NormalsTask {
    surface: SurfaceSpec,
    estimator: NormalSpec,
}

impl ExperimentKind for NormalsKind {
    fn name(&self) -> &'static str {
        "normals"
    }

    fn description(&self) -> &'static str {
        "angles between estimated normals of a generated digital surface and the exact ones, in degrees"
    }

    fn tables(&self) -> &'static [&'static str] {
        &["surface", "normals"]
    }

    fn columns(&self) -> &'static [(&'static str, &'static str)] {
        &[
            ("result.surfels", "surfels"),
            ("result.angle.mean", "angle, mean"),
            ("result.angle.rms", "angle, rms"),
            ("result.angle.max", "angle, max"),
            ("timings.total", "seconds"),
        ]
    }

    fn task(&self, config: &Document) -> Result<Box<dyn Task>, ConfigError> {
        let EstimatorSpec { name } = config.table("normals")?;
        Ok(Box::new(NormalsTask { surface: SurfaceSpec::of(config)?, estimator: name }))
    }
}

impl Task for NormalsTask {
    fn run(&self) -> Result<Yield, RunError> {
        let input = self.surface.open()?;
        let exact = input.digital.as_ref().and_then(|digital| digital.exact_normals.as_ref());
        let exact = exact.ok_or_else(|| RunError::NoExactNormals { source_name: input.source.clone() })?;
        let mut watch = Stopwatch::start();
        let edges = Edges::new(&input.surface.faces, input.surface.positions.len());
        let facets = Facets::new(&input.surface, &edges, input.digital.as_ref())?;
        let normals = self.estimator.estimate(&facets)?;
        let seconds = watch.seconds().total;
        let (mut sum, mut squares, mut max) = (0.0, 0.0, 0.0f64);
        for (n, m) in normals.iter().zip(exact) {
            // Of small angles the cosine says little.
            let angle = norm(cross(*n, *m)).atan2(dot(*n, *m)).to_degrees();
            sum += angle;
            squares += angle * angle;
            max = max.max(angle);
        }
        let count = exact.len() as f64;
        Ok(Yield {
            result: json!({
                "source": input.source,
                "surfels": exact.len(),
                "angle": { "mean": sum / count, "rms": (squares / count).sqrt(), "max": max },
            }),
            timings: json!({ "total": seconds }),
            ..Yield::default()
        })
    }
}
