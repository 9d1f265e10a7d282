//! The searches for [`Diagnosis`](super::diagnosis::Diagnosis), one function per group of findings.

use super::diagnosis::Finding;
use crate::geometry::vector;
use crate::sparse::Lists;
use crate::surface::Surface;
use crate::surface::topology::Topology;

/// A face counts as having no area if twice its area over its squared extent is below this: four
/// rounding errors of a product of lengths.
pub(crate) const ZERO_AREA: f64 = 4.0 * f64::EPSILON;

/// Extents for which products of four lengths, from the extent down to 1e-16 of it, neither
/// overflow nor underflow.
const EXTENTS: std::ops::RangeInclusive<f64> = 1e-60..=1e60;

/// The first offender and the number of offenders.
struct Tally<T> {
    first: Option<T>,
    count: usize,
}

impl<T> Tally<T> {
    fn of(offenders: impl Iterator<Item = T>) -> Self {
        let mut tally = Tally { first: None, count: 0 };
        for offender in offenders {
            tally.first.get_or_insert(offender);
            tally.count += 1;
        }
        tally
    }

    fn report(self, finding: impl FnOnce(T, usize) -> Finding) -> Option<Finding> {
        self.first.map(|first| finding(first, self.count))
    }
}

/// Finds unsupported numbers of corners, repeated corners and duplicate faces.
pub(super) fn of_polygons(surface: &Surface) -> Vec<Finding> {
    let faces = &surface.faces;
    if faces.is_empty() {
        return vec![Finding::NoFaces];
    }
    let mut findings = Vec::new();
    let mut arities = std::collections::BTreeMap::new();
    for polygon in faces.iter() {
        *arities.entry(polygon.len()).or_insert(0usize) += 1;
    }
    let usual = if faces.get(0).len() == 4 { 4 } else { 3 };
    if let Some(first) = faces.iter().position(|p| p.len() != usual) {
        findings.push(Finding::Polygons { arities: arities.into_iter().collect(), first: first as u32 });
    }
    let repeated = faces.iter().enumerate().filter_map(|(f, polygon)| {
        let twice = (1..polygon.len()).find(|&k| polygon[..k].contains(&polygon[k]))?;
        Some((f as u32, polygon[twice]))
    });
    findings.extend(Tally::of(repeated).report(|(face, vertex), count| Finding::RepeatedVertex {
        face,
        vertex,
        count,
    }));
    findings.extend(duplicate_faces(surface));
    findings
}

fn duplicate_faces(surface: &Surface) -> Option<Finding> {
    let faces = &surface.faces;
    // Faces with the same vertex set have the same smallest vertex, and the same number, sum and sum of squares of all
    // vertices: only such faces are compared.
    let smallest = |f: u32| faces.get(f as usize).iter().copied().min().unwrap_or(0);
    let by_smallest = Lists::new(surface.positions.len(), (0..faces.len() as u32).map(|f| (smallest(f), f)));
    let signature = |f: u32| {
        let polygon = faces.get(f as usize).iter().map(|&v| u64::from(v));
        (polygon.len(), polygon.clone().sum::<u64>(), polygon.map(|v| v * v).fold(0, u64::wrapping_add))
    };
    let sorted = |f: u32| {
        let mut polygon = faces.get(f as usize).to_vec();
        polygon.sort_unstable();
        polygon
    };
    let mut pairs = Vec::new();
    let mut bucket = Vec::new();
    for v in 0..by_smallest.len() as u32 {
        bucket.clear();
        bucket.extend(by_smallest.of(v).iter().map(|&f| (signature(f), f)));
        bucket.sort_unstable();
        for alike in bucket.chunk_by(|a, b| a.0 == b.0).filter(|alike| alike.len() > 1) {
            let mut sets: Vec<(Vec<u32>, u32)> = alike.iter().map(|&(_, f)| (sorted(f), f)).collect();
            sets.sort_unstable();
            pairs.extend(sets.chunk_by(|a, b| a.0 == b.0).flat_map(|same| same[1..].iter().map(|s| [same[0].1, s.1])));
        }
    }
    pairs.sort_unstable_by_key(|&[_, later]| later);
    Tally::of(pairs.into_iter()).report(|first, count| Finding::DuplicateFaces { first, count })
}

/// Finds coordinates that are not finite, edges without length and faces without area.
pub(super) fn of_geometry(surface: &Surface, topology: &Topology) -> Vec<Finding> {
    let x = &surface.positions;
    let not_finite = Tally::of((0..x.len()).filter(|&v| !x[v].iter().all(|t| t.is_finite())));
    if let Some(finding) = not_finite.report(|vertex, count| Finding::NotFinite { vertex: vertex as u32, count }) {
        return vec![finding];
    }
    let extent = extent(surface, topology);
    if extent != 0.0 && !EXTENTS.contains(&extent) {
        return vec![Finding::OutOfRange { extent }];
    }
    let quads_only = surface.faces.arity() == Some(4);
    let zero_length = topology.edges.ends.iter().filter(|[a, b]| a != b && x[*a as usize] == x[*b as usize]).copied();
    let zero_area = (0..surface.faces.len()).filter(|&f| has_no_area(&surface.positions, surface.faces.get(f)));
    [
        Tally::of(zero_length).report(|edge, count| Finding::ZeroLengthEdges { edge, count, fatal: !quads_only }),
        Tally::of(zero_area).report(|face, count| Finding::ZeroAreaFaces { face: face as u32, count }),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// The longest side of the bounding box of the vertices in use.
fn extent(surface: &Surface, topology: &Topology) -> f64 {
    let used = || (0..surface.positions.len()).filter(|&v| topology.fans[v] > 0).map(|v| surface.positions[v]);
    let side = |k: usize| {
        let (low, high) = used().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x[k]), b.max(x[k])));
        high - low
    };
    (0..3).map(side).fold(0.0, f64::max)
}

