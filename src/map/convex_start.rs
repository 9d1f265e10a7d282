//! Convex combination maps that pass the exact check: starts for energies that are +∞ where a face is flipped.

use num_complex::Complex64;

use super::{Domain, MapError};
use crate::constraint::Fixed;
use crate::solver::Observer;
use crate::solver::convex::{ConvexSolution, Towards, convex_map, edge_weights, outward};

/// The name of the weights that are tried if rounding has spoiled the map by others.
const LAST_RESORT: &str = "outward";

/// The parameters of these weights, tried in turn.
///
/// # Rationale
/// Towards all nearer neighbours, 0.1 suits fingers; if 3 boundary vertices bound 10⁴ vertices, it flips thousands of
/// faces and 0.3 none. Towards one neighbour, rings of three vertices keep their size.
const OUTWARD: [(Towards, f64); 7] = [
    (Towards::All, 0.1),
    (Towards::All, 0.3),
    (Towards::One, 0.3),
    (Towards::One, 0.1),
    (Towards::One, 1e-2),
    (Towards::One, 1e-3),
    (Towards::One, 1e-4),
];

impl Domain {
    /// Returns the first map that is accepted among `first` and those with outward weights, and its name; `first` if
    /// none is accepted.
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

    /// Computes a convex combination map that is bijective by exact predicates; returns the images of the mesh vertices.
    ///
    /// Mean-value, outward and uniform weights are tried in turn. The result is the first bijective map that `suits`,
    /// or else the first bijective one.
    ///
    /// # Errors
    /// No such map is found: the boundary is not pinned on a convex curve, double precision does not suffice, or two
    /// quads share two edges.
    pub(super) fn convex_start(
        &self,
        fixed: &Fixed,
        suits: &dyn Fn(&[Complex64]) -> bool,
        watch: &mut dyn Observer,
    ) -> Result<Vec<Complex64>, MapError> {
        let doublets = self.doublets();
        if let Some(&first) = doublets.first() {
            return Err(MapError::NoConvexQuads {
                vertex: self.disc.source_vertex[first as usize],
                count: doublets.len(),
            });
        }
        let mut spare = None;
        let mut accepts = |z: &[Complex64]| {
            let is_one_to_one = self.is_one_to_one(z);
            let is_accepted = is_one_to_one && suits(z);
            if is_one_to_one && !is_accepted && spare.is_none() {
                spare = Some(z.to_vec());
            }
            is_accepted
        };
        let map_by = |name: &str, watch: &mut dyn Observer| {
            let weights = edge_weights(name).and_then(|row| (row.make)(&self.disc))?;
            convex_map(&self.disc, &weights, fixed, watch)
        };
        let (first, name) = match map_by("mean-value", watch) {
            Ok(solution) => (solution, "mean-value"),
            // If an angle is 0 or π, only weights that do not depend on geometry are left.
            Err(_) => (map_by("uniform", watch)?, "uniform"),
        };
        let (solution, _) = self.first_accepted((first, name), fixed, &mut accepts, watch)?;
        if accepts(&solution.z) {
            return Ok(solution.z);
        }
        // Uniform weights come last: they shrink the interior most if the boundary is short.
        if name != "uniform" {
            let uniform = map_by("uniform", watch)?;
            if accepts(&uniform.z) {
                return Ok(uniform.z);
            }
        }
        if let Some(z) = spare {
            return Ok(z);
        }
        let folded = self.validity(&solution.z).folded;
        let smallest = self.smallest_edge(&solution.z);
        Err(MapError::NoValidStart { folded: folded.len(), first: folded.first().copied(), smallest })
    }

    /// Returns the inner vertices of a quad mesh with two faces: under every map one of the two has an angle of at least
    /// π there.
    fn doublets(&self) -> Vec<u32> {
        if self.is_of_triangles() {
            return Vec::new();
        }
        let mut faces = vec![0u32; self.disc.positions.len()];
        self.disc.faces.corners().iter().for_each(|&v| faces[v as usize] += 1);
        self.disc.boundary.iter().for_each(|&v| faces[v as usize] = u32::MAX);
        (0..faces.len() as u32).filter(|&v| faces[v as usize] == 2).collect()
    }

    /// Returns the length of the shortest edge of an image, relative to its extent.
    fn smallest_edge(&self, z: &[Complex64]) -> f64 {
        let faces = &self.disc.faces;
        let edges = faces.iter().flat_map(|f| (0..f.len()).map(|k| [f[k], f[(k + 1) % f.len()]]));
        let shortest = edges.map(|[a, b]| (z[b as usize] - z[a as usize]).norm()).fold(f64::INFINITY, f64::min);
        let extent = z.iter().map(|&w| (w - z[0]).norm()).fold(0.0, f64::max);
        shortest / extent
    }
}
