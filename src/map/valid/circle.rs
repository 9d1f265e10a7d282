//! The valid map onto the unit disc.

use std::f64::consts::PI;

use num_complex::Complex64;

use super::{Repair, Stage};
use crate::backend::Observer;
use crate::constraint::{Fixed, Freedoms, on_circle_apart};
use crate::map::{Exactly, Map, MapError};

impl Repair<'_> {
    /// MIPS with the boundary sliding on the circle, from a convex combination map.
    pub(super) fn circle(&self, watch: &mut dyn Observer) -> Result<Map, MapError> {
        let (stage, fixed) = self.least_shear(watch)?;
        Ok(Map { on_circle: true, exactly: Some(Exactly::Circle), ..self.map(stage, fixed) })
    }

    /// The lowest MIPS on the disc. One boundary point is held: with three, long parts of the surface converge far more slowly.
    pub(super) fn least_shear(&self, watch: &mut dyn Observer) -> Result<(Stage, Fixed), MapError> {
        let graph = &self.domain.graph;
        let whole = on_circle_apart(graph)?;
        let mut fixed = Fixed::default();
        fixed.hold(graph.boundary[0], Complex64::ONE);
        // MIPS does not see dual vertices.
        let mut held = fixed.clone();
        (graph.primal..graph.vertices).for_each(|v| held.hold(v as u32, Complex64::ZERO));
        let mesh: Vec<u32> = graph.boundary.iter().copied().filter(|&v| !graph.is_dual(v)).collect();
        let freedoms = Freedoms::sliding(graph.vertices, &held, &mesh);
        let objective = self.objective(self.mips(PI)?, freedoms);
        let padded = |z: &[Complex64]| {
            let mut z = z.to_vec();
            z.resize(graph.vertices, Complex64::ZERO);
            z
        };
        // Angles are rounded, and places that come from them.
        let suits = |z: &[Complex64]| objective.value(&objective.freedoms.restrict(&padded(z))).is_finite();
        let z = match self.domain.convex_start(&whole, &suits, watch) {
            Err(MapError::NoValidStart { .. }) => self.domain.convex_start(&whole, &|_| true, watch)?,
            start => start?,
        };
        let mut stage = self.minimise(&objective, Stage::start(padded(&z)), watch)?;
        stage.z.truncate(graph.primal);
        stage.z = self.with_dual_vertices(std::mem::take(&mut stage.z));
        Ok((stage, fixed))
    }

    /// Dual vertices at the barycentres of the image's faces, those of boundary edges in the middle of their arcs.
    fn with_dual_vertices(&self, z: Vec<Complex64>) -> Vec<Complex64> {
        let graph = &self.domain.graph;
        let mut z = self.domain.with_dual_vertices(z, &Fixed::default());
        let n = graph.boundary.len();
        for k in (0..n).filter(|&k| graph.is_dual(graph.boundary[k])) {
            let [a, b] = [(k + n - 1) % n, (k + 1) % n].map(|k| z[graph.boundary[k] as usize]);
            let arc = (b * a.conj()).arg().rem_euclid(2.0 * PI);
            z[graph.boundary[k] as usize] = a * Complex64::cis(0.5 * arc);
        }
        z
    }
}
