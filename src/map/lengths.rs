//! Free maps whose boundary edges have lengths that are asked for.

use std::collections::HashMap;

use num_complex::Complex64;
use serde::Serialize;

use super::MapOptions;
use crate::distortion::MeanMax;
use crate::io::{BoundaryLengths, LengthUnit, PerEdge};
use crate::quad_graph::QuadGraph;
use crate::surface::oriented_mesh::OrientedMesh;

/// Boundary edges cannot have the prescribed lengths.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LengthsError {
    /// The energy has no term that enforces boundary lengths.
    #[error("boundary lengths are kept by L', and the energy is `{energy}`")]
    NotKept {
        /// The energy.
        energy: String,
    },
    /// The number of lengths is not the number of boundary edges.
    #[error(
        "{found} boundary lengths are given, and the boundary has {edges} edges: one for each is needed, from the first \
         vertex of the boundary on"
    )]
    Count {
        /// Number of lengths given.
        found: usize,
        /// Number of boundary edges.
        edges: usize,
    },
    /// Two vertices are not neighbours on the boundary.
    #[error("{v} {w} is no boundary edge")]
    NoSuchEdge {
        /// The first vertex.
        v: u32,
        /// The second vertex.
        w: u32,
    },
    /// A boundary edge has no length.
    #[error("boundary edge {v} {w} has no length: give one for each of the {edges} edges")]
    Missing {
        /// The first vertex of the edge.
        v: u32,
        /// The second vertex of the edge.
        w: u32,
        /// Number of boundary edges.
        edges: usize,
    },
    /// An edge has two copies on the boundary because the surface was cut there.
    #[error(
        "edge {v} {w} is on the boundary twice, for the surface is cut there: list the lengths in order, without vertices"
    )]
    Ambiguous {
        /// The first vertex.
        v: u32,
        /// The second vertex.
        w: u32,
    },
    /// An edge is longer than all others together.
    #[error(
        "boundary edge {v} {w} is to be {length} long, and all others together {others}: no polygon has such edges"
    )]
    Open {
        /// The first vertex of the edge.
        v: u32,
        /// The second vertex of the edge.
        w: u32,
        /// Its length.
        length: f64,
        /// The sum of the lengths of the others.
        others: f64,
    },
}

/// Prescribed boundary lengths.
#[derive(Clone, Debug, PartialEq)]
pub struct Prescribed {
    /// The unit in which they were given.
    pub unit: LengthUnit,
    /// ln (prescribed length / length at rest) of each boundary edge of the quad graph (`nb`).
    pub log_factors: Vec<f64>,
}

/// Replaces the rest lengths of the graph's boundary edges by those that `options` prescribe; both
/// halves of an edge of a triangle mesh get the same factor.
pub(super) fn prescribe(
    options: &MapOptions,
    disc: &OrientedMesh,
    graph: &mut QuadGraph,
) -> Result<Option<Prescribed>, LengthsError> {
    let Some(given) = options.boundary_lengths() else { return Ok(None) };
    let expression = options.expression();
    if !expression.keeps_boundary_lengths() {
        return Err(LengthsError::NotKept { energy: expression.to_string() });
    }
    let values = in_order(given, disc)?;
    let halves = graph.boundary.len() / disc.boundary.len();
    let mut log_factors = Vec::with_capacity(graph.boundary.len());
    for (rest, value) in graph.boundary_length.chunks_exact_mut(halves).zip(values) {
        let factor = match given.unit {
            LengthUnit::Lengths => value / rest.iter().sum::<f64>(),
            LengthUnit::Factors => value,
        };
        rest.iter_mut().for_each(|length| *length *= factor);
        log_factors.extend(rest.iter().map(|_| factor.ln()));
    }
    let length = |k: usize| graph.boundary_length[halves * k..halves * (k + 1)].iter().sum::<f64>();
    let whole = graph.perimeter();
    if let Some(k) = (0..disc.boundary.len()).find(|&k| length(k) >= whole - length(k)) {
        let [v, w] = ends(disc, k);
        return Err(LengthsError::Open { v, w, length: length(k), others: whole - length(k) });
    }
    Ok(Some(Prescribed { unit: given.unit, log_factors }))
}

