use super::{Domain, Map, MapError, MapOptions, SolverChoice};
use crate::constraint::Fixed;
use crate::energy::Standard;
use crate::map::periodic::{PeriodicMap, periodic};
use crate::solver::Observer;

impl MapOptions {
    /// Fails where something is asked for that periodic maps do not have.
    pub(super) fn check_periodic(&self) -> Result<(), MapError> {
        let expression = self.expression();
        if expression.as_standard() != Some(Standard::Conformal) {
            return Err(MapError::PeriodicEnergy { energy: expression.to_string() });
        }
        if self.holds_more() {
            return Err(MapError::PeriodicPins);
        }
        if self.solver != SolverChoice::Auto {
            return Err(MapError::PeriodicSolver { name: self.solver.name().to_owned() });
        }
        if self.cut || !self.remove_faces.is_empty() {
            return Err(MapError::PeriodicOpening);
        }
        Ok(())
    }

    /// The periodic map of a closed domain of genus 1.
    ///
    /// # Errors
    /// Another genus; integral weights that are undefined; a factorisation that breaks down.
    pub(super) fn periodic(&self, domain: &Domain, watch: &mut dyn Observer) -> Result<(Map, PeriodicMap), MapError> {
        let torus = periodic(&domain.disc, &domain.graph, self.weight, watch)?;
        let map = Map {
            residual: Some(torus.residual),
            ..Map::solved(torus.backend, torus.z.clone(), Fixed::default(), Some(torus.h))
        };
        Ok((map, torus))
    }
}
