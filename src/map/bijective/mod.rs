//! Valid maps: what takes the place of a plain map that is not one-to-one (design: §10).
//!
//! Everything starts from a convex combination map that passes the exact check, and goes on by Newton's method under an energy that is +∞
//! where a face folds. So every iterate is valid, and a minimisation that is interrupted leaves a valid map.

mod circle;
mod free;
mod hopeless;
mod in_order;
mod near_folds;
mod patch;

pub(super) use hopeless::unless_hopeless;

use std::f64::consts::PI;
use std::ops::RangeInclusive;

use num_complex::Complex64;

use super::nonlinear::{self, Anchors};
use super::{Boundary, Domain, Map, MapError, MapOptions, Outcome, Valid};
use crate::constraint::{ConstraintError, Fixed, Freedoms};
use crate::distortion::{Image, Validity, face_maps};
use crate::energy::conformal::{Dirichlet, Weight};
use crate::energy::{Mips, Rest};
use crate::problem::nonlinear::{Objective, Terms};
use crate::quad_graph::metric::RestMetric;
use crate::solver::minimise::Newton;
use crate::solver::{MinimiseError, Minimiser, Observer, Status, StopRule};

/// The name of the backend in reports.
const BACKEND: &str = "newton (valid)";

/// Iterations of one stage at most, where nothing else is said: the less the larger the mesh is, within bounds.
struct Patience {
    faces_times_iterations: usize,
    iterations: RangeInclusive<usize>,
}

impl Patience {
    fn with(&self, faces: usize) -> usize {
        (self.faces_times_iterations / faces).clamp(*self.iterations.start(), *self.iterations.end())
    }
}

/// Long protrusions converge slowly, by a few per cent a step; what is reached by then is valid.
const PATIENCE: Patience = Patience { faces_times_iterations: 10_000_000, iterations: 150..=1000 };

impl MapOptions {
    /// Whether the plain map is to be replaced where it is not valid.
    pub fn promises_valid(&self) -> bool {
        self.valid != Valid::Off
            && self.energy.is_none()
            && self.pins.is_empty()
            && self.boundary_lengths.is_none()
            && matches!(self.boundary, Boundary::Circle | Boundary::Free)
    }
}

/// The mean of σ1/σ2 above which a circle map is nothing to keep though it folds no face: on coarse meshes with ragged boundaries H is
/// least where some faces are drawn out to needles. Of 200 discs cut out of public meshes 74 had plain maps that fold nothing; 58 of these
/// were above libigl's harmonic map, by factors up to 500. 45 of the 58 are above this mean, the others by a factor of 1.25 at most.
const LARGEST_SHEAR: f64 = 2.0;

/// The plain map where it passes the exact check, which for free maps may overlap itself; else, or where there is none because it did not
/// converge, a valid one. Of a circle map that passes and is sheared by more than 2 in the mean, and of any under [`Valid::BestQc`], that
/// of the two which has less shear.
pub(super) fn kept_or_replaced(
    options: &MapOptions,
    domain: &Domain,
    exact: Option<&[[f64; 2]]>,
    plain: Result<Map, MapError>,
    watch: &mut dyn Observer,
) -> Result<Map, MapError> {
    let (kept, folded, spent) = match plain {
        Ok(map) => {
            let validity = domain.validity(&map.z);
            let spent = map.iterations;
            if accepts(options, &validity) {
                let looks_further = options.valid == Valid::BestQc
                    || (options.boundary == Boundary::Circle && shear(domain, &map) > LARGEST_SHEAR);
                match looks_further {
                    true => (Some(map), None, spent),
                    false => return Ok(map),
                }
            } else {
                match unfolded(options, domain, &map, watch)? {
                    (Some(found), _) => return Ok(found),
                    (None, spent) => (None, Some(validity.folded.len()), spent),
                }
            }
        }
        Err(MapError::NotConverged { iterations, .. }) => (None, None, iterations),
        // A start, or a matrix, beyond the range of doubles: others may be within.
        Err(MapError::Minimise(_) | MapError::Constraint(ConstraintError::NoArcLength(..))) => (None, None, 0),
        Err(MapError::Solve(ref error)) if error.is_of_rounding() => (None, None, 0),
        Err(_) => return plain,
    };
    let metric = domain.rest_metric(options)?.with_open_corners(&domain.disc, domain.planes.as_ref());
    let left = options.max_iterations.map(|n| n.saturating_sub(spent));
    let anchors = match options.boundary {
        Boundary::Free => Anchors::default(),
        // Where arc length does not tell places apart there are none.
        _ => nonlinear::anchors(options, &options.expression(), domain, exact).unwrap_or_default(),
    };
    let repair = Repair { options, domain, metric: &metric, left, anchors };
    let found = match options.boundary {
        Boundary::Free => repair.free(watch),
        _ => repair.circle(watch),
    };
    let found = found.map(|map| Map { iterations: map.iterations + spent, plain_folded: folded, ..map });
    let Some(plain) = kept else { return Ok(Map { repaired: true, ..found? }) };
    let plain_shear = shear(domain, &plain);
    let is_better = |map: &Map| accepts(options, &domain.validity(&map.z)) && shear(domain, map) < plain_shear;
    Ok(match found.ok().filter(is_better) {
        Some(map) => Map { plain_shear: Some(plain_shear), ..map },
        None => plain,
    })
}

/// The mean of σ1/σ2 over the faces.
fn shear(domain: &Domain, map: &Map) -> f64 {
    let faces = face_maps(&domain.disc, &domain.graph, &Image::of_disc(&map.z));
    let (sum, count) = faces
        .iter()
        .filter(|face| face.has_shape())
        .fold((0.0, 0usize), |(sum, count), face| (sum + face.quasi_conformal(), count + 1));
    sum / count.max(1) as f64
}

