//! The meshes, and their maps to evaluate at.

use std::fmt;

use num_complex::Complex64;
use riemap::constraint::{Fixed, Freedoms};
use riemap::energy::conformal::{Dirichlet, Weight};
use riemap::energy::{EnergyKind, Rest, energy};
use riemap::input::Input;
use riemap::map::{Boundary, MapOptions, Mapped, map_input};
use riemap::problem::nonlinear::Objective;
use riemap::quad_graph::metric::RestMetric;
use riemap::solver::Silent;

/// A mesh by the vertices along a side.
#[derive(Clone, Copy)]
pub struct Mesh {
    kind: &'static str,
    side: usize,
}

/// All of them; where cargo tests that the benchmarks run, not how fast they are, the small ones.
pub fn meshes() -> Vec<Mesh> {
    let measures = std::env::args().any(|argument| argument == "--bench");
    let sides: &[usize] = if measures { &[100, 316] } else { &[16] };
    ["quad", "delaunay"].into_iter().flat_map(|kind| sides.iter().map(move |&side| Mesh { kind, side })).collect()
}

impl fmt::Display for Mesh {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{} {}", self.kind, self.side * self.side)
    }
}

impl Mesh {
    pub fn input(self) -> Input {
        let Mesh { kind, side } = self;
        Input::open(&format!("graph:cos+cos?n={side}&mesh={kind}")).expect("a generated surface")
    }

    /// Its free map, which is near an isometry.
    pub fn mapped(self) -> Mapped {
        let options = MapOptions { boundary: Boundary::FREE, ..MapOptions::default() };
        map_input(&self.input(), &options, &mut Silent).expect("a graph over a square has a free map")
    }
}

/// Energies of these names with coefficient 1, the boundary held where the map has it, and the map as unknowns.
pub fn objective(mapped: &Mapped, names: &[&str]) -> (Objective, Vec<f64>) {
    let (graph, z) = (&mapped.domain.graph, &mapped.map.z);
    let metric: RestMetric = mapped.domain.rest_metric(&MapOptions::default()).expect("faces that have areas");
    let mut fixed = Fixed::default();
    graph.boundary.iter().for_each(|&v| fixed.hold(v, z[v as usize]));
    let held: Vec<bool> = (0..graph.vertices as u32).map(|v| fixed.holds(v)).collect();
    let rest = Rest { graph, metric: &metric, weight: Weight::Integral, held: &held };
    let make = |name: &&str| (1.0, energy(name).expect(name).make(rest).expect(name));
    let freedoms = Freedoms::new(graph.vertices, &fixed);
    let objective =
        Objective { terms: names.iter().map(make).collect(), freedoms, norm: Dirichlet::new(graph, Weight::Integral) };
    let y = objective.freedoms.restrict(z);
    (objective, y)
}

/// Values on the boundary with all frequencies in them.
pub fn rough(n: usize) -> Vec<Complex64> {
    (0..n).map(|k| Complex64::cis((k * k) as f64)).collect()
}
