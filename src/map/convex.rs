//! Maps by convex combinations, and the dual vertices that a map of the mesh's own vertices leaves to be placed.

use num_complex::Complex64;

use super::{Boundary, Domain, Map, MapError, MapOptions, Valid};
use crate::constraint::Fixed;
use crate::distortion::{Validity, folded_faces};
use crate::energy::conformal;
use crate::solver::Observer;
use crate::solver::convex::{ConvexSolution, Towards, convex_map, edge_weights, outward};

/// The weights that are tried where rounding has spoiled the map by others.
const LAST_RESORT: &str = "outward";

/// Their parameters, in turn. Towards all, 0.1 suits fingers; where 3 boundary vertices bound 10⁴ vertices thousands of faces fold with it, and
/// none with 0.3. Towards one, rings of three vertices stay as large as they are.
const OUTWARD: [(Towards, f64); 7] = [
    (Towards::All, 0.1),
    (Towards::All, 0.3),
    (Towards::One, 0.3),
    (Towards::One, 0.1),
    (Towards::One, 1e-2),
    (Towards::One, 1e-3),
    (Towards::One, 1e-4),
];

impl MapOptions {
    /// The map under which every free vertex is the mean of its neighbours by these weights. Where the weights are positive and rounding
    /// has spoiled the map nevertheless, others take their place, unless `valid` is off.
    pub(super) fn convex(&self, name: &str, domain: &Domain, watch: &mut dyn Observer) -> Result<Map, MapError> {
        let row = edge_weights(name)?;
        let refused = |help| Err(MapError::WeightsOfNothing { name: name.to_owned(), help });
        match () {
            () if self.boundary != Boundary::Fixed => return refused("use --boundary fixed"),
            () if self.energy.is_some() => return refused("leave --energy out"),
            () if self.solver != "auto" => return refused("leave --solver out"),
            () => {}
        }
        let mut fixed = self.fixed(&domain.disc, &domain.graph)?;
        let first = convex_map(&domain.disc, &(row.make)(&domain.disc)?, &fixed, watch)?;
        let (solution, backend) = match row.convex && self.valid != Valid::Off {
            true => domain.first_accepted((first, row.name), &fixed, &mut |z| domain.is_one_to_one(z), watch)?,
            false => (first, row.name),
        };
        fixed.hold_dual_boundary(&domain.graph);
        let z = domain.with_dual_vertices(solution.z, &fixed);
        let h = conformal::weights(&domain.graph, self.weight).ok().map(|w| conformal::value(&domain.graph, &w, &z));
        Ok(Map {
            residual: Some(solution.residual),
            on_circle: self.fixed_on_circle(),
            repaired: backend != row.name,
            ..Map::solved(backend, z, fixed, h)
        })
    }
}

impl Domain {
    /// Of a map and those by outward weights the first one that is accepted, with its name; where none is, the map.
    pub(super) fn first_accepted(
        &self,
        first: (ConvexSolution, &'static str),
        fixed: &Fixed,
        accepts: &mut dyn FnMut(&[Complex64]) -> bool,
        watch: &mut dyn Observer,
    ) -> Result<(ConvexSolution, &'static str), MapError> {
        if accepts(&first.0.z) {
            return Ok(first);
        }
        for (towards, others) in OUTWARD {
            let solution = convex_map(&self.disc, &outward(&self.disc, towards, others), fixed, watch)?;
            if accepts(&solution.z) {
                return Ok((solution, LAST_RESORT));
            }
        }
        Ok(first)
    }

    /// Whether the map that puts the vertices of the mesh at `z` is one-to-one, exactly.
    pub fn is_one_to_one(&self, z: &[Complex64]) -> bool {
        self.validity(z).is_one_to_one()
    }

    /// The faces that fold in the map that puts the vertices of the mesh at `z`, as the domain numbers them.
    pub(super) fn folded(&self, z: &[Complex64]) -> Vec<u32> {
        folded_faces(&self.disc, |c| z[self.disc.faces.corners()[c] as usize])
    }

    /// The exact check of the map that puts the vertices of the mesh at `z`; what follows these, as dual vertices do, does not count.
    pub fn validity(&self, z: &[Complex64]) -> Validity {
        Validity::new(&self.disc, |c| z[self.disc.faces.corners()[c] as usize])
    }

    /// A map of the mesh's vertices made one of the quad graph's: dual vertices at the middle of their faces, those on the boundary where
    /// `fixed` has them, or on their edges.
    pub(crate) fn with_dual_vertices(&self, mut z: Vec<Complex64>, fixed: &Fixed) -> Vec<Complex64> {
        let graph = &self.graph;
        if graph.primal == graph.vertices {
            return z;
        }
        for polygon in self.disc.faces.iter() {
            let sum: Complex64 = polygon.iter().map(|&v| z[v as usize]).sum();
            z.push(sum / polygon.len() as f64);
        }
        z.resize(graph.vertices, Complex64::ZERO);
        let n = graph.boundary.len();
        for k in (0..n).filter(|&k| graph.is_dual(graph.boundary[k])) {
            let [before, after] = [(k + n - 1) % n, (k + 1) % n];
            let (l, m) = (graph.boundary_length[before], graph.boundary_length[k]);
            let [a, b] = [before, after].map(|k| z[graph.boundary[k] as usize]);
            let on_edge = (a * m + b * l) / (l + m);
            z[graph.boundary[k] as usize] = fixed.place(graph.boundary[k]).unwrap_or(on_edge);
        }
        z
    }
}
