//! When a plain map is given up before it has converged.

use crate::map::{Domain, MapError};
use crate::problem::nonlinear::Objective;
use crate::solver::{Minimum, Observer, Status, StopRule};

/// Iterations after which one looks.
const LOOK: usize = 15;

/// The share of the faces, folded by then, that no minimisation was seen to unfold.
const HOPELESS: f64 = 0.02;

/// Iterations at most.
const MOST: usize = 150;

/// What `run` makes under `rule`, from the beginning, if it has converged after [`LOOK`] iterations or folds few faces by then.
///
/// # Errors
/// [`MapError::NotConverged`] where it is given up; those of `run`.
pub(in crate::map) fn unless_hopeless(
    domain: &Domain,
    objective: &Objective,
    rule: StopRule,
    watch: &mut dyn Observer,
    run: impl Fn(StopRule, &mut dyn Observer) -> Result<(Minimum, usize), MapError>,
) -> Result<(Minimum, usize), MapError> {
    if rule.max_iterations.is_some_and(|n| n <= LOOK) {
        return run(rule, watch);
    }
    let (first, iterations) = run(StopRule { max_iterations: Some(LOOK), ..rule }, watch)?;
    if first.status != Status::MaxIterations {
        return Ok((first, iterations));
    }
    let z = objective.freedoms.expand(&first.y);
    let folded = domain.validity(&z).folded.len();
    if folded as f64 > HOPELESS * domain.disc.faces.len() as f64 {
        return Err(MapError::NotConverged {
            backend: "levenberg-marquardt",
            status: first.status.name(),
            iterations,
            reduction: first.reduction(),
            tolerance: rule.tolerance,
        });
    }
    run(StopRule { max_iterations: rule.max_iterations.or(Some(MOST)), ..rule }, watch)
}
