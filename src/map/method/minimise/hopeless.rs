//! When a minimisation is given up before it has converged.

use crate::map::{Domain, MapError};
use crate::problem::nonlinear::Objective;
use crate::solver::{Minimum, Observer, Status, StopRule};

/// Iterations after which one looks.
const LOOK: usize = 15;

/// The largest share of flipped faces by then that a minimisation was seen to unflip.
const HOPELESS: f64 = 0.02;

/// Iterations at most.
const MOST: usize = 150;

/// Where a minimisation ended, with the iterations of all its stages.
pub(super) enum Prospect {
    /// It came to its end.
    Ended(Minimum, usize),
    /// It was given up before.
    GivenUp(Minimum, usize),
}

/// The minimum that `run` finds under `rule`, from the beginning, if it has converged after [`LOOK`] iterations or flips few faces by then;
/// else the unconverged minimum at which it is given up.
///
/// # Errors
/// Those of `run`.
pub(super) fn unless_hopeless(
    domain: &Domain,
    objective: &Objective,
    rule: StopRule,
    watch: &mut dyn Observer,
    run: impl Fn(StopRule, &mut dyn Observer) -> Result<(Minimum, usize), MapError>,
) -> Result<Prospect, MapError> {
    if rule.max_iterations.is_some_and(|n| n <= LOOK) {
        return run(rule, watch).map(|(minimum, iterations)| Prospect::Ended(minimum, iterations));
    }
    let (first, iterations) = run(StopRule { max_iterations: Some(LOOK), ..rule }, watch)?;
    if first.status != Status::MaxIterations {
        return Ok(Prospect::Ended(first, iterations));
    }
    let z = objective.freedoms.expand(&first.y);
    let flipped = domain.validity(&z).folded.len();
    if flipped as f64 > HOPELESS * domain.disc.faces.len() as f64 {
        return Ok(Prospect::GivenUp(first, iterations));
    }
    let (minimum, iterations) = run(StopRule { max_iterations: rule.max_iterations.or(Some(MOST)), ..rule }, watch)?;
    Ok(Prospect::Ended(minimum, iterations))
}
