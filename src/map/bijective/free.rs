//! The valid map with a free boundary.

use num_complex::Complex64;

use super::{Patience, Repair, Stage};
use crate::constraint::{Fixed, Freedoms};
use crate::energy::conformal::Weight;
use crate::energy::{Clearance, Metric};
use crate::map::gauge::hold_mesh_gauge;
use crate::map::{Map, MapError, Valid};
use crate::problem::nonlinear::Objective;
use crate::solver::{Observer, Status};

/// Coefficients of L', stage after stage: at first the boundary keeps its lengths, at last it may follow the shapes of the faces.
const LENGTHS: [f64; 2] = [1.0, 1e-2];

/// One more where nothing but the shear counts.
const HARDLY: f64 = 1e-4;

/// The coefficient of the barrier that keeps the boundary off itself.
const CLEARANCE: f64 = 0.1;

/// An iteration with it takes ten times as long as one without.
const PATIENCE: Patience = Patience { faces_times_iterations: 1_500_000, iterations: 200..=1000 };

/// Iterations after which the barrier is made anew: by then other parts of the boundary are near each other, and of another size.
const ROUND: usize = 10;

impl Repair<'_> {
    /// MIPS + γ'L' over the mesh's own boundary edges, from the map onto the disc scaled to about the surface's area: no face folds, and far
    /// parts of the boundary may overlap. Where the result does so and must not, or lies on itself around a vertex, once more with a
    /// barrier between parts of the boundary: every iterate is then one-to-one.
    pub(super) fn free(&self, watch: &mut dyn Observer) -> Result<Map, MapError> {
        let graph = &self.setup.domain.graph;
        let (mut disc, _) = self.least_shear(watch)?;
        // By a power of two: nothing is rounded.
        let scale =
            2f64.powf((0.5 * (self.metric.surface_area() / self.setup.domain.image_area(&disc.z)).log2()).round());
        disc.z.iter_mut().for_each(|z| *z *= scale);
        let mut fixed = Fixed::default();
        hold_mesh_gauge(&mut fixed, true, graph, &disc.z);
        let mut held = fixed.clone();
        (graph.primal..graph.vertices).for_each(|v| held.hold(v as u32, Complex64::ZERO));
        let mut stage = self.flatten(disc.clone(), &held, Overlaps::Allowed, watch)?;
        if !self.accepts(&stage) {
            disc.iterations = stage.iterations;
            disc.status = stage.status;
            stage = self.flatten(disc, &held, Overlaps::Barred, watch)?;
        }
        stage.z.truncate(graph.primal);
        stage.z = self.setup.domain.with_dual_vertices(std::mem::take(&mut stage.z), &Fixed::default());
        Ok(self.map(stage, fixed))
    }

    /// The minimum of MIPS + γ'L' near a stage, for one γ' after the other.
    fn flatten(
        &self,
        mut stage: Stage,
        held: &Fixed,
        overlaps: Overlaps,
        watch: &mut dyn Observer,
    ) -> Result<Stage, MapError> {
        let lengths = match overlaps {
            Overlaps::Allowed => &LENGTHS[..],
            // A boundary that must become longer at once is crumpled, and so jams.
            Overlaps::Barred => &LENGTHS[1..],
        };
        let last = (self.setup.options.valid == Valid::BestQc).then_some(HARDLY);
        for coefficient in lengths.iter().copied().chain(last) {
            if stage.is_over(self.left) {
                break;
            }
            stage = match overlaps {
                Overlaps::Allowed => self.minimise(&self.flat(coefficient, held)?, stage, watch)?,
                Overlaps::Barred => self.minimise_apart(coefficient, stage, held, watch)?,
            };
        }
        Ok(stage)
    }

    /// The same for one γ', the boundary kept off itself.
    fn minimise_apart(
        &self,
        coefficient: f64,
        mut stage: Stage,
        held: &Fixed,
        watch: &mut dyn Observer,
    ) -> Result<Stage, MapError> {
        let end = stage.iterations + PATIENCE.with(self.setup.domain.disc.faces.len());
        loop {
            let mut objective = self.flat(coefficient, held)?;
            objective.terms.push((CLEARANCE, Box::new(Clearance::new(&self.setup.domain.graph, &stage.z))));
            let round = ROUND.min(end - stage.iterations);
            stage = self.minimise_within(round, &objective, stage, watch)?;
            if stage.status != Status::MaxIterations || stage.iterations >= end || stage.is_over(self.left) {
                return Ok(stage);
            }
        }
    }

    /// MIPS + γ'L'.
    fn flat(&self, coefficient: f64, held: &Fixed) -> Result<Objective, MapError> {
        let mut terms = self.mips(self.metric.surface_area())?;
        terms.push((coefficient, Box::new(Metric::mesh_boundary_edges(self.rest(&[], Weight::Integral)))));
        Ok(self.objective(terms, Freedoms::new(self.setup.domain.graph.vertices, held)))
    }
}

/// Whether far parts of a map may lie on each other.
#[derive(Clone, Copy)]
enum Overlaps {
    Allowed,
    Barred,
}
