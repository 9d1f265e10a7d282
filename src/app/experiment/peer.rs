use std::collections::BTreeMap;

use num_complex::Complex64;
use serde::Deserialize;
use serde_json::json;

use super::map::untimed;
use super::surface::SurfaceSpec;
use super::{ConfigError, Document, ExperimentKind, RunError, Task, Yield};
use crate::app::compare::libigl::{Environment, Settings};
use crate::app::compare::moebius_fit::fitted;
use crate::app::compare::peer::{Moebius, PEERS, peer};
use crate::app::measure::stopwatch::Stopwatch;
use crate::constraint::spread_points;
use crate::energy::conformal::Weight;
use crate::map::{self, MapError, MapOptions, Mapped};
use crate::quad_graph::dual::DUAL_POINTS;
use crate::report::{ErrorRecord, Report};

/// A surface mapped by Riemap with a dual point, or by a peer; both maps are measured in the same
/// way.
pub(super) struct PeerKind;

/// The method that leaves everything to `[map]`.
const OURS: &str = "riemap";

/// `[method]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct MethodSpec {
    /// `riemap`, which leaves the dual point to `[map]`; a dual point; or a peer.
    name: String,
}

struct PeerTask {
    surface: SurfaceSpec,
    options: MapOptions,
    method: String,
}

impl ExperimentKind for PeerKind {
    fn name(&self) -> &'static str {
        "peer"
    }

    fn description(&self) -> &'static str {
        "a map of ours, or with one of our dual points, or a map of another program, both measured by the same code; \
         `error` after a Möbius map through three boundary points, `aligned` after the best one"
    }

    fn tables(&self) -> &'static [&'static str] {
        &["surface", "map", "method"]
    }

    fn columns(&self) -> &'static [(&'static str, &'static str)] {
        &[
            ("result.input.vertices", "vertices"),
            ("result.weight", "weights"),
            ("result.distortion.quasi_conformal.mean", "σ₁/σ₂, mean"),
            ("result.distortion.quasi_conformal.p99", "σ₁/σ₂, 99 %"),
            ("result.distortion.flipped", "flipped"),
            ("result.distortion.boundary_out_of_order", "out of order"),
        ]
    }

    fn task(&self, config: &Document) -> Result<Box<dyn Task>, ConfigError> {
        let MethodSpec { name } = config.table("method")?;
        let peers = PEERS.iter().map(|p| p.name);
        let known: Vec<&str> = [OURS].into_iter().chain(DUAL_POINTS.iter().map(|d| d.name())).chain(peers).collect();
        config.check_name("method.name", "dual point or peer", &name, &known)?;
        let mut options: MapOptions = config.table("map")?;
        if name != OURS {
            options.dual = name.clone();
        }
        Ok(Box::new(PeerTask { surface: SurfaceSpec::of(config)?, options, method: name }))
    }
}

impl Task for PeerTask {
    fn run(&self) -> Result<Yield, RunError> {
        let mut watch = Stopwatch::start();
        let input = self.surface.open()?;
        let mut versions = BTreeMap::new();
        let (mapped, weight, seconds) = match peer(&self.method) {
            Some(peer) => {
                let libigl = Environment::with(&Settings::from_variables())?;
                let (mapped, seconds) = peer.map(&input, self.options.opening(), &libigl, &mut watch)?;
                versions.insert("libigl".to_owned(), libigl.versions.libigl.clone());
                (mapped, None, seconds)
            }
            None => {
                let mut options = self.options.clone();
                let mut mapped = map::map_input(&input, &options, &mut watch);
                // Integral weights do not exist where Re ρ ≤ 0, as circumcentres make it; the paper's do. The record says so.
                if mapped.as_ref().is_err_and(MapError::is_of_integral_weights) {
                    options.weight = Weight::Unit;
                    mapped = map::map_input(&input, &options, &mut watch);
                }
                let seconds = watch.seconds();
                (mapped?, Some(options.weight), seconds.of_the_map())
            }
        };
        let mut result = untimed(Report::new(&input, &mapped, watch.cost()))?;
        result["weight"] = json!(weight);
        if let Some(exact) = input.exact.as_ref().filter(|_| mapped.map.on_circle) {
            let [error, aligned] = errors(exact, mapped)?;
            result["error"] = json!(error);
            result["aligned"] = json!(aligned);
        }
        Ok(Yield { result, timings: json!({ "solve": seconds }), versions, ..Yield::default() })
    }
}

/// Distances to the exact map: after the Möbius map through the three boundary points that our maps
/// hold, which moves these by rounding alone; and after that which makes the mean square least.
fn errors(exact: &[[f64; 2]], mut mapped: Mapped) -> Result<[ErrorRecord; 2], RunError> {
    let w: Vec<Complex64> = exact.iter().map(|&[x, y]| Complex64::new(x, y)).collect();
    let (disc, graph) = (&mapped.domain.disc, &mapped.domain.graph);
    let z = mapped.map.z.clone();
    let pairs: Vec<(Complex64, Complex64)> =
        disc.source_vertex.iter().zip(&z).filter_map(|(&v, &z)| Some((z, *w.get(v as usize)?))).collect();
    let (ours, theirs): (Vec<Complex64>, Vec<Complex64>) = pairs.into_iter().unzip();
    let mut held = [(Complex64::ZERO, Complex64::ZERO); 3];
    for (pair, k) in held.iter_mut().zip(spread_points(graph, 3)) {
        let v = graph.boundary[k] as usize;
        *pair = (z[v], w[disc.source_vertex[v] as usize]);
    }
    let through = Moebius::through(held.map(|(z, _)| z), held.map(|(_, w)| w))?;
    let fitted = fitted(through, &ours, &theirs)?;
    let mut record = |moebius: Moebius| {
        mapped.map.z = z.iter().map(|&z| moebius.at(z)).collect();
        ErrorRecord::new(exact, &mapped.domain.disc, &mapped.map)
    };
    Ok([record(through), record(fitted)])
}
