//! The distortion of angles, areas and lengths by a map, and its injectivity.

mod corner;
mod image;
mod singular;
mod validity;

pub use crate::geometry::predicate::orientation;
pub use corner::corner_errors;
pub use image::Image;
pub use singular::{FaceMap, face_maps};
pub use validity::{Validity, folded_faces};

use num_complex::Complex64;
use serde::Serialize;

use crate::energy::conformal;
use crate::geometry::polygon::boundary_crossing;
use crate::geometry::vector::{norm, sub};
use crate::quad_graph::{QuadGraph, TangentPlanes};
use crate::surface::edges::next_in;
use crate::surface::oriented_mesh::OrientedMesh;

/// Mean and maximum of a quantity that is 1 (a ratio) or 0 (a residual) for a perfect map.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MeanMax {
    /// Mean over faces, quads or edges.
    pub mean: f64,
    /// The maximum.
    pub max: f64,
}

/// The quasi-conformal distortion σ1/σ2 over the faces that are neither flipped nor collapsed; 1 is
/// conformal.
///
/// # Rationale
/// The plain mean is no measure of circle maps. A face with two edges on the boundary, an *ear*,
/// is distorted by the exact conformal map itself: its corner is opened to nearly half a turn. On a
/// flat square of 6400 Delaunay vertices the exact map has the mean 1.89 and the maximum 9.5e3 with
/// one ear, 1.015 without it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct QuasiConformal {
    /// The median.
    pub median: f64,
    /// 90th percentile.
    pub p90: f64,
    /// Mean over the faces that have at most one edge on the boundary; `None` where there are no such faces.
    pub without_ears: Option<f64>,
    /// Mean over faces.
    pub mean: f64,
    /// Mean weighted by area on the surface.
    pub area_mean: f64,
    /// 99th percentile.
    pub p99: f64,
    /// The maximum.
    pub max: f64,
}

/// The lengths of the mesh's edges.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LengthDistortion {
    /// Mean of max(t, 1/t) with t = image length / length, after scaling the map to the surface's area.
    pub mean: f64,
    /// The largest of these.
    pub max: f64,
    /// The largest | |e|/l − 1 | over the boundary edges of the mesh, without any scaling, where l is the
    /// prescribed length or that on the surface; `None` unless the boundary is free.
    pub boundary_max: Option<f64>,
}

/// The measurements of a map that are reported. Fields are `None` if no face of positive area can
/// be measured.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Distortion {
    /// The quasi-conformal distortion σ1/σ2.
    pub quasi_conformal: Option<QuasiConformal>,
    /// max(t, 1/t) with t = σ1 σ2, after scaling the map to the surface's area.
    pub area: Option<MeanMax>,
    /// Mean of σ1² + σ2² + σ1⁻² + σ2⁻² after the same scaling, weighted by area; 4 is isometric.
    pub symmetric_dirichlet: Option<f64>,
    /// |r| / (|ρ| |z2 − z0|) per quad, where r is the residual of (2).
    pub rho_residual: Option<MeanMax>,
    /// Lengths of the edges of the mesh.
    pub length: Option<LengthDistortion>,
    /// The smallest scale |a| = ½ (σ1 + σ2) of a face relative to the largest; 1 if all are equal.
    ///
    /// Double precision resolves positions to 1e-16 of their distance from 0, so parts of a map
    /// with a relative scale below about 1e-15 are at the limit of what it can represent.
    pub smallest_scale: Option<f64>,
    /// Number of faces whose image is not positively oriented, by an exact predicate.
    pub flipped: usize,
    /// The first such face, as an index of the source.
    pub first_flipped: Option<usize>,
    /// Number of quads whose image is not strictly convex, including flipped ones; 0 for triangles.
    pub not_convex: usize,
    /// Whether the polygon of the boundary crosses or touches itself.
    pub boundary_crosses: bool,
    /// Number of boundary vertices that do not follow their predecessor counter-clockwise; only for
    /// maps to a circle.
    pub boundary_out_of_order: Option<usize>,
}