/// The plain map with its folds taken out where they are, `None` where that does not do; and the iterations of both.
pub(super) fn unfolded(
    options: &MapOptions,
    domain: &Domain,
    plain: &Map,
    watch: &mut dyn Observer,
) -> Result<(Option<Map>, usize), MapError> {
    let left = options.max_iterations.map(|n| n.saturating_sub(plain.iterations));
    let (found, more) = near_folds::near_folds(options, domain, plain, left, watch)?;
    let iterations = plain.iterations + more;
    let folded = || domain.folded(&plain.z).len();
    Ok((found.map(|map| Map { iterations, repaired: true, plain_folded: Some(folded()), ..map }), iterations))
}

/// Whether a map is as one-to-one as is asked for: free maps may overlap, unless otherwise said.
fn accepts(options: &MapOptions, validity: &Validity) -> bool {
    match options.boundary {
        Boundary::Free if options.valid != Valid::OneToOne => validity.is_locally_one_to_one(),
        _ => validity.is_one_to_one(),
    }
}

/// The point in the middle of the arc of the unit circle from a to b, counter-clockwise.
fn middle_of_arc(a: Complex64, b: Complex64) -> Complex64 {
    a * Complex64::cis(0.5 * (b * a.conj()).arg().rem_euclid(2.0 * PI))
}

/// What a repair knows.
struct Repair<'a> {
    options: &'a MapOptions,
    domain: &'a Domain,
    metric: &'a RestMetric,
    /// Iterations that are left, where there is a limit.
    left: Option<usize>,
    /// Circle maps: the points that the plain map holds.
    anchors: Anchors,
}

/// A valid map on its way, and what is known of it.
#[derive(Clone)]
struct Stage {
    z: Vec<Complex64>,
    energies: Vec<(&'static str, f64)>,
    total: Option<f64>,
    gradient_norm: Option<f64>,
    status: Status,
    /// Of all stages.
    iterations: usize,
}

impl Stage {
    /// A map that nothing has been minimised on.
    fn start(z: Vec<Complex64>) -> Self {
        Stage { z, energies: Vec::new(), total: None, gradient_norm: None, status: Status::Precision, iterations: 0 }
    }

    /// Whether nothing more is to be done, with so many iterations of all stages where there is a limit.
    fn is_over(&self, left: Option<usize>) -> bool {
        self.status == Status::Interrupted || left.is_some_and(|n| self.iterations >= n)
    }
}

impl Repair<'_> {
    fn rest<'b>(&'b self, held: &'b [bool], weight: Weight) -> Rest<'b> {
        Rest { graph: &self.domain.graph, metric: self.metric, weight, held }
    }

    /// MIPS as the mean over the faces, whatever their areas, times `unit`: that is what the mean of σ1/σ2 sees. Weighted by area the faces
    /// of fine parts hardly count, and theirs is the shear.
    fn mips(&self, unit: f64) -> Result<Terms, MapError> {
        let mips = Mips::new(self.rest(&[], Weight::Unit))?;
        let faces: f64 = self.metric.triangles.iter().map(|t| t.share).sum();
        Ok(vec![(unit / faces, Box::new(mips))])
    }

    fn objective(&self, terms: Terms, freedoms: Freedoms) -> Objective {
        Objective { terms, freedoms, norm: Dirichlet::new(&self.domain.graph, Weight::Integral) }
    }

    /// Goes on from `stage`, by as many iterations as are left.
    fn minimise(&self, objective: &Objective, stage: Stage, watch: &mut dyn Observer) -> Result<Stage, MapError> {
        self.minimise_within(PATIENCE.with(self.domain.disc.faces.len()), objective, stage, watch)
    }

    /// The same by so many iterations at most.
    fn minimise_within(
        &self,
        most: usize,
        objective: &Objective,
        stage: Stage,
        watch: &mut dyn Observer,
    ) -> Result<Stage, MapError> {
        minimise(objective, stage, Limits { left: self.left, most, gain: self.options.tolerance }, watch)
    }

    /// Whether the exact check accepts the map that a stage has reached.
    fn accepts(&self, stage: &Stage) -> bool {
        accepts(self.options, &self.domain.validity(&stage.z))
    }

    /// The map that a stage has reached.
    fn map(&self, stage: Stage, fixed: Fixed) -> Map {
        Map {
            total: stage.total,
            gradient_norm: stage.gradient_norm,
            energies: stage.energies,
            outcome: Outcome::Minimised(stage.status),
            iterations: stage.iterations,
            ..Map::solved(BACKEND, stage.z, fixed, None)
        }
    }
}

/// When a stage ends.
struct Limits {
    /// Iterations of all stages, where there is a limit.
    left: Option<usize>,
    /// Iterations of this one at most.
    most: usize,
    /// The share of the energy that a step must gain.
    gain: f64,
}

/// Goes on from `stage`. Where parts are so small that rounding folds a face as soon as places become unknowns, it stays where it is.
fn minimise(objective: &Objective, stage: Stage, limits: Limits, watch: &mut dyn Observer) -> Result<Stage, MapError> {
    let start = objective.freedoms.restrict(&stage.z);
    if !objective.value(&start).is_finite() {
        return Ok(Stage { status: Status::Precision, ..stage });
    }
    let left = limits.left.map_or(limits.most, |n| limits.most.min(n.saturating_sub(stage.iterations)));
    // What a step may gain decides: the gradient of a start with parts of the size 1e-20 is no measure.
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
