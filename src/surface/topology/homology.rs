//! Closed integer 1-forms and loops on closed surfaces of genus 1.

use super::tree_cotree::{EdgeGraph, ShortestPaths, TreeCotree};
use crate::geometry::vector;
use crate::surface::edges::{Edges, next_in};
use crate::surface::orientation::same_direction;
use crate::surface::oriented_mesh::OrientedMesh;

/// A basis γ1, γ2 of the first homology of a closed surface of genus 1 and the dual basis α1, α2 of
/// its cohomology:
///
/// ```text
/// ∮_{γ_j} α_k = δ_jk        ∫ α1 ∧ α2 = 1
/// ```
///
/// Seen from the side on which faces are counter-clockwise, γ1 crosses γ2 from left to right. A map
/// that preserves orientation and has the period ω_k along γ_k therefore has `Im(ω2/ω1) > 0`.
#[derive(Clone, Debug)]
pub struct Homology {
    /// `(∫α1, ∫α2)` along the directed edge of every corner: −1, 0 or 1. Opposite corners have
    /// opposite values, and the values around every face sum to zero.
    pub form: Vec<[i8; 2]>,
    /// The shortest loop of each class (up to direction) among those that consist of tree paths and
    /// one edge.
    generators: Vec<Cycle>,
}

/// A closed walk along edges.
#[derive(Clone, Debug, PartialEq)]
pub struct Cycle {
    /// `(∮α1, ∮α2)`: the walk is homologous to that combination of γ1 and γ2.
    pub class: [i64; 2],
    /// The vertices in order; the first is not repeated at the end.
    pub vertices: Vec<u32>,
    /// The edge from each vertex to the next.
    pub edges: Vec<u32>,
    /// Total length of the edges.
    pub length: f64,
}

/// The surface has no pair of loops along which a map can be periodic.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum HomologyError {
    /// The surface has a boundary.
    #[error("the surface has a boundary of {edges} edges, and a periodic map needs a closed surface")]
    Boundary {
        /// Number of boundary edges.
        edges: usize,
    },
    /// The surface has more than one connected component.
    #[error("the surface has more than one connected component: split the mesh, and map one at a time")]
    Disconnected,
    /// The surface is a sphere.
    #[error("the surface is closed and has genus 0, so it has no loops that could have periods")]
    Sphere,
    /// The surface has more than one handle.
    #[error("the surface has genus {genus}, and only surfaces of genus 1 have periodic maps to the plane")]
    Genus {
        /// Genus of the surface.
        genus: usize,
    },
    /// Neighbouring faces are oriented inconsistently.
    #[error("face {face} and one of its neighbours are not oriented consistently: orient them first")]
    Orientation {
        /// The first face that traverses an edge in the same direction as its neighbour.
        face: usize,
    },
    /// A loop of this class would have too many edges.
    #[error("a loop of class {}, {} has too many edges", class[0], class[1])]
    TooLong {
        /// The class.
        class: [i64; 2],
    },
}

/// Largest number of edges of a walk from [`Homology::cycle`].
const LONGEST: u64 = 1 << 28;

