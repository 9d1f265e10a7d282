//! The locally injective map with a free boundary.

use num_complex::Complex64;

use super::{Patience, Repair, Stage};
use crate::constraint::{Fixed, Freedoms};
use crate::energy::conformal::Weight;
use crate::energy::{Clearance, Metric};
use crate::map::gauge::hold_mesh_gauge;
use crate::map::{Map, MapError, Valid};
use crate::problem::nonlinear::Objective;
use crate::solver::{Observer, Status};

/// The coefficients of L' of the stages: at first the boundary keeps its lengths, in the end it follows the shapes of
/// the faces.
const LENGTHS: [f64; 2] = [1.0, 1e-2];

/// The coefficient of one more stage if only the quasi-conformal distortion counts.
const HARDLY: f64 = 1e-4;

/// The coefficient of the barrier that keeps parts of the boundary apart.
const CLEARANCE: f64 = 0.1;

/// An iteration with the barrier takes ten times as long as one without.
const PATIENCE: Patience = Patience { faces_times_iterations: 1_500_000, iterations: 200..=1000 };

/// The number of iterations after which the barrier is rebuilt: by then other parts of the boundary are close to each
/// other, and their size has changed.
const ROUND: usize = 10;

impl Repair<'_> {
    /// Minimises MIPS + γ'L', L' over the boundary edges of the mesh, from the map to the disc scaled to about the area
    /// of the surface. No face is flipped, but distant parts of the boundary may overlap. If they do and must not, or
    /// if the map winds around a boundary vertex, the minimisation is repeated with a barrier between parts of the
    /// boundary; every iterate is then bijective.
    pub(super) fn free(&self, watch: &mut dyn Observer) -> Result<Map, MapError> {
        let graph = &self.setup.domain.graph;
        let (mut disc, _) = self.least_shear(watch)?;
        // A power of two, so that nothing is rounded.
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

    /// Minimises MIPS + γ'L' from a stage, for one γ' after the other.
    fn flatten(
        &self,
        mut stage: Stage,
        held: &Fixed,
        overlaps: Overlaps,
        watch: &mut dyn Observer,
    ) -> Result<Stage, MapError> {
        let lengths = match overlaps {
            Overlaps::Allowed => &LENGTHS[..],
            // A boundary that must become longer at once would crumple and jam.
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

    /// Minimises MIPS + γ'L' for one γ', with parts of the boundary kept apart.
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

    /// The objective MIPS + γ'L'.
    fn flat(&self, coefficient: f64, held: &Fixed) -> Result<Objective, MapError> {
        let mut terms = self.mips(self.metric.surface_area())?;
        terms.push((coefficient, Box::new(Metric::mesh_boundary_edges(self.rest(&[], Weight::Integral)))));
        Ok(self.objective(terms, Freedoms::new(self.setup.domain.graph.vertices, held)))
    }
}

/// Whether distant parts of a map may overlap.
#[derive(Clone, Copy)]
enum Overlaps {
    Allowed,
    Barred,
}
