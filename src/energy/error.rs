use super::conformal::NonPositiveRho;

/// An energy is not defined on a surface.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EnergyError {
    /// Integral weights are undefined.
    #[error(transparent)]
    NonPositiveRho(#[from] NonPositiveRho),
    /// Some triangles have no area at rest.
    #[error(
        "{energy} is not defined at face {face}, which has no area at rest (quads: at one of its corners), nor at {} more: move or \
         remove a vertex",
        count - 1
    )]
    NoArea {
        /// Name of the energy.
        energy: &'static str,
        /// The first such face, as an index of the source.
        face: u32,
        /// Number of triangles without area, where corners of quads count individually.
        count: usize,
    },
}
