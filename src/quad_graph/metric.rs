//! Rest lengths, areas and triangles, with which energies compare a map.

use super::dual::DualPoint;
use super::triangles::{RestTriangle, rest_triangles};
use super::{QuadGraph, QuadGraphError, RestSource, TangentPlanes, difference};
use crate::geometry::vector::{cross, norm};
use crate::surface::edges::Edges;
use crate::surface::oriented_mesh::OrientedMesh;

/// Lengths and areas at rest, in the unit of the positions.
///
/// The edges are those of the quad graph. On a triangle mesh these join each vertex to the dual
/// points around it, measured within the faces; boundary edges are halved.
#[derive(Clone, Debug, PartialEq)]
pub struct RestMetric {
    /// The edges of the quad graph (`ne × 2`).
    pub edges: Vec<[u32; 2]>,
    /// The lengths of the edges (`ne`).
    pub length: Vec<f64>,
    /// Half of the total area of the quads at each edge (`ne`).
    pub area: Vec<f64>,
    /// ½ (|(v3−v0)×(v2−v0)| + |(v2−v0)×(v1−v0)|) of each quad (`nf`): the area of the quad folded
    /// along d02.
    pub folded_area: Vec<f64>,
    /// The triangles of the mesh, or of the corners of its quads.
    pub triangles: Vec<RestTriangle>,
}

impl RestMetric {
    /// Makes the metric of a quad mesh, with lengths in R³ or as `planes` specify; these must be
    /// the planes of the graph.
    pub fn of_quads(disc: &OrientedMesh, graph: &QuadGraph, planes: Option<&TangentPlanes>) -> Self {
        let edges = Edges::new(&disc.faces, disc.positions.len());
        let projected = planes.filter(|planes| planes.rest == RestSource::Projected);
        let folded_area: Vec<f64> = (0..graph.quads.len())
            .map(|q| {
                let [d1, d2, d3] = [1, 2, 3].map(|k| {
                    let d = disc.spoke(q, 0, k);
                    projected.map_or(d, |planes| planes.project(q, d))
                });
                0.5 * (norm(cross(d3, d2)) + norm(cross(d2, d1)))
            })
            .collect();
        let quads = |e: usize| edges.corners(e).iter().map(|&c| edges.face_of_corner[c as usize] as usize);
        // The areas that weight a quad's edges; projected areas are consistent with ρ.
        let area_of = |q: usize| match planes {
            Some(TangentPlanes { rest: RestSource::Unit, .. }) => folded_area[q],
            _ => graph.area(q),
        };
        let length = |e: usize| {
            let [a, b] = edges.ends[e];
            let d = difference(&disc.positions, a, b);
            match projected {
                None => disc.edge_length(edges.corners(e), &edges.face_of_corner),
                Some(planes) => quads(e).map(|q| planes.length(q, d)).sum::<f64>() / edges.corners(e).len() as f64,
            }
        };
        RestMetric {
            length: (0..edges.len()).map(length).collect(),
            area: (0..edges.len()).map(|e| quads(e).map(|q| 0.5 * area_of(q)).sum()).collect(),
            folded_area,
            edges: edges.ends,
            triangles: rest_triangles(disc, planes, false),
        }
    }

    /// The area of the surface.
    pub fn surface_area(&self) -> f64 {
        self.triangles.iter().map(|t| t.area).sum()
    }

    /// Replaces triangles without area at corners of quads: those with angle 0 or π, or with an
    /// edge of length zero.
    #[must_use]
    pub fn with_open_corners(self, disc: &OrientedMesh, planes: Option<&TangentPlanes>) -> Self {
        match disc.faces.arity() {
            Some(4) => RestMetric { triangles: rest_triangles(disc, planes, true), ..self },
            _ => self,
        }
    }

    /// Makes the metric of the quad graph of a triangle mesh, with the same dual points.
    ///
    /// # Errors
    /// Errors of [`QuadGraph::from_triangles`].
    pub fn of_triangles(disc: &OrientedMesh, graph: &QuadGraph, dual: &dyn DualPoint) -> Result<Self, QuadGraphError> {
        let placed = super::from_triangles::place_dual_points(disc, dual, |_, _| ())?;
        let edges = Edges::new(&disc.faces, disc.positions.len());
        let vertex = disc.faces.corners();
        let corners = vertex.len();
        let mut metric = RestMetric {
            edges: Vec::with_capacity(corners + graph.boundary.len()),
            length: Vec::with_capacity(corners + graph.boundary.len()),
            area: Vec::with_capacity(corners + graph.boundary.len()),
            folded_area: vec![0.0; graph.quads.len()],
            triangles: rest_triangles(disc, None, false),
        };
        for f in 0..disc.faces.len() {
            let range = disc.faces.corner_range(f);
            for c in range.clone() {
                // The edge from the vertex at c to the dual point of the face lies between the
                // quads of the two mesh edges that meet at the vertex.
                let before = if c == range.start { range.end - 1 } else { c - 1 };
                let quads = [c, before].map(|c| edges.of_corner[c] as usize);
                let length = graph.diagonal[quads[0]];
                let (s, h) = placed[c];
                metric.edges.push([vertex[c], (disc.positions.len() + f) as u32]);
                metric.length.push(length * s.hypot(h));
                metric.area.push(0.5 * (graph.area(quads[0]) + graph.area(quads[1])));
                metric.folded_area[quads[0]] += 0.5 * h.abs() * length * length;
            }
        }
        let n = graph.boundary.len();
        let mut quad_of_boundary = vec![0; disc.positions.len()];
        for e in 0..edges.len() {
            if let &[c] = edges.corners(e) {
                quad_of_boundary[vertex[c as usize] as usize] = e;
            }
        }
        for k in 0..n {
            // Mesh vertices and dual vertices alternate; both halves belong to the quad of the mesh
            // edge.
            let mesh_vertex = graph.boundary[k - k % 2];
            metric.edges.push([graph.boundary[k], graph.boundary[(k + 1) % n]]);
            metric.length.push(graph.boundary_length[k]);
            metric.area.push(0.5 * graph.area(quad_of_boundary[mesh_vertex as usize]));
        }
        Ok(metric)
    }
}