impl Homology {
    /// Computes the basis from shortest loops through the vertex `root`; see [`TreeCotree`].
    /// `edges` are the edges of `disc.faces`.
    ///
    /// # Errors
    /// The surface is not closed, connected, consistently oriented and of genus 1.
    pub fn new(disc: &OrientedMesh, edges: &Edges, root: u32) -> Result<Self, HomologyError> {
        let boundary = (0..edges.len()).filter(|&e| edges.corners(e).len() < 2).count();
        if boundary > 0 {
            return Err(HomologyError::Boundary { edges: boundary });
        }
        if let Some(face) = disagreeing(disc, edges) {
            return Err(HomologyError::Orientation { face });
        }
        let length = edges.ends.iter().map(|&[a, b]| {
            let [a, b] = [a, b].map(|v| disc.positions[v as usize]);
            vector::norm(vector::sub(b, a))
        });
        let graph = EdgeGraph::new(&disc.faces, edges, disc.positions.len(), length.collect());
        let system = TreeCotree::new(&graph, root);
        let roots = system.face_parent.iter().filter(|&&e| e == ShortestPaths::NONE).count();
        if roots != 1 || system.tree.distance.iter().any(|d| d.is_infinite()) {
            return Err(HomologyError::Disconnected);
        }
        match system.left_over.len() {
            2 => {}
            0 => return Err(HomologyError::Sphere),
            loops => return Err(HomologyError::Genus { genus: loops / 2 }),
        }

        let mut form = vec![[0i8; 2]; disc.faces.corners().len()];
        let mut add = |c: usize, k: usize, value: i8| form[c][k] += value;
        for k in [0, 1] {
            for c in system.dual_loop(&graph, k) {
                add(c as usize, k, 1);
                if let Some(opposite) = edges.opposite(c as usize) {
                    add(opposite, k, -1);
                }
            }
        }
        if twice_degree(disc, &form) < 0 {
            form.iter_mut().for_each(|f| f[1] = -f[1]);
        }
        let generators = generators(&graph, &system, &form);
        Ok(Homology { form, generators })
    }

    /// Returns a short closed walk of the given class.
    ///
    /// The walk passes through the root of the basis unless steps back and forth next to the root
    /// cancel; for the classes of the shortest loops it is simple.
    ///
    /// # Errors
    /// [`HomologyError::TooLong`] if the walk would have more than 2²⁸ edges.
    pub fn cycle(&self, disc: &OrientedMesh, class: [i64; 2]) -> Result<Cycle, HomologyError> {
        let too_long = || HomologyError::TooLong { class };
        let mut best: Option<(f64, [(usize, i64); 2])> = None;
        for i in 0..self.generators.len() {
            for j in 0..i {
                let [a, b] = [i, j].map(|k| self.generators[k].class);
                let determinant = a[0] * b[1] - a[1] * b[0];
                if determinant.abs() != 1 {
                    continue;
                }
                // class = m a + n b
                let cross = |x: [i64; 2], y: [i64; 2]| {
                    Some(x[0].checked_mul(y[1])?.checked_sub(x[1].checked_mul(y[0])?)? * determinant)
                };
                let (Some(m), Some(n)) = (cross(class, b), cross(a, class)) else { return Err(too_long()) };
                let length = m.abs() as f64 * self.generators[i].length + n.abs() as f64 * self.generators[j].length;
                if best.is_none_or(|(shortest, _)| length < shortest) {
                    best = Some((length, [(i, m), (j, n)]));
                }
            }
        }
        let Some((_, word)) = best else { return Err(too_long()) };
        let edges =
            |(k, times): (usize, i64)| times.unsigned_abs().saturating_mul(self.generators[k].edges.len() as u64);
        if word.into_iter().map(edges).fold(0, u64::saturating_add) > LONGEST {
            return Err(too_long());
        }
        Ok(self.concatenated(disc, class, word))
    }

    /// Concatenates generators, each repeated the given number of times, backwards if that is
    /// negative.
    fn concatenated(&self, disc: &OrientedMesh, class: [i64; 2], word: [(usize, i64); 2]) -> Cycle {
        let mut walk: Vec<(u32, u32)> = Vec::new();
        for (k, times) in word {
            let Cycle { vertices, edges, .. } = &self.generators[k];
            let n = vertices.len();
            for _ in 0..times.unsigned_abs() {
                for i in 0..n {
                    // Backwards, the edge of the preceding vertex leads on.
                    let step =
                        if times > 0 { (vertices[i], edges[i]) } else { (vertices[(n - i) % n], edges[n - 1 - i]) };
                    push_or_cancel(&mut walk, step);
                }
            }
        }
        let walk = without_tail(&walk);
        let (vertices, edges): (Vec<u32>, Vec<u32>) = walk.iter().copied().unzip();
        let places = vertices.iter().map(|&v| disc.positions[v as usize]);
        let ahead = places.clone().cycle().skip(1);
        let length = places.zip(ahead).map(|(a, b)| vector::norm(vector::sub(b, a))).sum();
        Cycle { class, vertices, edges, length }
    }
}