impl Distortion {
    /// Measures a map of `disc`, from which `graph` was made with the given tangent planes.
    pub fn new(disc: &OrientedMesh, graph: &QuadGraph, planes: Option<&TangentPlanes>, image: &Image) -> Self {
        let maps = face_maps(disc, graph, image);
        let scale = area_scale(&maps);
        let valid: Vec<&FaceMap> = maps.iter().filter(|m| m.is_regular()).collect();
        let flipped: Vec<usize> = (0..maps.len()).filter(|&f| !maps[f].positive).collect();
        let quads = (0..graph.quads.len()).filter(|&q| !in_filled_face(disc, graph, q)).map(|q| {
            let corners = image.quad(graph, q);
            let r = conformal::residual_at(graph.rho[q], corners).norm();
            if r == 0.0 { 0.0 } else { r / (graph.rho[q].norm() * (corners[2] - corners[0]).norm()) }
        });
        let scaled = scale.unwrap_or(1.0);
        Distortion {
            quasi_conformal: quasi_conformal(&maps, &ears(disc, graph)),
            area: mean_max(valid.iter().map(|m| symmetric_ratio(m.sigma1 * m.sigma2 * scaled * scaled))),
            symmetric_dirichlet: symmetric_dirichlet(&valid, scaled),
            rho_residual: mean_max(quads.filter(|r| r.is_finite())),
            length: length_distortion(disc, planes, image, scaled),
            smallest_scale: smallest_scale(&maps),
            flipped: flipped.len(),
            first_flipped: flipped.first().map(|&f| disc.source_face[f] as usize),
            not_convex: maps.iter().filter(|m| !m.convex).count(),
            boundary_crosses: boundary_crossing(&mesh_boundary(graph, image.z)).is_some(),
            boundary_out_of_order: None,
        }
    }
}

/// Returns the images of the boundary vertices of the mesh, in order.
pub fn mesh_boundary(graph: &QuadGraph, z: &[Complex64]) -> Vec<Complex64> {
    graph.boundary.iter().filter(|&&v| !graph.is_dual(v)).map(|&v| z[v as usize]).collect()
}

/// Whether quad `q` is, or lies partly in, a face that fills a hole.
fn in_filled_face(disc: &OrientedMesh, graph: &QuadGraph, q: usize) -> bool {
    let (first, last) = (disc.source_faces(), disc.faces.len());
    match graph.primal == graph.vertices {
        true => q >= first,
        // The dual vertices of faces follow the vertices of the mesh.
        false => graph.quads[q].iter().any(|&v| (graph.primal + first..graph.primal + last).contains(&(v as usize))),
    }
}

/// Returns the factor on lengths in the plane that gives the image the surface's area; `None` if
/// the image has no area.
fn area_scale(maps: &[FaceMap]) -> Option<f64> {
    let shapes = || maps.iter().filter(|m| m.has_shape());
    let surface: f64 = shapes().map(|m| m.area).sum();
    let image: f64 = shapes().map(|m| m.area * (m.sigma1 * m.sigma2).abs()).sum();
    let scale = (surface / image).sqrt();
    scale.is_finite().then_some(scale)
}

/// The smallest scale of a face relative to the largest.
fn smallest_scale(maps: &[FaceMap]) -> Option<f64> {
    let scales = || maps.iter().filter(|m| m.has_shape()).map(|m| 0.5 * (m.sigma1 + m.sigma2));
    let smallest = scales().fold(f64::INFINITY, f64::min) / scales().fold(0.0, f64::max);
    smallest.is_finite().then_some(smallest)
}

/// max(t, 1/t)
fn symmetric_ratio(t: f64) -> f64 {
    t.max(1.0 / t)
}

fn mean_max(values: impl Iterator<Item = f64>) -> Option<MeanMax> {
    let (mut sum, mut count, mut max) = (0.0, 0usize, f64::NEG_INFINITY);
    for value in values {
        sum += value;
        count += 1;
        max = max.max(value);
    }
    (count > 0).then(|| MeanMax { mean: sum / count as f64, max })
}

