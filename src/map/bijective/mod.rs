//! Bijective maps: they replace a conformal map that is not injective (design: §10).
//!
//! Every replacement starts from a convex combination map that passes the exact check. Newton's method then
//! minimises an energy that is +∞ where a face is flipped. So every iterate is injective, and a minimisation that
//! is interrupted leaves an injective map.

mod circle;
mod free;
mod in_order;
mod patch;
mod unflip;

use std::f64::consts::PI;
use std::ops::RangeInclusive;

use num_complex::Complex64;

use super::provenance::{Provenance, Replaced, Replacement};
use super::setup::Setup;
use super::{Boundary, Ending, Map, MapError};
use crate::constraint::{Fixed, Freedoms};
use crate::energy::conformal::{Dirichlet, Weight};
use crate::energy::{Mips, Rest};
use crate::problem::nonlinear::{Objective, Terms};
use crate::quad_graph::metric::RestMetric;
use crate::solver::minimise::Newton;
use crate::solver::{self, MinimiseError, Minimiser, Observer, Status, StopRule};

/// The name of the solver in reports.
const SOLVER: &str = "newton";

/// The default for the largest number of iterations of one stage: fewer for larger meshes, within bounds.
struct Patience {
    faces_times_iterations: usize,
    iterations: RangeInclusive<usize>,
}

impl Patience {
    fn with(&self, faces: usize) -> usize {
        (self.faces_times_iterations / faces).clamp(*self.iterations.start(), *self.iterations.end())
    }
}

/// Long protrusions converge slowly, by a few per cent a step; the map reached by then is injective.
const PATIENCE: Patience = Patience { faces_times_iterations: 10_000_000, iterations: 150..=1000 };

/// Unflips the flipped faces of the conformal map `plain` in place and leaves all others as they are. Returns `None`
/// if that does not suffice; and the number of iterations of both.
///
/// # Errors
/// A factorisation breaks down.
pub(super) fn unflipped(
    setup: &Setup,
    plain: &Map,
    watch: &mut dyn Observer,
) -> Result<(Option<Map>, usize), MapError> {
    let left = setup.options.max_iterations.map(|n| n.saturating_sub(plain.iterations));
    let (found, more) = unflip::around_flipped(setup, plain, left, watch)?;
    let iterations = plain.iterations + more;
    let flipped = || Some(setup.domain.folded(&plain.z).len());
    let replaced = || Some(Replaced { by: Replacement::Locally, flipped: flipped() });
    let of = |map: Map| Provenance { replaced: replaced(), ..map.provenance };
    Ok((found.map(|map| Map { iterations, provenance: of(map.clone()), ..map }), iterations))
}

/// Computes a bijective map of low quasi-conformal distortion, after `spent` iterations of other methods. With a free
/// boundary the map is locally injective, and bijective if that is asked for.
///
/// # Errors
/// No convex combination map passes the exact check; a factorisation breaks down.
pub(super) fn replacement(setup: &Setup, spent: usize, watch: &mut dyn Observer) -> Result<Map, MapError> {
    let Setup { options, domain, .. } = setup;
    watch.repair(solver::Repair::Whole);
    let metric = domain.rest_metric(options)?.with_open_corners(&domain.disc, domain.planes.as_ref());
    let left = options.max_iterations.map(|n| n.saturating_sub(spent));
    let repair = Repair { setup, metric: &metric, left };
    let map = match options.boundary {
        Boundary::Free { .. } => repair.free(watch),
        _ => repair.circle(watch),
    }?;
    Ok(Map { iterations: map.iterations + spent, ..map })
}

/// Returns the midpoint of the counter-clockwise arc of the unit circle from a to b.
fn middle_of_arc(a: Complex64, b: Complex64) -> Complex64 {
    a * Complex64::cis(0.5 * (b * a.conj()).arg().rem_euclid(2.0 * PI))
}

/// The data of a replacement.
struct Repair<'a> {
    setup: &'a Setup<'a>,
    metric: &'a RestMetric,
    /// The number of iterations left, if there is a limit.
    left: Option<usize>,
}

/// An injective map between two minimisations.
#[derive(Clone)]
struct Stage {
    z: Vec<Complex64>,
    energies: Vec<(&'static str, f64)>,
    total: Option<f64>,
    gradient_norm: Option<f64>,
    status: Status,
    /// The number of iterations of all stages.
    iterations: usize,
}

impl Stage {
    /// A map before any minimisation.
    fn start(z: Vec<Complex64>) -> Self {
        Stage { z, energies: Vec::new(), total: None, gradient_norm: None, status: Status::Precision, iterations: 0 }
    }

