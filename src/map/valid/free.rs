//! The valid map with a free boundary.

use num_complex::Complex64;

use super::Repair;
use crate::backend::{Observer, Status};
use crate::constraint::{Fixed, Freedoms};
use crate::energy::conformal::Weight;
use crate::energy::{Expression, Metric};
use crate::map::flip_free::{area_at_rest, hold_gauge, image_area};
use crate::map::{Map, MapError};

/// Coefficients of L', stage after stage: at first the boundary keeps its lengths, at last it may follow the shapes of the faces.
const LENGTHS: [f64; 2] = [1.0, 1e-2];

impl Repair<'_> {
    /// MIPS + γ'L' over the mesh's own boundary edges, from the map onto the disc scaled to about the surface's area. No face folds, and none
    /// lies on another around a vertex; far parts of the boundary may overlap.
    pub(super) fn free(&self, watch: &mut dyn Observer) -> Result<Map, MapError> {
        let graph = &self.domain.graph;
        let (mut stage, _) = self.least_shear(watch)?;
        // By a power of two: nothing is rounded.
        let scale = 2f64.powf((0.5 * (area_at_rest(self.metric) / image_area(graph, &stage.z)).log2()).round());
        stage.z.iter_mut().for_each(|z| *z *= scale);
        let mut fixed = Fixed::default();
        hold_gauge(&mut fixed, &Expression::of(&["MIPS", "Lb"]), graph, &stage.z);
        let mut held = fixed.clone();
        (graph.primal..graph.vertices).for_each(|v| held.hold(v as u32, Complex64::ZERO));
        for coefficient in LENGTHS {
            if stage.status == Status::Interrupted || self.left.is_some_and(|n| stage.iterations >= n) {
                break;
            }
            let mut terms = self.mips(1.0)?;
            terms.push((coefficient, Box::new(Metric::mesh_boundary_edges(self.rest(&[], Weight::Integral)))));
            let freedoms = Freedoms::new(graph.vertices, &held);
            stage = self.minimise(&self.objective(terms, freedoms), stage, watch)?;
        }
        stage.z.truncate(graph.primal);
        stage.z = self.domain.with_dual_vertices(std::mem::take(&mut stage.z), &Fixed::default());
        Ok(self.map(stage, fixed))
    }
}
