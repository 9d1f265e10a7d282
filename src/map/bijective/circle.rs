//! The bijective map to the unit disc.

use std::f64::consts::PI;

use num_complex::Complex64;

use super::{Repair, Stage, middle_of_arc};
use crate::constraint::{Fixed, Freedoms, on_circle, on_circle_apart};
use crate::geometry::moebius::Moebius;
use crate::map::{Exactly, Map, MapError};
use crate::problem::nonlinear::Objective;
use crate::solver::{Observer, Status};

impl Repair<'_> {
    /// Minimises MIPS from a convex combination map, with the boundary sliding on the circle; then again, with the
    /// boundary points pinned that the conformal map pins.
    ///
    /// If double precision does not suffice for the map with these points at their positions, only one is pinned.
    pub(super) fn circle(&self, watch: &mut dyn Observer) -> Result<Map, MapError> {
        let (stage, one) = self.least_shear(watch)?;
        let (stage, fixed, anchored) = match self.at_anchors(&stage) {
            Some((stage, fixed)) => (stage, fixed, self.setup.normalisation.exact),
            None => (stage, one, false),
        };
        let has_come_to_its_end = matches!(stage.status, Status::Converged | Status::Precision);
        let stage = match has_come_to_its_end && !stage.is_over(self.left) {
            true => self.shear_less(stage, &fixed, watch)?,
            false => stage,
        };
        Ok(Map { on_circle: true, exactly: Some(Exactly::Circle), anchored, ..self.map(stage, fixed) })
    }

    /// Moves a map by the Möbius map of the disc that takes the pinned boundary points to their positions. Returns it
    /// with its pinned vertices, or `None` if it is not bijective.
    fn at_anchors(&self, stage: &Stage) -> Option<(Stage, Fixed)> {
        let graph = &self.setup.domain.graph;
        let fixed = self.setup.normalisation.fixed(graph);
        let three = self.three_points()?.map(|(k, place)| (graph.boundary[k], place));
        let moebius = Moebius::through(three.map(|(v, _)| stage.z[v as usize]), three.map(|(_, place)| place)).ok()?;
        let mut z: Vec<Complex64> = stage.z[..graph.primal].iter().map(|&z| moebius.at(z)).collect();
        for &v in graph.boundary.iter().filter(|&&v| !graph.is_dual(v)) {
            let place = z[v as usize];
            z[v as usize] = fixed.place(v).unwrap_or(place / place.norm());
        }
        if !self.setup.domain.is_one_to_one(&z) {
            return None;
        }
        let z = self.with_dual_vertices(z);
        // Angles are rounded, and so are the positions computed from them.
        let objective = self.shear(&fixed).ok()?;
        let y = objective.freedoms.restrict(&z);
        let total = Some(objective.value(&y)).filter(|total| total.is_finite())?;
        let gradient_norm = objective.gradient(&y).iter().map(|g| g * g).sum::<f64>().sqrt();
        let energies = objective.values(&y);
        let moved = Stage { z, total: Some(total), energies, gradient_norm: Some(gradient_norm), ..stage.clone() };
        Some((moved, fixed))
    }

    /// Returns the boundary indices and positions of the pinned points; beside two of them a third, by arc length.
    fn three_points(&self) -> Option<[(usize, Complex64); 3]> {
        let (graph, points) = (&self.setup.domain.graph, &self.setup.normalisation.points);
        let mut three: Vec<(usize, Complex64)> = points.iter().map(|&(k, angle)| (k, Complex64::cis(angle))).collect();
        if let [(first, _), (second, _)] = points[..] {
            let n = graph.boundary.len();
            let arc = on_circle(graph, 1.0, points).ok()?;
            // The third point halves the longer of the two ways.
            let (from, to) = if 2 * (second - first) > n { (first, second) } else { (second, first + n) };
            let mesh = (from + 1..to).map(|k| k % n).filter(|&k| !graph.is_dual(graph.boundary[k]));
            let middle: Vec<usize> = mesh.collect();
            let k = *middle.get(middle.len() / 2)?;
            three.push((k, arc.place(graph.boundary[k])?));
        }
        three.try_into().ok()
    }

    /// Minimises MIPS on the disc with one pinned boundary point: with three, long parts of the surface converge far
    /// more slowly.
    pub(super) fn least_shear(&self, watch: &mut dyn Observer) -> Result<(Stage, Fixed), MapError> {
        let graph = &self.setup.domain.graph;
        let whole = on_circle_apart(graph)?;
        let mut fixed = Fixed::default();
        fixed.hold(graph.boundary[0], Complex64::ONE);
        let objective = self.shear(&fixed)?;
        let padded = |z: &[Complex64]| {
            let mut z = z.to_vec();
            z.resize(graph.vertices, Complex64::ZERO);
            z
        };
        // Angles are rounded, and so are the positions computed from them.
        let suits = |z: &[Complex64]| objective.value(&objective.freedoms.restrict(&padded(z))).is_finite();
        let z = self.setup.domain.convex_start(&whole, &suits, watch)?;
        let stage = self.minimise(&objective, Stage::start(padded(&z)), watch)?;
        Ok((self.with_dual_vertices_placed(stage), fixed))
    }

    /// Minimises MIPS from a stage, with these points pinned.
    fn shear_less(&self, stage: Stage, fixed: &Fixed, watch: &mut dyn Observer) -> Result<Stage, MapError> {
        let stage = self.minimise(&self.shear(fixed)?, stage, watch)?;
        Ok(self.with_dual_vertices_placed(stage))
    }

    /// The objective MIPS over the vertices of the mesh, scaled to a disc of area π.
    fn shear(&self, fixed: &Fixed) -> Result<Objective, MapError> {
        let graph = &self.setup.domain.graph;
        // MIPS does not depend on dual vertices.
        let mut held = fixed.clone();
        (graph.primal..graph.vertices).for_each(|v| held.hold(v as u32, Complex64::ZERO));
        let mesh: Vec<u32> = graph.boundary.iter().copied().filter(|&v| !graph.is_dual(v)).collect();
        let freedoms = Freedoms::sliding(graph.vertices, &held, &mesh);
        Ok(self.objective(self.mips(PI)?, freedoms))
    }

    fn with_dual_vertices_placed(&self, mut stage: Stage) -> Stage {
        stage.z.truncate(self.setup.domain.graph.primal);
        stage.z = self.with_dual_vertices(stage.z);
        stage
    }

    /// Places dual vertices at the barycentres of the image's faces, and those of boundary edges at the midpoints of
    /// their arcs.
    fn with_dual_vertices(&self, z: Vec<Complex64>) -> Vec<Complex64> {
        let graph = &self.setup.domain.graph;
        let mut z = self.setup.domain.with_dual_vertices(z, &Fixed::default());
        let n = graph.boundary.len();
        for k in (0..n).filter(|&k| graph.is_dual(graph.boundary[k])) {
            let [a, b] = [(k + n - 1) % n, (k + 1) % n].map(|k| z[graph.boundary[k] as usize]);
            z[graph.boundary[k] as usize] = middle_of_arc(a, b);
        }
        z
    }
}
