//! Minimisation of any sum of energies: the initial map of §3.2 and §3.3 of the paper, the gauge, and the stages.

mod flip_free;
mod hopeless;
mod stages;

use std::f64::consts::TAU;

use num_complex::Complex64;

use super::Attempt;
use crate::constraint::{Fixed, float_white_back, hold_gauge, on_circle, turn_back};
use crate::energy::Expression;
use crate::map::gauge::held;
use crate::map::setup::Setup;
use crate::map::{Ending, Map, MapError, MapOptions, SolverChoice};
use crate::problem::linear::LinearProblem;
use crate::solver::minimise::Newton;
use crate::solver::minimise::smallest_singular_value;
use crate::solver::{MINIMISERS, Minimiser, Minimum, Observer, Silent, Status, StopRule, minimiser, solve_linear};
use flip_free::hold_unseen;
use hopeless::Prospect;
use stages::Stages;

/// A minimisation that ends at rounding counts as converged when it has brought the gradient down to this.
const ACCEPTED_REDUCTION: f64 = 1e-5;

/// How long a minimisation goes on.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(in crate::map) enum Effort {
    /// Until it has converged, or its iterations are used up.
    Full,
    /// Only as long as it may lead to an injective map; another map replaces it otherwise.
    WhileHopeful,
}

/// Minimises the energy from `start`, or from an initial map of its own.
///
/// # Errors
/// An unknown solver; constraints that do not suffice; energies that are undefined; no initial map without flipped faces, where the
/// energy needs one.
pub(in crate::map) fn solve(
    setup: &Setup,
    start: Option<Vec<Complex64>>,
    effort: Effort,
    watch: &mut dyn Observer,
) -> Result<Attempt, MapError> {
    let Setup { options, domain, expression, normalisation, .. } = setup;
    let graph = &domain.graph;
    let circle = setup.is_circle();
    let solver = choose(&options.solver, expression)?;
    let metric = domain.rest_metric(options)?;
    let flip_free = expression.is_flip_free();
    let first = match start {
        Some(z) if flip_free => flip_free::start_from(setup, &metric, z, watch)?,
        Some(z) => z,
        None if flip_free => flip_free::start(setup, &metric, watch)?,
        None => initial(setup)?,
    };
    let mut fixed = held(setup, &first)?;
    let unit = if flip_free { flip_free::unit_of_shapes(setup, &metric, &first) } else { 1.0 };
    let mut stages = Stages { setup, metric: &metric, fixed: fixed.clone(), unit };
    let mut unseen = Vec::new();
    if flip_free {
        let terms = stages.terms()?;
        unseen = hold_unseen(&mut stages.fixed, &terms, &first);
    }
    let objective = stages.objective(watch)?;
    let start = objective.freedoms.restrict(&first);
    let rule = StopRule { tolerance: options.tolerance, reference: None, max_iterations: options.max_iterations };
    let run = |rule: StopRule, watch: &mut dyn Observer| {
        let start = start.clone();
        if options.is_ordered() && circle {
            stages.in_order(solver, start, rule, watch)
        } else if stages.is_stiff() && solver.name() == MINIMISERS[0].name() {
            stages.softened_first(solver, &objective, start, rule, watch)
        } else {
            let minimum = solver.minimise(&objective, start, rule, watch)?;
            let iterations = minimum.iterations;
            Ok((minimum, iterations))
        }
    };
    let (minimum, iterations) = match effort {
        Effort::Full => run(rule, watch)?,
        Effort::WhileHopeful => match hopeless::unless_hopeless(domain, &objective, rule, watch, run)? {
            Prospect::Ended(minimum, iterations) => (minimum, iterations),
            Prospect::GivenUp(minimum, iterations) => return Ok(not_converged(solver, &minimum, iterations, options)),
        },
    };
    if !is_accepted(&minimum, options) {
        return Ok(not_converged(solver, &minimum, minimum.iterations, options));
    }

    let mut z = objective.freedoms.expand(&minimum.y);
    let has_gauge = expression.has_lengths_or_areas()
        && !options.boundary.is_fixed()
        && !options.holds_more()
        && !expression.is_on_circle();
    if has_gauge {
        turn_back(expression, graph, &first, &mut z);
    }
    if has_gauge && !expression.joins_diagonal_classes() {
        float_white_back(graph, &metric, &mut z);
    }
    if !unseen.is_empty() {
        let placed = domain.with_dual_vertices(z[..graph.primal].to_vec(), &fixed);
        unseen.iter().for_each(|&v| z[v as usize] = placed[v as usize]);
    }
    let energies = objective.values(&minimum.y);
    let total = objective.terms.iter().zip(&energies).map(|((t, _), (_, e))| t * e).sum();
    if has_gauge {
        fixed = Fixed::default();
        hold_gauge(&mut fixed, expression, graph, &z);
    }
    let smallest_singular_value = if circle { smallest_singular_value(&objective, &minimum.y) } else { None };
    Ok(Attempt::solved(Map {
        total: Some(total),
        energies,
        gradient_norm: Some(minimum.gradient_norm),
        ending: Ending::Minimised(minimum.status),
        iterations,
        smallest_singular_value,
        on_circle: circle || (options.is_fixed_on_circle()),
        anchored: normalisation.exact,
        ..Map::solved(solver.name(), z, fixed, None)
    }))
}