/// Returns the numbers in the order of the edges along the boundary.
fn in_order(given: &BoundaryLengths, disc: &OrientedMesh) -> Result<Vec<f64>, LengthsError> {
    let edges = disc.boundary.len();
    let named = match &given.values {
        PerEdge::InOrder(values) if values.len() == edges => return Ok(values.clone()),
        PerEdge::InOrder(values) => return Err(LengthsError::Count { found: values.len(), edges }),
        PerEdge::ByEnds(named) => named,
    };
    let unordered = |[v, w]: [u32; 2]| [v.min(w), v.max(w)];
    let mut position = HashMap::with_capacity(edges);
    let mut twice = HashMap::new();
    for k in 0..edges {
        if let Some(other) = position.insert(unordered(ends(disc, k)), k) {
            twice.insert(unordered(ends(disc, k)), other);
        }
    }
    let mut values = vec![None; edges];
    for &([v, w], value) in named {
        let Some(&k) = position.get(&unordered([v, w])) else { return Err(LengthsError::NoSuchEdge { v, w }) };
        if twice.contains_key(&unordered([v, w])) {
            return Err(LengthsError::Ambiguous { v, w });
        }
        values[k] = Some(value);
    }
    let missing = |k: usize| {
        let [v, w] = ends(disc, k);
        LengthsError::Missing { v, w, edges }
    };
    values.into_iter().enumerate().map(|(k, value)| value.ok_or_else(|| missing(k))).collect()
}

/// The ends of the `k`-th boundary edge, as indices of the source.
fn ends(disc: &OrientedMesh, k: usize) -> [u32; 2] {
    [k, (k + 1) % disc.boundary.len()].map(|k| disc.source_vertex[disc.boundary[k] as usize])
}

/// The accuracy with which prescribed lengths are attained.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LengthsRecord {
    /// The unit in which they were given: `lengths`, or `factors` of the lengths on the surface.
    pub given: LengthUnit,
    /// Number of edges of the mesh's boundary.
    pub edges: usize,
    /// Sum of the prescribed lengths.
    pub perimeter: f64,
    /// | |e|/l − 1 | over the mesh's boundary edges.
    pub error: MeanMax,
    /// The same; reports have both names.
    pub mesh_error: MeanMax,
}

impl LengthsRecord {
    /// Makes the record of a map of the graph, whose boundary lengths are the prescribed ones.
    pub fn new(prescribed: &Prescribed, disc: &OrientedMesh, graph: &QuadGraph, z: &[Complex64]) -> Self {
        let error = boundary_errors(disc, graph, z);
        LengthsRecord {
            given: prescribed.unit,
            edges: disc.boundary.len(),
            perimeter: graph.perimeter(),
            error,
            mesh_error: error,
        }
    }
}

/// | |e|/l − 1 | over the mesh's boundary edges in the map that puts the vertices at `z`. l are the boundary lengths of `graph`, of a
/// triangle's edge those of its halves together.
pub(super) fn boundary_errors(disc: &OrientedMesh, graph: &QuadGraph, z: &[Complex64]) -> MeanMax {
    let n = graph.boundary.len();
    let step = n / disc.boundary.len();
    let error = |k: usize| {
        let length: f64 = graph.boundary_length[k..k + step].iter().sum();
        let [a, b] = [k, (k + step) % n].map(|k| z[graph.boundary[k] as usize]);
        ((b - a).norm() / length - 1.0).abs()
    };
    let errors = || (0..n).step_by(step).map(error);
    MeanMax {
        mean: errors().sum::<f64>() / (n / step) as f64,
        max: errors().fold(0.0, |a, b| if a >= b { a } else { b }),
    }
}
