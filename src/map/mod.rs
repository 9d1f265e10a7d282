//! One surface to one map: the pipeline from a disc to its image in the plane.

mod bijective;
mod boundary_energy;
mod convex_start;
mod domain;
mod error;
mod flattener;
mod gauge;
mod kept_factor;
mod lengths;
mod mapped;
mod method;
mod normalisation;
mod options;
pub mod periodic;
mod pipeline;
mod provenance;
mod result;
mod setup;
mod solve;
mod texture;
mod torus;

pub use domain::Domain;
pub use error::{Clash, MapError};
pub use flattener::Flattener;
pub use lengths::{LengthsError, LengthsRecord, Prescribed};
pub use mapped::Mapped;
pub use options::{
    Boundary, BoundaryName, FlatOptions, Hold, Interior, MapOptions, OptionsError, Outline, Own, Pin, PinnedPoints,
    RhoSource, SolverChoice, Start, Valid, ValidName,
};
pub use periodic::Tiling;
pub use pipeline::{map, map_input, map_surface};
pub use provenance::{Provenance, Replaced, Replacement, Setback};
pub use result::{Ending, Exactly, Map};
pub use texture::TextureCoordinates;
