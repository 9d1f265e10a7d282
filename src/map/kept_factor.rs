use std::sync::{Arc, OnceLock};

use crate::laplacian::{Colouring, ConformalLaplacian, DENSE, LaplacianError, Ordered};
use crate::quad_graph::QuadGraph;
use crate::solver::{Observer, Phase};

/// The conformal Laplacian of a quad graph and its factor, made when first needed and kept.
#[derive(Debug, Default)]
pub(super) struct KeptFactor(OnceLock<Arc<ConformalLaplacian>>);

impl KeptFactor {
    /// The Laplacian of `graph`, which is the same in every call.
    pub fn get(&self, graph: &QuadGraph, watch: &mut dyn Observer) -> Result<Arc<ConformalLaplacian>, LaplacianError> {
        if let Some(laplacian) = self.0.get() {
            return Ok(Arc::clone(laplacian));
        }
        watch.phase(Phase::Assemble);
        let colouring = Colouring::new(graph)?;
        watch.phase(Phase::Order);
        let ordered = Ordered::new(graph, colouring)?;
        watch.phase(Phase::Assemble);
        let made = Arc::new(ordered.factorise(graph, DENSE, || watch.phase(Phase::Factor))?);
        Ok(Arc::clone(self.0.get_or_init(|| made)))
    }
}
