//! A part of a domain with a quad graph of its own: the map may change inside and is pinned around it.

use std::collections::HashMap;

use num_complex::Complex64;

use crate::constraint::Fixed;
use crate::energy::Rest;
use crate::energy::conformal::Weight;
use crate::map::Domain;
use crate::quad_graph::metric::RestMetric;
use crate::quad_graph::{QuadGraph, triangles_of_face};
use crate::sparse::Lists;

/// Some faces of a domain, with vertices numbered anew: first those of the mesh, then dual ones.
pub(super) struct Patch {
    /// The index in the domain of each vertex.
    pub vertices: Vec<u32>,
    /// Whether each vertex is pinned.
    pub held: Vec<bool>,
    /// The quads with a vertex that is not pinned. Its boundary is the part of the domain's boundary in the patch,
    /// one arc after the other; it is not a loop.
    pub graph: QuadGraph,
    /// The triangles with a vertex that is not pinned; all else is empty.
    pub metric: RestMetric,
    /// The index in `faces` of the face of each triangle.
    pub face_of_triangle: Vec<u32>,
    /// The boundary edges of the quad graph in the patch.
    pub edges: Vec<[u32; 2]>,
    /// The boundary edges of the mesh in the patch.
    pub mesh_edges: Vec<[u32; 2]>,
    /// Their rest lengths.
    pub mesh_lengths: Vec<f64>,
    /// The faces of the domain in the patch, ascending.
    pub faces: Vec<u32>,
}

/// The faces at every vertex of a mesh.
pub(super) struct FacesAt {
    offsets: Vec<u32>,
    faces: Vec<u32>,
}

impl FacesAt {
    pub fn new(domain: &Domain) -> Self {
        let faces = &domain.disc.faces;
        let mut offsets = vec![0u32; domain.disc.positions.len() + 1];
        faces.corners().iter().for_each(|&v| offsets[v as usize + 1] += 1);
        for v in 1..offsets.len() {
            offsets[v] += offsets[v - 1];
        }
        let (mut cursor, mut at) = (offsets.clone(), vec![0; faces.corners().len()]);
        for (f, polygon) in faces.iter().enumerate() {
            for &v in polygon {
                at[cursor[v as usize] as usize] = f as u32;
                cursor[v as usize] += 1;
            }
        }
        FacesAt { offsets, faces: at }
    }

    pub fn get(&self, v: u32) -> &[u32] {
        &self.faces[self.offsets[v as usize] as usize..self.offsets[v as usize + 1] as usize]
    }

    /// Returns these faces and those within `rings` rings around them, ascending.
    pub fn around(&self, domain: &Domain, faces: &[u32], rings: usize) -> Vec<u32> {
        let mut inside = vec![false; domain.disc.faces.len()];
        faces.iter().for_each(|&f| inside[f as usize] = true);
        let (mut all, mut last) = (faces.to_vec(), faces.to_vec());
        for _ in 0..rings {
            let mut next = Vec::new();
            for &v in last.iter().flat_map(|&f| domain.disc.faces.get(f as usize)) {
                for &f in self.get(v) {
                    if !std::mem::replace(&mut inside[f as usize], true) {
                        next.push(f);
                    }
                }
            }
            all.extend(&next);
            last = next;
        }
        all.sort_unstable();
        all.dedup();
        all
    }
}

