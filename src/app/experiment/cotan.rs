use std::collections::BTreeMap;

use serde_json::json;

use super::surface::SurfaceSpec;
use super::{ConfigError, Document, ExperimentKind, RunError, Task, Yield};
use crate::app::compare::libigl::{Environment, Settings};
use crate::app::compare::verify::{CotanMap, compare};
use crate::app::measure::stopwatch::Stopwatch;
use crate::map::{self, Boundary, MapOptions};

/// The kind of experiment that compares system (2) with circumcentres to libigl's harmonic map of
/// the same mesh and boundary.
pub(super) struct CotanKind;

struct CotanTask {
    surface: SurfaceSpec,
}

impl ExperimentKind for CotanKind {
    fn name(&self) -> &'static str {
        "cotan"
    }

    fn description(&self) -> &'static str {
        "the map with circumcentres against libigl's harmonic map, and flips of both against barycentres"
    }

    fn tables(&self) -> &'static [&'static str] {
        &["surface"]
    }

    fn columns(&self) -> &'static [(&'static str, &'static str)] {
        &[
            ("result.vertices", "vertices"),
            ("result.negative_weights", "negative weights"),
            ("result.negative_share", "share"),
            ("result.difference", "largest difference"),
            ("result.flipped.cotan", "flipped, cotan"),
            ("result.flipped.barycentre", "flipped, barycentres"),
            ("timings.riemap", "riemap, s"),
            ("timings.libigl", "libigl, s"),
            ("timings.ratio", "riemap / libigl"),
        ]
    }

    fn task(&self, config: &Document) -> Result<Box<dyn Task>, ConfigError> {
        Ok(Box::new(CotanTask { surface: SurfaceSpec::of(config)? }))
    }
}

impl Task for CotanTask {
    fn run(&self) -> Result<Yield, RunError> {
        let input = self.surface.open()?;
        let libigl = Environment::with(&Settings::from_variables())?;
        let with_dual =
            |dual: &str| MapOptions { boundary: Boundary::FIXED, dual: dual.to_owned(), ..MapOptions::default() };
        let mut watch = Stopwatch::start();
        let ours = map::map_input(&input, &with_dual("circumcentre"), &mut watch)?;
        let seconds = watch.seconds();
        // What libigl is timed for: matrices and solution.
        let riemap = seconds.of_the_map();
        let flipped = ours.distortion.flipped;
        let residual = ours.map.residual;
        let comparison = compare(&CotanMap { disc: ours.domain.disc, map: ours.map }, &libigl)?;
        let barycentres = map::map_input(&input, &with_dual("barycentre"), &mut watch)?;
        let libigl = comparison.libigl.seconds_wall;
        Ok(Yield {
            result: json!({
                "source": input.source,
                "vertices": comparison.vertices,
                "interior_edges": comparison.interior_edges,
                "negative_weights": comparison.negative_weights,
                "negative_share": comparison.negative_weights as f64 / comparison.interior_edges.max(1) as f64,
                "difference": comparison.difference,
                "backend": comparison.backend,
                "residual": residual,
                "flipped": { "cotan": flipped, "barycentre": barycentres.distortion.flipped },
            }),
            timings: json!({ "riemap": riemap, "libigl": libigl, "ratio": riemap / libigl }),
            versions: BTreeMap::from([("libigl".to_owned(), comparison.libigl.version)]),
            pictures: Vec::new(),
        })
    }
}
