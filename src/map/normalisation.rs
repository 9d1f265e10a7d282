//! The boundary points that are pinned to make a circle map unique.

use std::f64::consts::TAU;

use num_complex::Complex64;

use super::setup::is_circle;
use super::{Domain, MapError, MapOptions};
use crate::constraint::{Fixed, on_circle, spread_points};
use crate::energy::Expression;
use crate::quad_graph::QuadGraph;
use crate::surface::oriented_mesh::OrientedMesh;

/// The largest distance of a pinned boundary vertex from the unit circle: positions are often typed with three digits.
const PIN_ON_CIRCLE: f64 = 1e-3;

/// The normalisation points of a circle map, in ascending order along the boundary.
#[derive(Default)]
pub(super) struct Normalisation {
    /// The boundary indices of the points and their angles.
    pub points: Vec<(usize, f64)>,
    /// Whether the angles are those of the exact map of the surface.
    pub exact: bool,
}

impl Normalisation {
    /// Chooses the points and their angles; none unless the map is a circle map. `exact` are exact conformal
    /// coordinates.
    ///
    /// # Errors
    /// Pins contradict the circle; the boundary has no length.
    pub fn new(
        options: &MapOptions,
        expression: &Expression,
        domain: &Domain,
        exact: Option<&[[f64; 2]]>,
    ) -> Result<Self, MapError> {
        if !is_circle(options, expression) {
            return Ok(Normalisation::default());
        }
        let Domain { disc, graph, .. } = domain;
        if options.holds_more() {
            return Normalisation::of_pins(options, disc, graph);
        }
        // With lengths or areas in the energy only a rotation is free, and the direction of one point fixes it.
        if expression.fixes_scale() {
            return Ok(Normalisation { points: vec![(0, 0.0)], exact: false });
        }
        let positions = spread_points(graph, options.pinned_points().count());
        let arc = on_circle(graph, 1.0, &[(0, 0.0)])?;
        let place = |k: usize| match exact.and_then(|w| w.get(disc.source_vertex[graph.boundary[k] as usize] as usize))
        {
            Some(&[x, y]) => Complex64::new(x, y),
            None => arc.place(graph.boundary[k]).unwrap_or_default(),
        };
        let places = positions.iter().map(|&k| (k, place(k)));
        let points = increasing_angles(places).unwrap_or_else(|_| vec![(0, 0.0)]);
        Ok(Normalisation { points, exact: exact.is_some() })
    }

    /// The points that pins and constraints prescribe on the boundary.
    fn of_pins(options: &MapOptions, disc: &OrientedMesh, graph: &QuadGraph) -> Result<Self, MapError> {
        let mut fixed = Fixed::default();
        options.hold(&mut fixed, disc, graph)?;
        let mut is_boundary = vec![false; graph.vertices];
        for &v in &graph.boundary {
            is_boundary[v as usize] = true;
        }
        for (v, place) in fixed.iter() {
            let (vertex, radius) = (disc.source_vertex[v as usize], place.norm());
            match is_boundary[v as usize] {
                true if (radius - 1.0).abs() > PIN_ON_CIRCLE => return Err(MapError::PinOffCircle { vertex, radius }),
                false if radius >= 1.0 - PIN_ON_CIRCLE => return Err(MapError::PinOutside { vertex, radius }),
                _ => {}
            }
        }
        let on_boundary = (0..graph.boundary.len()).filter_map(|k| Some((k, fixed.place(graph.boundary[k])?)));
        let points = increasing_angles(on_boundary.filter(|(_, place)| place.norm() > 0.0))
            .map_err(|k| MapError::PinsOutOfOrder { vertex: disc.source_vertex[graph.boundary[k] as usize] })?;
        Ok(Normalisation { points: if points.is_empty() { vec![(0, 0.0)] } else { points }, exact: false })
    }

    /// The pinned vertices, each on the unit circle.
    pub fn fixed(&self, graph: &QuadGraph) -> Fixed {
        let mut fixed = Fixed::default();
        for &(k, angle) in &self.points {
            fixed.hold(graph.boundary[k], Complex64::cis(angle));
        }
        fixed
    }

    /// The points, or the first boundary vertex at angle 0 if there are none.
    pub fn or_first(&self) -> &[(usize, f64)] {
        if self.points.is_empty() { &[(0, 0.0)] } else { &self.points }
    }
}

/// Returns the angles of positions along the boundary, increasing by less than 2π in all.
///
/// # Errors
/// The boundary index of the first position that is out of order.
fn increasing_angles(places: impl Iterator<Item = (usize, Complex64)>) -> Result<Vec<(usize, f64)>, usize> {
    let mut points: Vec<(usize, f64)> = Vec::new();
    for (k, place) in places {
        let angle = match points.first() {
            None => place.arg(),
            Some(&(_, first)) => first + (place / Complex64::cis(first)).arg().rem_euclid(TAU),
        };
        if points.last().is_some_and(|&(_, last)| angle <= last) {
            return Err(k);
        }
        points.push((k, angle));
    }
    Ok(points)
}