impl Patch {
    /// The patch of these faces, given in ascending order. Vertices in `fixed` and vertices with faces outside the
    /// patch are pinned.
    pub fn new(domain: &Domain, (at, incidence): (&FacesAt, &Lists), faces: Vec<u32>, fixed: &Fixed) -> Self {
        let (disc, whole) = (&domain.disc, &domain.graph);
        let has_dual = whole.primal < whole.vertices;
        let inside = |f: u32| faces.binary_search(&f).is_ok();
        let mut vertices: Vec<u32> = faces.iter().flat_map(|&f| disc.faces.get(f as usize)).copied().collect();
        vertices.sort_unstable();
        vertices.dedup();
        let primal = vertices.len();
        let mut held: Vec<bool> =
            vertices.iter().map(|&v| fixed.holds(v) || !at.get(v).iter().all(|&f| inside(f))).collect();
        let mut number: HashMap<u32, u32> = vertices.iter().enumerate().map(|(k, &v)| (v, k as u32)).collect();
        let mut add = |v: u32, holds: bool, vertices: &mut Vec<u32>| {
            *number.entry(v).or_insert_with(|| {
                vertices.push(v);
                held.push(holds);
                vertices.len() as u32 - 1
            })
        };
        if has_dual {
            faces.iter().for_each(|&f| {
                add(whole.primal as u32 + f, false, &mut vertices);
            });
        }
        let mut boundary = Vec::new();
        let (mut edges, mut mesh_edges, mut mesh_lengths) = (Vec::new(), Vec::new(), Vec::new());
        let (mut boundary_length, n) = (Vec::new(), disc.boundary.len());
        let stride = whole.boundary.len() / n.max(1);
        // Begin where the boundary enters the patch, so that every arc is in one piece.
        let face_of = |k: usize| {
            let [a, b] = [k % n, (k + 1) % n].map(|k| disc.boundary[k]);
            at.get(a).iter().find(|&&f| {
                let polygon = disc.faces.get(f as usize);
                (0..polygon.len()).any(|i| polygon[i] == a && polygon[(i + 1) % polygon.len()] == b)
            })
        };
        let is_in: Vec<bool> = (0..n).map(|k| face_of(k).is_some_and(|&f| inside(f))).collect();
        let first = (0..n).find(|&k| !is_in[k]).unwrap_or(0);
        for k in (0..n).map(|k| (first + k) % n).filter(|&k| is_in[k]) {
            let steps: Vec<u32> =
                (0..=stride).map(|i| whole.boundary[(stride * k + i) % whole.boundary.len()]).collect();
            let steps: Vec<u32> = steps.into_iter().map(|v| add(v, false, &mut vertices)).collect();
            for (i, pair) in steps.windows(2).enumerate() {
                if boundary.last() != Some(&pair[0]) {
                    boundary.push(pair[0]);
                }
                boundary.push(pair[1]);
                edges.push([pair[0], pair[1]]);
                boundary_length.push(whole.boundary_length[stride * k + i]);
            }
            mesh_edges.push([steps[0], steps[stride]]);
            mesh_lengths.push((0..stride).map(|i| whole.boundary_length[stride * k + i]).sum());
        }
        if boundary.len() > 1 && boundary.first() == boundary.last() {
            boundary.pop();
        }
        // First the vertices that are not pinned, then the pinned corners of their quads.
        let mut quads: Vec<u32> = Vec::new();
        for (&v, _) in vertices.iter().zip(&held).filter(|(_, held)| !**held) {
            quads.extend(incidence.of(v));
        }
        quads.sort_unstable();
        quads.dedup();
        let mut add = |v: u32| {
            *number.entry(v).or_insert_with(|| {
                vertices.push(v);
                held.push(true);
                vertices.len() as u32 - 1
            })
        };
        let graph = QuadGraph {
            quads: quads.iter().map(|&q| whole.quads[q as usize].map(&mut add)).collect(),
            vertices: 0,
            primal,
            rho: quads.iter().map(|&q| whole.rho[q as usize]).collect(),
            diagonal: quads.iter().map(|&q| whole.diagonal[q as usize]).collect(),
            tilted: 0,
            boundary,
            // No method on the boundary is applied to a patch, so that its loops are not needed.
            loops: Vec::new(),
            boundary_length,
            places: Vec::new(),
        };
        let (mut triangles, mut face_of_triangle) = (Vec::new(), Vec::new());
        for (k, &f) in faces.iter().enumerate() {
            for mut t in triangles_of_face(disc, domain.planes.as_ref(), true, f as usize) {
                t.vertices = t.vertices.map(|v| number[&v]);
                if t.vertices.iter().any(|&v| !held[v as usize]) {
                    triangles.push(t);
                    face_of_triangle.push(k as u32);
                }
            }
        }
        let nothing = Vec::new;
        let metric =
            RestMetric { triangles, edges: Vec::new(), length: nothing(), area: nothing(), folded_area: nothing() };
        let graph = QuadGraph { vertices: vertices.len(), places: vec![[0.0; 3]; vertices.len()], ..graph };
        Patch { vertices, held, graph, metric, face_of_triangle, edges, mesh_edges, mesh_lengths, faces }
    }

    /// The data from which energies are made.
    pub fn rest(&self, weight: Weight) -> Rest<'_> {
        Rest { graph: &self.graph, metric: &self.metric, weight, held: &self.held }
    }

    /// Restricts a map of the domain to the patch.
    pub fn restrict(&self, z: &[Complex64]) -> Vec<Complex64> {
        self.vertices.iter().map(|&v| z[v as usize]).collect()
    }

    /// Copies the positions of vertices that are not pinned into a map of the domain.
    pub fn write(&self, local: &[Complex64], z: &mut [Complex64]) {
        for ((&v, place), _) in self.vertices.iter().zip(local).zip(&self.held).filter(|(_, held)| !**held) {
            z[v as usize] = *place;
        }
    }

    /// Pins the pinned vertices, and those for which `and` holds, at their positions in `z`.
    pub fn fixed(&self, z: &[Complex64], and: impl Fn(u32) -> bool) -> Fixed {
        let mut fixed = Fixed::default();
        for (v, place) in z.iter().enumerate().filter(|(v, _)| self.held[*v] || and(*v as u32)) {
            fixed.hold(v as u32, *place);
        }
        fixed
    }
}
