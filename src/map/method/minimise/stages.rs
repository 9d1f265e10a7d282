//! The objective of a minimisation, and minimisations in stages.

use crate::constraint::{Fixed, Freedoms};
use crate::energy::conformal::{Dirichlet, Weight};
use crate::energy::{Order, Rest};
use crate::map::MapError;
use crate::map::setup::Setup;
use crate::problem::nonlinear::{Objective, Terms};
use crate::quad_graph::metric::RestMetric;
use crate::solver::{Minimiser, Minimum, Observer, Phase, Status, StopRule};

/// The factor by which L' is weakened in the first stage.
///
/// # Rationale
/// With integral weights L' is stiff, and far from a solution the energy has long narrow valleys. A solution with
/// H = L' = 0 is one for every coefficient.
const SOFTENED: f64 = 0.01;

/// The coefficients of the barrier that keeps the boundary in order, one for each stage.
const BARRIER: [f64; 4] = [1e-2, 1e-4, 1e-6, 1e-8];

/// The data from which objectives are made.
pub(super) struct Stages<'a> {
    pub setup: &'a Setup<'a>,
    pub metric: &'a RestMetric,
    /// The pinned vertices.
    pub fixed: Fixed,
    /// The factor on energies that do not depend on scale.
    pub unit: f64,
}

impl Stages<'_> {
    /// The energies with their coefficients.
    pub fn terms(&self) -> Result<Terms, MapError> {
        let Setup { options, domain, expression, .. } = self.setup;
        let graph = &domain.graph;
        let held: Vec<bool> = (0..graph.vertices as u32).map(|v| self.fixed.holds(v)).collect();
        let rest = Rest { graph, metric: self.metric, weight: options.weight, held: &held };
        let mut terms = Terms::new();
        for term in expression.terms().iter().filter(|term| term.coefficient > 0.0) {
            let is = term.energy.properties();
            let unit = if is.flip_free && !is.fixes_scale { self.unit } else { 1.0 };
            terms.push((unit * term.coefficient, term.energy.make(rest)?));
        }
        Ok(terms)
    }

    pub fn objective(&self, watch: &mut dyn Observer) -> Result<Objective, MapError> {
        let Setup { options, domain, .. } = self.setup;
        let graph = &domain.graph;
        watch.phase(Phase::Order);
        let freedoms = Freedoms::for_factor(graph, &self.fixed);
        watch.phase(Phase::Assemble);
        Ok(Objective { terms: self.terms()?, freedoms, norm: Dirichlet::new(graph, options.weight) })
    }

    /// Whether L' is stiff beside H.
    pub fn is_stiff(&self) -> bool {
        let Setup { options, expression, .. } = self.setup;
        options.weight == Weight::Integral && expression.is_stiff()
    }

    /// Minimises with a weakened L' first.
    pub fn softened_first(
        &self,
        backend: &dyn Minimiser,
        objective: &Objective,
        start: Vec<f64>,
        rule: StopRule,
        watch: &mut dyn Observer,
    ) -> Result<(Minimum, usize), MapError> {
        let mut soft = self.objective(watch)?;
        for ((coefficient, _), kind) in soft.terms.iter_mut().zip(self.setup.expression.energies()) {
            let is = kind.properties();
            if is.fixes_scale && is.boundary_only {
                *coefficient *= SOFTENED;
            }
        }
        let first = backend.minimise(&soft, start, rule, watch)?;
        if first.status == Status::Interrupted {
            let iterations = first.iterations;
            return Ok((first, iterations));
        }
        // The second start is next to the end: its own gradient would be no measure.
        let left = rule.max_iterations.map(|n| n.saturating_sub(first.iterations));
        let rule = StopRule { max_iterations: left, reference: Some(first.reference), ..rule };
        let minimum = backend.minimise(objective, first.y, rule, watch)?;
        let iterations = first.iterations + minimum.iterations;
        Ok((minimum, iterations))
    }

    /// Minimises with a barrier between neighbours on the boundary, weaker at each stage.
    pub fn in_order(
        &self,
        backend: &dyn Minimiser,
        start: Vec<f64>,
        rule: StopRule,
        watch: &mut dyn Observer,
    ) -> Result<(Minimum, usize), MapError> {
        let mut objective = self.objective(watch)?;
        objective.terms.push((BARRIER[0], Box::new(Order::new(&self.setup.domain.graph))));
        let barrier = objective.terms.len() - 1;
        let mut iterations = 0;
        let mut y = start;
        let mut rule = rule;
        let mut last = None;
        for coefficient in BARRIER {
            objective.terms[barrier].0 = coefficient;
            let minimum = backend.minimise(&objective, y, rule, watch)?;
            iterations += minimum.iterations;
            y = minimum.y.clone();
            rule.reference = Some(minimum.reference);
            let stop = minimum.status == Status::Interrupted;
            last = Some(minimum);
            if stop {
                break;
            }
        }
        last.map(|minimum| (minimum, iterations)).ok_or(MapError::FreeBoundary)
    }
}