    /// Whether the minimisation was interrupted, or the iterations of all stages are used up.
    fn is_over(&self, left: Option<usize>) -> bool {
        self.status == Status::Interrupted || left.is_some_and(|n| self.iterations >= n)
    }
}

impl Repair<'_> {
    fn rest<'b>(&'b self, held: &'b [bool], weight: Weight) -> Rest<'b> {
        Rest { graph: &self.setup.domain.graph, metric: self.metric, weight, held }
    }

    /// The mean of MIPS over the faces, regardless of their areas, times `unit`.
    ///
    /// # Rationale
    /// The mean of σ1/σ2 counts faces alike. Weighted by area, the small faces of fine parts hardly count, and these
    /// are the most distorted.
    fn mips(&self, unit: f64) -> Result<Terms, MapError> {
        let mips = Mips::new(self.rest(&[], Weight::Unit))?;
        let faces: f64 = self.metric.triangles.iter().map(|t| t.share).sum();
        Ok(vec![(unit / faces, Box::new(mips))])
    }

    fn objective(&self, terms: Terms, freedoms: Freedoms) -> Objective {
        Objective { terms, freedoms, norm: Dirichlet::new(&self.setup.domain.graph, Weight::Integral) }
    }

    /// Minimises from `stage`, by as many iterations as are left.
    fn minimise(&self, objective: &Objective, stage: Stage, watch: &mut dyn Observer) -> Result<Stage, MapError> {
        self.minimise_within(PATIENCE.with(self.setup.domain.disc.faces.len()), objective, stage, watch)
    }

    /// Minimises from `stage` by at most `most` iterations.
    fn minimise_within(
        &self,
        most: usize,
        objective: &Objective,
        stage: Stage,
        watch: &mut dyn Observer,
    ) -> Result<Stage, MapError> {
        minimise(objective, stage, Limits { left: self.left, most, gain: self.setup.options.tolerance }, watch)
    }

    /// Whether the exact check accepts the map of a stage.
    fn accepts(&self, stage: &Stage) -> bool {
        self.setup.accepts(&stage.z)
    }

    /// The map of a stage, with its record.
    fn map(&self, stage: Stage, fixed: Fixed) -> Map {
        Map {
            total: stage.total,
            gradient_norm: stage.gradient_norm,
            energies: stage.energies,
            ending: Ending::Minimised(stage.status),
            iterations: stage.iterations,
            ..Map::solved(SOLVER, stage.z, fixed, None)
        }
    }
}

/// The limits of one stage.
struct Limits {
    /// The number of iterations left for all stages, if there is a limit.
    left: Option<usize>,
    /// The largest number of iterations of this stage.
    most: usize,
    /// The least relative decrease of the energy by a step.
    gain: f64,
}

/// Minimises from `stage`. If parts of the map are so small that rounding flips a face as soon as positions are
/// converted to unknowns, the stage is returned as it is.
fn minimise(objective: &Objective, stage: Stage, limits: Limits, watch: &mut dyn Observer) -> Result<Stage, MapError> {
    let start = objective.freedoms.restrict(&stage.z);
    if !objective.value(&start).is_finite() {
        return Ok(Stage { status: Status::Precision, ..stage });
    }
    let left = limits.left.map_or(limits.most, |n| limits.most.min(n.saturating_sub(stage.iterations)));
    // The decrease by a step decides: the gradient of a start with parts of the size 1e-20 is no measure.
    let rule = StopRule { tolerance: f64::MIN_POSITIVE, reference: None, max_iterations: Some(left) };
    let newton = Newton { smallest_gain: limits.gain };
    let minimum = match newton.minimise(objective, start, rule, watch) {
        Err(MinimiseError::StartNotFinite) => return Ok(Stage { status: Status::Precision, ..stage }),
        minimum => minimum?,
    };
    let energies = objective.values(&minimum.y);
    Ok(Stage {
        z: objective.freedoms.expand(&minimum.y),
        total: Some(objective.terms.iter().zip(&energies).map(|((t, _), (_, e))| t * e).sum()),
        energies,
        gradient_norm: Some(minimum.gradient_norm),
        status: minimum.status,
        iterations: stage.iterations + minimum.iterations,
    })
}
