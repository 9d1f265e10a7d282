//! Digital surfaces: the boundaries of sets of voxels.

mod direction;
mod error;
mod implicit;
mod linked;
mod scan;
mod solid;
mod surfels;

pub use error::DigitalError;
pub use implicit::{Implicit, digitise, exact_normals};
pub use solid::Solid;
pub(crate) use solid::words_per_row;
pub use surfels::boundary;
pub(crate) use surfels::part;

/// The adjacency of voxels that share only an edge; it resolves edges at which four surfels meet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Adjacency {
    /// Interior 6, exterior 18: two inner voxels that share only an edge are separate.
    #[default]
    #[serde(rename = "6")]
    Six,
    /// Interior 18, exterior 6: two inner voxels that share only an edge are connected.
    #[serde(rename = "18")]
    Eighteen,
}

impl std::fmt::Display for Adjacency {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.write_str(match self {
            Adjacency::Six => "6",
            Adjacency::Eighteen => "18",
        })
    }
}

/// A unit square between an inner and an outer voxel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Surfel {
    /// The inner voxel.
    pub voxel: [i32; 3],
    /// The axis of its outward normal: 0, 1, 2.
    pub axis: u8,
    /// Whether the outward normal points along the axis (rather than against it).
    pub positive: bool,
}

impl Surfel {
    fn new(voxel: [i32; 3], direction: u8) -> Self {
        Surfel { voxel, axis: direction / 2, positive: direction % 2 == 1 }
    }

    /// The direction of the outward normal: 2 axis, plus 1 if it points along the axis.
    fn direction(self) -> u8 {
        2 * self.axis + u8::from(self.positive)
    }

    /// Returns the outward unit normal.
    pub fn normal(self) -> [f64; 3] {
        let mut normal = [0.0; 3];
        normal[usize::from(self.axis)] = if self.positive { 1.0 } else { -1.0 };
        normal
    }

    /// Returns the centre of the square, in the coordinates of `solid`.
    pub fn centre(self, solid: &Solid) -> [f64; 3] {
        let (centre, normal) = (solid.centre(self.voxel), self.normal());
        [0, 1, 2].map(|k| centre[k] + 0.5 * normal[k])
    }
}

/// A digital surface: the voxels and surfels from which its quads were made.
#[derive(Clone, Debug, PartialEq)]
pub struct Digital {
    /// The voxels.
    pub solid: Solid,
    /// The surfel of each face (`nf`).
    pub surfels: Vec<Surfel>,
    /// The adjacency that resolved edges of four surfels.
    pub adjacency: Adjacency,
    /// Numbers of surfels of all components of the boundary of `solid`, largest first.
    pub components: Vec<usize>,
    /// The rank of this component among `components`.
    pub component: usize,
    /// Exact outward unit normals of the shape that was digitised (`nf × 3`), if it is known.
    pub exact_normals: Option<Vec<[f64; 3]>>,
}