/// Whether the vector area ½ Σ (xᵢ − x₀) × (xᵢ₊₁ − x₀) vanishes up to rounding.
pub(crate) fn has_no_area(positions: &[[f64; 3]], polygon: &[u32]) -> bool {
    let Some((&first, others)) = polygon.split_first() else { return true };
    let origin = positions[first as usize];
    let spokes = others.iter().map(|&v| vector::sub(positions[v as usize], origin));
    let (mut twice_area, mut extent, mut previous) = ([0.0; 3], 0.0f64, [0.0; 3]);
    for spoke in spokes {
        twice_area = vector::add(twice_area, vector::cross(previous, spoke));
        extent = extent.max(vector::norm(spoke));
        previous = spoke;
    }
    vector::norm(twice_area) <= ZERO_AREA * extent * extent
}

/// Finds edges of three or more faces, vertices of several fans, non-orientable components and
/// flips.
pub(super) fn of_manifoldness(topology: &Topology) -> Vec<Finding> {
    let Topology { edges, orientation, fans, .. } = topology;
    let faces_at = |e: usize| {
        let mut faces: Vec<u32> = edges.corners(e).iter().map(|&c| edges.face_of_corner[c as usize]).collect();
        // A face that contains an edge twice is reported elsewhere.
        faces.dedup();
        faces
    };
    let overfull: Vec<usize> = (0..edges.len()).filter(|&e| edges.corners(e).len() > 2).collect();
    let mut on_overfull_edge = vec![false; fans.len()];
    for &e in &overfull {
        for v in edges.ends[e] {
            on_overfull_edge[v as usize] = true;
        }
    }
    let crowded: Vec<usize> = overfull.into_iter().filter(|&e| faces_at(e).len() > 2).collect();
    let pinched = (0..fans.len()).filter(|&v| fans[v] > 1 && !on_overfull_edge[v]);
    let flipped = (0..orientation.flip.len()).filter(|&f| orientation.flip[f]);
    let mut findings = Vec::new();
    findings.extend(Tally::of(crowded.into_iter()).report(|e, count| Finding::NonManifoldEdges {
        edge: edges.ends[e],
        faces: faces_at(e),
        count,
    }));
    findings.extend(Tally::of(pinched).report(|v, count| Finding::NonManifoldVertices {
        vertex: v as u32,
        fans: fans[v],
        count,
    }));
    findings.extend(orientation.contradiction.iter().enumerate().filter_map(|(component, edge)| {
        Some(Finding::NonOrientable { component, edge: edges.ends[(*edge)? as usize] })
    }));
    findings.extend(Tally::of(flipped).report(|f, count| Finding::Reoriented { face: f as u32, count }));
    findings
}

/// Finds the reason why the whole surface is not a single disc.
pub(super) fn of_shape(topology: &Topology) -> Option<Finding> {
    match topology.components.as_slice() {
        [] => None,
        [only] => {
            let genus = only.genus().filter(|_| only.orientable)?;
            match only.boundary_loops.as_slice() {
                [] => Some(Finding::Closed { genus }),
                // At most it touches itself at a vertex, which is reported elsewhere.
                [_] if genus == 0 => None,
                loops => Some(Finding::NotADisc { boundary_loops: loops.to_vec(), genus }),
            }
        }
        several => {
            let mut faces: Vec<usize> = several.iter().map(|c| c.faces).collect();
            faces.sort_unstable_by(|a, b| b.cmp(a));
            Some(Finding::Components { count: several.len(), faces })
        }
    }
}

/// Finds vertices of no face, and vertices in use at the same position.
pub(super) fn of_vertices(surface: &Surface, topology: &Topology) -> Vec<Finding> {
    let fans = &topology.fans;
    let unused = (0..fans.len()).filter(|&v| fans[v] == 0);
    let key = |v: u32| surface.positions[v as usize].map(|t| (t + 0.0).to_bits());
    // As many buckets as vertices, by a product of the coordinates' bits.
    let bits = fans.len().next_power_of_two().trailing_zeros().max(1);
    let bucket = |v: u32| {
        let mixed =
            key(v).iter().fold(0u64, |mixed, &bits| (mixed ^ bits).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29));
        (mixed.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (64 - bits)) as u32
    };
    let used = (0..fans.len() as u32).filter(|&v| fans[v as usize] > 0);
    let buckets = Lists::new(1 << bits, used.map(|v| (bucket(v), v)));
    let mut coincident = Vec::new();
    let mut alike: Vec<([u64; 3], u32)> = Vec::new();
    for b in (0..buckets.len() as u32).filter(|&b| buckets.of(b).len() > 1) {
        alike.clear();
        alike.extend(buckets.of(b).iter().map(|&v| (key(v), v)));
        alike.sort_unstable();
        let same = alike.chunk_by(|a, b| a.0 == b.0);
        coincident.extend(same.flat_map(|same| same[1..].iter().map(|s| [same[0].1, s.1])));
    }
    coincident.sort_unstable_by_key(|&[_, later]| later);
    [
        Tally::of(unused).report(|v, count| Finding::Unreferenced { vertex: v as u32, count }),
        Tally::of(coincident.into_iter()).report(|first, count| Finding::CoincidentVertices { first, count }),
    ]
    .into_iter()
    .flatten()
    .collect()
}
