//! Convex combination maps that pass the exact check: starts for energies that are +∞ where a face is flipped.

use num_complex::Complex64;

use super::{Domain, MapError};
use crate::constraint::Fixed;
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

    /// The vertices of the mesh under a convex combination map that is one-to-one, exactly: of those by mean-value weights, by outward
    /// ones, by uniform ones the first that `suits`, else the first.
    ///
    /// # Errors
    /// None is: the boundary is held on no convex curve, double precision does not suffice, or two quads share two edges.
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
            // Where an angle is 0 or π weights that see no geometry are left.
            Err(_) => (map_by("uniform", watch)?, "uniform"),
        };
        let (solution, _) = self.first_accepted((first, name), fixed, &mut accepts, watch)?;
        if accepts(&solution.z) {
            return Ok(solution.z);
        }
        // Weights that see no geometry last: they are drawn outward nowhere, and least where the boundary is short.
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

    /// The vertices inside a quad mesh that have two faces: an angle of one of them is π at least under every map.
    fn doublets(&self) -> Vec<u32> {
        if self.is_of_triangles() {
            return Vec::new();
        }
        let mut faces = vec![0u32; self.disc.positions.len()];
        self.disc.faces.corners().iter().for_each(|&v| faces[v as usize] += 1);
        self.disc.boundary.iter().for_each(|&v| faces[v as usize] = u32::MAX);
        (0..faces.len() as u32).filter(|&v| faces[v as usize] == 2).collect()
    }

    /// The shortest edge of an image over its extent.
    fn smallest_edge(&self, z: &[Complex64]) -> f64 {
        let faces = &self.disc.faces;
        let edges = faces.iter().flat_map(|f| (0..f.len()).map(|k| [f[k], f[(k + 1) % f.len()]]));
        let shortest = edges.map(|[a, b]| (z[b as usize] - z[a as usize]).norm()).fold(f64::INFINITY, f64::min);
        let extent = z.iter().map(|&w| (w - z[0]).norm()).fold(0.0, f64::max);
        shortest / extent
    }
}