/// Returns a face that traverses an edge in the same direction as its neighbour, if there is one.
fn disagreeing(disc: &OrientedMesh, edges: &Edges) -> Option<usize> {
    let placed = |c: u32| (edges.face_of_corner[c as usize] as usize, c as usize);
    let edge = (0..edges.len()).find(|&e| match *edges.corners(e) {
        [c, d] => same_direction(&disc.faces, placed(c), placed(d)),
        _ => true,
    })?;
    Some(edges.face_of_corner[edges.corners(edge)[0] as usize] as usize)
}

/// Twice ∫ α1 ∧ α2, summed over the faces in the plane of (∫α1, ∫α2): 2 or −2.
fn twice_degree(disc: &OrientedMesh, form: &[[i8; 2]]) -> i64 {
    let mut twice = 0;
    for face in 0..disc.faces.len() {
        let mut at = [0i64; 2];
        for c in disc.faces.corner_range(face) {
            let next = [0, 1].map(|k| at[k] + i64::from(form[c][k]));
            twice += at[0] * next[1] - at[1] * next[0];
            at = next;
        }
    }
    twice
}

/// Returns the shortest loop of each class among those that consist of tree paths and one edge.
fn generators(graph: &EdgeGraph, system: &TreeCotree, form: &[[i8; 2]]) -> Vec<Cycle> {
    // Such loops on a torus have at most three classes.
    let mut shortest: Vec<([i64; 2], f64, usize)> = Vec::new();
    for e in 0..graph.edges.len() {
        let c = graph.edges.corners(e)[0] as usize;
        let class = form[c].map(i64::from);
        if class == [0, 0] {
            continue;
        }
        let [a, b] = graph.ends(e as u32).map(|n| system.tree.distance[n as usize]);
        let length = a + graph.length[e] + b;
        match shortest.iter_mut().find(|(known, ..)| *known == class || *known == class.map(|x| -x)) {
            Some(entry) if length < entry.1 => *entry = (class, length, c),
            Some(_) => {}
            None => shortest.push((class, length, c)),
        }
    }
    shortest.into_iter().map(|(class, length, c)| cycle_through(graph, system, class, length, c)).collect()
}

/// Returns the loop from the root to the corner `c`, along its edge, and back to the root.
fn cycle_through(graph: &EdgeGraph, system: &TreeCotree, class: [i64; 2], length: f64, c: usize) -> Cycle {
    let faces = graph.faces;
    let face = graph.edges.face_of_corner[c] as usize;
    let (from, to) = (faces.corners()[c], faces.corners()[next_in(faces, face, c)]);
    let mut walk: Vec<(u32, u32)> = Vec::new();
    let mut there: Vec<(u32, u32)> = Vec::new();
    let mut n = from;
    for e in system.tree.path(graph, from) {
        n = graph.across(e, n);
        there.push((n, e));
    }
    walk.extend(there.iter().rev());
    walk.push((from, graph.edges.of_corner[c]));
    n = to;
    for e in system.tree.path(graph, to) {
        walk.push((n, e));
        n = graph.across(e, n);
    }
    let (vertices, edges) = walk.into_iter().unzip();
    Cycle { class, vertices, edges, length }
}

/// Appends a step, or removes the last one if the new step goes back along it.
fn push_or_cancel(walk: &mut Vec<(u32, u32)>, step: (u32, u32)) {
    if walk.last().is_some_and(|last| last.1 == step.1) {
        walk.pop();
    } else {
        walk.push(step);
    }
}

/// Removes the steps at the end of a closed walk that reverse those at its beginning.
fn without_tail(walk: &[(u32, u32)]) -> &[(u32, u32)] {
    let mut rest = walk;
    while let [first, middle @ .., last] = rest
        && first.1 == last.1
    {
        rest = middle;
    }
    rest
}