fn quasi_conformal(maps: &[FaceMap], ears: &[bool]) -> Option<QuasiConformal> {
    let valid = || maps.iter().zip(ears).filter(|(map, _)| map.is_regular());
    let mut errors: Vec<f64> = valid().map(|(map, _)| map.quasi_conformal()).collect();
    let plain = mean_max(errors.iter().copied())?;
    let area: f64 = valid().map(|(map, _)| map.area).sum();
    let area_mean = valid().map(|(map, _)| map.area * map.quasi_conformal()).sum::<f64>() / area;
    let without_ears = mean_max(valid().filter(|(_, ear)| !**ear).map(|(map, _)| map.quasi_conformal()));
    // The smallest value that at least so many of 100 faces do not exceed.
    let [median, p90, p99] = [50, 90, 99].map(|percent| {
        let rank = (errors.len() * percent).div_ceil(100) - 1;
        *errors.select_nth_unstable_by(rank, f64::total_cmp).1
    });
    let without_ears = without_ears.map(|errors| errors.mean);
    Some(QuasiConformal { median, p90, without_ears, mean: plain.mean, area_mean, p99, max: plain.max })
}

/// Whether two or more edges of a face are on the boundary (`nf`).
fn ears(disc: &OrientedMesh, graph: &QuadGraph) -> Vec<bool> {
    const NONE: u32 = u32::MAX;
    // The mesh vertex after each one along its boundary loop.
    let mut next = vec![NONE; disc.positions.len()];
    for range in &graph.loops {
        let of_mesh = || graph.boundary[range.clone()].iter().copied().filter(|&v| !graph.is_dual(v));
        for (v, after) in of_mesh().zip(of_mesh().cycle().skip(1)) {
            next[v as usize] = after;
        }
    }
    let on_boundary = |polygon: &[u32]| {
        let ahead = polygon.iter().cycle().skip(1);
        polygon.iter().zip(ahead).filter(|&(&v, &after)| next[v as usize] == after).count()
    };
    disc.faces.iter().map(|polygon| on_boundary(polygon) > 1).collect()
}

fn symmetric_dirichlet(valid: &[&FaceMap], scale: f64) -> Option<f64> {
    let area: f64 = valid.iter().map(|m| m.area).sum();
    let density = |m: &FaceMap| {
        let [s, t] = [m.sigma1, m.sigma2].map(|sigma| (scale * sigma).powi(2));
        s + t + 1.0 / s + 1.0 / t
    };
    (!valid.is_empty()).then(|| valid.iter().map(|m| m.area * density(m)).sum::<f64>() / area)
}

/// Measures the edges of all faces; inner edges count from both sides.
fn length_distortion(
    disc: &OrientedMesh,
    planes: Option<&TangentPlanes>,
    image: &Image,
    scale: f64,
) -> Option<LengthDistortion> {
    let faces = &disc.faces;
    let ratio = |f: usize, c: usize| {
        let next = next_in(faces, f, c);
        let [a, b] = [c, next].map(|c| disc.positions[faces.corners()[c] as usize]);
        let rest = planes.map_or_else(|| norm(sub(b, a)), |planes| planes.length(f, sub(b, a)));
        symmetric_ratio(scale * (image.corner(disc, next) - image.corner(disc, c)).norm() / rest)
    };
    let shapes = (0..disc.source_faces()).filter(|&f| !disc.surrogates.has(f));
    let edges = shapes.flat_map(|f| faces.corner_range(f).map(move |c| (f, c)));
    let all = mean_max(edges.map(|(f, c)| ratio(f, c)).filter(|t| t.is_finite()))?;
    Some(LengthDistortion { mean: all.mean, max: all.max, boundary_max: None })
}

/// Returns σ1/σ2 of every face for drawing: +∞ if a face is flipped or collapsed, 1 if it is
/// neither but has no shape at rest.
pub fn quasi_conformal_errors(maps: &[FaceMap]) -> Vec<f64> {
    let of_face = |map: &FaceMap| match map.is_regular() {
        true => map.quasi_conformal(),
        false if map.positive && !map.has_shape() => 1.0,
        false => f64::INFINITY,
    };
    maps.iter().map(of_face).collect()
}
