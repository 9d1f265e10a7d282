use super::whole::on_whole;
use super::{Facets, NormalError, NormalEstimator, outward, rule};
use crate::geometry::vector::{add, norm, scale, sub};
use crate::surface::parameters::{Arguments, Parameter};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Averages normals over a ball: `n_f ∝ Σ_g a_g (1 − d(f, g)/r)⁺ n_g` with areas a and distances d.
///
/// With the Euclidean distance between centres, the sum runs over the faces connected to f within
/// the ball. The geodesic distance is the length of the shortest path across edges from centre to
/// centre. The cost is O(nf r²), or O(nf r² log r) for geodesic distances.
///
/// # Rationale
/// On surfels the geodesic paths are staircases whose length depends on their direction; the
/// Euclidean ball halves the angular error.
pub(super) struct Hat;

const PARAMETERS: [Parameter; 4] = [
    rule::radius(),
    rule::factor(2.7),
    rule::exponent(0.333),
    Parameter::choice("ball", &["euclidean", "geodesic"], "how distances are measured"),
];

/// Smallest radius, in edges: below 1 no neighbour would have a positive weight.
pub(super) const LEAST_RADIUS: f64 = 2.0;

impl NormalEstimator for Hat {
    fn name(&self) -> &'static str {
        "hat"
    }

    fn about(&self) -> &'static str {
        "average over a ball on the surface, weights area · (1 − distance/radius)"
    }

    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }

    fn estimate(&self, facets: &Facets, arguments: &Arguments) -> Result<Vec<[f64; 3]>, NormalError> {
        let geodesic = arguments.choice("ball")? == "geodesic";
        on_whole(facets, |facets| Ok(averaged(facets, rule::radius_of(facets, arguments, LEAST_RADIUS)?, geodesic)))
    }
}

/// Returns the averages over balls of `radius` edges.
pub(super) fn averaged(facets: &Facets, radius: f64, geodesic: bool) -> Vec<[f64; 3]> {
    let radius = radius * facets.spacing;
    let unit = 1.0 / (facets.spacing * facets.spacing);
    let mut walk = Walk::new(facets);
    let mut normals = Vec::with_capacity(facets.len());
    for f in 0..facets.len() {
        let mut sum = [0.0; 3];
        let mut total = 0.0;
        let weigh = |g: usize, distance: f64| {
            let weight = facets.area[g] * unit * (1.0 - distance / radius);
            sum = add(sum, scale(weight, facets.normal[g]));
            total += weight;
        };
        if geodesic {
            walk.geodesic(f, radius, weigh)
        } else {
            walk.euclidean(f, radius, weigh)
        }
        normals.push(outward(scale(1.0 / total, sum), facets.normal[f]));
    }
    normals
}

/// A traversal of balls that reuses its working memory from one centre to the next.
struct Walk<'a, 'b> {
    facets: &'a Facets<'b>,
    /// The shortest known distance of each face that `seen` marks.
    distance: Vec<f64>,
    /// The last centre from which each face was reached.
    seen: Vec<u32>,
    /// Distances as bits: these have the same order, because distances are not negative.
    heap: BinaryHeap<Reverse<(u64, u32)>>,
    queue: Vec<u32>,
}

impl<'a, 'b> Walk<'a, 'b> {
    fn new(facets: &'a Facets<'b>) -> Self {
        Walk {
            facets,
            distance: vec![0.0; facets.len()],
            seen: vec![u32::MAX; facets.len()],
            heap: BinaryHeap::new(),
            queue: Vec::new(),
        }
    }

    /// Visits the faces at geodesic distance below `radius` from `f` (Dijkstra's algorithm).
    fn geodesic(&mut self, f: usize, radius: f64, mut visit: impl FnMut(usize, f64)) {
        let centre = f as u32;
        self.distance[f] = 0.0;
        self.seen[f] = centre;
        self.heap.push(Reverse((0f64.to_bits(), centre)));
        while let Some(Reverse((distance, g))) = self.heap.pop() {
            let (distance, g) = (f64::from_bits(distance), g as usize);
            if distance > self.distance[g] {
                continue;
            }
            visit(g, distance);
            for &next in self.facets.neighbours(g) {
                let k = next as usize;
                let far = distance + norm(sub(self.facets.centre[k], self.facets.centre[g]));
                if far < radius && (self.seen[k] != centre || far < self.distance[k]) {
                    self.seen[k] = centre;
                    self.distance[k] = far;
                    self.heap.push(Reverse((far.to_bits(), next)));
                }
            }
        }
    }

    /// Visits the faces whose centres are closer than `radius` to that of `f` and that are
    /// connected to `f` by such faces, breadth first.
    fn euclidean(&mut self, f: usize, radius: f64, mut visit: impl FnMut(usize, f64)) {
        let centre = f as u32;
        self.seen[f] = centre;
        self.queue.clear();
        self.queue.push(centre);
        visit(f, 0.0);
        let mut at = 0;
        while at < self.queue.len() {
            for &next in self.facets.neighbours(self.queue[at] as usize) {
                let k = next as usize;
                if self.seen[k] == centre {
                    continue;
                }
                self.seen[k] = centre;
                let distance = norm(sub(self.facets.centre[k], self.facets.centre[f]));
                if distance < radius {
                    self.queue.push(next);
                    visit(k, distance);
                }
            }
            at += 1;
        }
    }
}
