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

/// Which of the voxels that share an edge alone belong together: what becomes of an edge where four surfels meet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Adjacency {
    /// Interior 6, exterior 18: two inner voxels that share an edge alone are apart.
    #[default]
    #[serde(rename = "6")]
    Six,
    /// Interior 18, exterior 6: they are joined.
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

/// A face between an inner and an outer voxel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Surfel {
    /// The inner voxel.
    pub voxel: [i32; 3],
    /// The axis of its outward normal: 0, 1, 2.
    pub axis: u8,
    /// Whether the normal points along the axis, or against it.
    pub positive: bool,
}

impl Surfel {
    fn new(voxel: [i32; 3], direction: u8) -> Self {
        Surfel { voxel, axis: direction / 2, positive: direction % 2 == 1 }
    }

    /// 2 axis, and 1 more along the axis.
    fn direction(self) -> u8 {
        2 * self.axis + u8::from(self.positive)
    }

    /// The outward unit normal.
    pub fn normal(self) -> [f64; 3] {
        let mut normal = [0.0; 3];
        normal[usize::from(self.axis)] = if self.positive { 1.0 } else { -1.0 };
        normal
    }

    /// The centre of the square, in the coordinates of `solid`.
    pub fn centre(self, solid: &Solid) -> [f64; 3] {
        let (centre, normal) = (solid.centre(self.voxel), self.normal());
        [0, 1, 2].map(|k| centre[k] + 0.5 * normal[k])
    }
}

/// What is known of a digital surface beside its quads.
#[derive(Clone, Debug, PartialEq)]
pub struct Digital {
    /// The voxels.
    pub solid: Solid,
    /// The surfel of each face (`nf`).
    pub surfels: Vec<Surfel>,
    /// How edges of four surfels were resolved.
    pub adjacency: Adjacency,
    /// Numbers of surfels of all components of the boundary of `solid`, largest first.
    pub components: Vec<usize>,
    /// Which of them this is.
    pub component: usize,
    /// Exact outward unit normals of the shape that was digitised (`nf × 3`), where it is known.
    pub exact_normals: Option<Vec<[f64; 3]>>,
}
