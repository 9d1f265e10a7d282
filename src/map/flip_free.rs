//! What energies of maps without folds, +∞ elsewhere, need beside the others: a start without folds, a gauge, and a place for the dual
//! vertices that they do not see.

use num_complex::Complex64;

use super::{Boundary, Domain, MapError, MapOptions};
use crate::constraint::{Fixed, on_circle, spread_points};
use crate::energy::conformal::Weight;
use crate::energy::{Energy, Expression};
use crate::quad_graph::QuadGraph;
use crate::quad_graph::metric::RestMetric;
use crate::solver::Observer;
use crate::solver::convex::{convex_map, edge_weights};

/// Whether the energy is +∞ where faces fold.
pub(super) fn is_flip_free(expression: &Expression) -> bool {
    expression.rows().any(|row| row.flip_free)
}

/// A map without folds: every inner vertex a mean of its neighbours, the boundary where a fixed one is held, else on a circle by arc
/// length between `anchors`; of the surface's area where the energy sees lengths or areas, of radius 1 where it does not.
pub(super) fn start(
    options: &MapOptions,
    expression: &Expression,
    domain: &Domain,
    metric: &RestMetric,
    anchors: &[(usize, f64)],
    watch: &mut dyn Observer,
) -> Result<Vec<Complex64>, MapError> {
    let graph = &domain.graph;
    let fixed = match options.boundary {
        Boundary::Fixed => options.fixed(&domain.disc, graph)?,
        _ => on_circle(graph, 1.0, if anchors.is_empty() { &[(0, 0.0)] } else { anchors })?,
    };
    let z = domain.convex_start(&fixed, &|_| true, watch)?;
    let mut z = domain.with_dual_vertices(z, &fixed);
    if options.boundary != Boundary::Fixed && !expression.has("C") && expression.rows().any(|row| row.metric) {
        let scale = (area_at_rest(metric) / image_area(graph, &z)).sqrt();
        z.iter_mut().for_each(|z| *z *= scale);
    }
    Ok(z)
}

impl Domain {
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

/// The signed area inside the boundary of the image.
pub(super) fn image_area(graph: &QuadGraph, z: &[Complex64]) -> f64 {
    let next = graph.boundary.iter().cycle().skip(1);
    let pairs = graph.boundary.iter().zip(next);
    pairs.map(|(&v, &w)| 0.5 * (z[v as usize].conj() * z[w as usize]).im).sum()
}

/// The area of the surface.
pub(super) fn area_at_rest(metric: &RestMetric) -> f64 {
    metric.triangles.iter().map(|t| t.area).sum()
}

/// The factor on energies that see shapes alone, and weigh them by areas at rest: what the image's area is to that of the surface, so that
/// they are of one unit with the others. 1 where these see lengths or areas, and the two areas are nearly the same.
pub(super) fn unit_of_shapes(
    options: &MapOptions,
    expression: &Expression,
    graph: &QuadGraph,
    metric: &RestMetric,
    z: &[Complex64],
) -> f64 {
    let integral = options.weight == Weight::Integral;
    let free = expression.rows().any(|row| row.metric) && options.boundary != Boundary::Fixed;
    if integral && !free { image_area(graph, z) / area_at_rest(metric) } else { 1.0 }
}

/// Holds what rigid motions leave free where no other gauge does (energies of lengths), or similarities (of angles alone): the first
/// boundary vertex and the direction to the next one of the mesh, or two boundary vertices opposite each other.
pub(super) fn hold_gauge(fixed: &mut Fixed, expression: &Expression, graph: &QuadGraph, z: &[Complex64]) {
    let at = |v: u32| z[v as usize];
    if expression.rows().any(|row| row.metric) {
        let mut mesh = graph.boundary.iter().copied().filter(|&v| !graph.is_dual(v));
        if let (Some(first), Some(next)) = (mesh.next(), mesh.next()) {
            fixed.hold(first, at(first));
            // From where the vertex is: then it stays there exactly.
            fixed.hold_on_line(next, at(next), at(next) + (at(next) - at(first)));
        }
    } else {
        for k in spread_points(graph, 2) {
            fixed.hold(graph.boundary[k], at(graph.boundary[k]));
        }
    }
}

/// Holds the vertices that none of the energies sees where they are, and names them.
pub(super) fn hold_unseen(fixed: &mut Fixed, energies: &[(f64, Box<dyn Energy>)], z: &[Complex64]) -> Vec<u32> {
    let mut seen = vec![false; z.len()];
    for (_, energy) in energies {
        for &v in &energy.stencils().vertices {
            seen[v as usize] = true;
        }
    }
    let unseen: Vec<u32> = (0..z.len() as u32).filter(|&v| !seen[v as usize] && !fixed.holds(v)).collect();
    for &v in &unseen {
        fixed.hold(v, z[v as usize]);
    }
    unseen
}
