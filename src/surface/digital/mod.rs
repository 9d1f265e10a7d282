//! Digital surfaces: the boundaries of sets of voxels.

mod solid;

pub use solid::Solid;

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
