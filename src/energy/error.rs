use super::conformal::NonPositiveRho;

/// An energy is not defined on a surface.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EnergyError {
    /// Integral weights that are undefined.
    #[error(transparent)]
    NonPositiveRho(#[from] NonPositiveRho),
    /// A triangle without shape.
    #[error(
        "{energy} is not defined at face {face}, which has no area at rest (quads: at one of its corners), nor at {} more: move or \
         remove a vertex",
        count - 1
    )]
    NoArea {
        /// The energy.
        energy: &'static str,
        /// The first such face, as the source numbers them.
        face: u32,
        /// Triangles without area, corners of quads one by one.
        count: usize,
    },
}
