//! The valid map onto the unit disc.

use std::f64::consts::PI;

use num_complex::Complex64;

use super::{Repair, Stage};
use crate::backend::Observer;
use crate::constraint::{Fixed, Freedoms, on_circle};
use crate::energy::{Conformal, Gaps};
use crate::map::flip_free::area_at_rest;
use crate::map::{Exactly, Map, MapError, Valid};

/// The share of MIPS beside H, both measured on a disc of area π. The less it is, the nearer the map is to the plain one, and the more
/// the faces that would fold are sheared: on three_peaks.off the mean of σ1/σ2 is 1.38, 1.30, 1.28 and the largest 268, 155, 107 at shares of
/// 0.01, 0.1, 1.
const SHARE_OF_MIPS: f64 = 0.1;

/// The coefficient of the barrier between neighbours on the boundary: without it dual points come so near each other that steps jam.
const BARRIER: f64 = 1e-4;

impl Repair<'_> {
    /// MIPS with the boundary sliding on the circle, from a convex combination map; then H + 0.1 MIPS, unless the least shear is asked for.
    pub(super) fn circle(&self, watch: &mut dyn Observer) -> Result<Map, MapError> {
        let (stage, fixed) = self.least_shear(watch)?;
        let stage = match self.options.valid {
            Valid::BestQc => stage,
            _ if !self.goes_on(&stage) => stage,
            _ => self.finish(stage, &fixed, watch)?,
        };
        Ok(Map { on_circle: true, exactly: Some(Exactly::Circle), ..self.map(stage, fixed) })
    }

    /// The lowest MIPS on the disc. One boundary point is held: with three, long parts of the surface converge far more slowly.
    pub(super) fn least_shear(&self, watch: &mut dyn Observer) -> Result<(Stage, Fixed), MapError> {
        let graph = &self.domain.graph;
        let whole = on_circle(graph, 1.0, &[(0, 0.0)])?;
        let mut fixed = Fixed::default();
        fixed.hold(graph.boundary[0], Complex64::ONE);
        // MIPS does not see dual vertices.
        let mut held = fixed.clone();
        (graph.primal..graph.vertices).for_each(|v| held.hold(v as u32, Complex64::ZERO));
        let mesh: Vec<u32> = graph.boundary.iter().copied().filter(|&v| !graph.is_dual(v)).collect();
        let freedoms = Freedoms::sliding(graph.vertices, &held, &mesh);
        let objective = self.objective(self.mips(PI / area_at_rest(self.metric))?, freedoms);
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

    /// H + 0.1 MIPS, from there.
    fn finish(&self, stage: Stage, fixed: &Fixed, watch: &mut dyn Observer) -> Result<Stage, MapError> {
        let graph = &self.domain.graph;
        let held = vec![false; graph.vertices];
        let mut terms = self.mips(SHARE_OF_MIPS * PI / area_at_rest(self.metric))?;
        terms.insert(0, (1.0, Box::new(Conformal::new(self.rest(&held, self.options.weight))?)));
        terms.push((BARRIER, Box::new(Gaps::new(graph))));
        let freedoms = Freedoms::sliding(graph.vertices, fixed, &graph.boundary);
        self.minimise(&self.objective(terms, freedoms), stage, watch)
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