/// The minimiser that was chosen. `auto` is Newton's method for sums of energies over triangles, whose Hessians have their positive parts in
/// closed form, and Levenberg–Marquardt for sums of squares.
fn choose<'a>(solver: &'a SolverChoice, expression: &Expression) -> Result<&'a dyn Minimiser, MapError> {
    let name = match solver {
        SolverChoice::Auto if expression.is_of_triangles() => return Ok(&Newton::ROW),
        SolverChoice::Auto => return Ok(MINIMISERS[0]),
        SolverChoice::Minimiser(own) => return Ok(&**own),
        SolverChoice::Linear(own) => own.name(),
        SolverChoice::Named(name) => name,
    };
    minimiser(name).ok_or_else(|| MapError::NotAMinimiser {
        name: name.to_owned(),
        known: [crate::solver::boundary::NAME]
            .into_iter()
            .chain(MINIMISERS.iter().map(|m| m.name()))
            .collect::<Vec<_>>()
            .join(", "),
    })
}

/// Whether the minimisation converged, or reached the end that the user has set.
fn is_accepted(minimum: &Minimum, options: &MapOptions) -> bool {
    match minimum.status {
        Status::Converged | Status::Interrupted => true,
        Status::Precision => minimum.reduction() <= ACCEPTED_REDUCTION.max(options.tolerance),
        Status::MaxIterations => options.max_iterations.is_some(),
    }
}

fn not_converged(solver: &dyn Minimiser, minimum: &Minimum, iterations: usize, options: &MapOptions) -> Attempt {
    let reason = MapError::NotConverged {
        solver: solver.name(),
        status: minimum.status.name(),
        iterations,
        reduction: minimum.reduction(),
        tolerance: options.tolerance,
    };
    Attempt::Failed { reason, iterations, start: None }
}

/// The boundary on a circle by arc length, of the perimeter's radius where lengths count, the interior from H.
fn initial(setup: &Setup) -> Result<Vec<Complex64>, MapError> {
    let Setup { options, domain, expression, normalisation, .. } = setup;
    let graph = &domain.graph;
    let fixed = if options.boundary.is_fixed() {
        options.fixed(&domain.disc, graph)?
    } else {
        let lengths_count = expression.fixes_scale() && !expression.is_on_circle();
        let radius = if lengths_count { graph.perimeter() / TAU } else { 1.0 };
        on_circle(graph, radius, normalisation.or_first())?
    };
    let problem = LinearProblem::new(graph, options.weight, &fixed)?;
    Ok(solve_linear(&problem, "auto", &mut Silent)?.z)
}
