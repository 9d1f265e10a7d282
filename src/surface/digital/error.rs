/// A digital surface cannot be made from a set of voxels.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DigitalError {
    /// No voxel is inside.
    #[error("none of the {} × {} × {} voxels is inside: there is no surface; check the threshold", size[0], size[1], size[2])]
    Empty {
        /// Number of voxels along each axis.
        size: [usize; 3],
    },
    /// The boundary has fewer components than the requested rank.
    #[error("there is no component {component}: the boundary has {}, counted from 0, of {} surfels", sizes.len(), first(.sizes))]
    NoSuchComponent {
        /// The requested rank.
        component: usize,
        /// Number of surfels of every component, largest first.
        sizes: Vec<usize>,
    },
    /// The boundary has more surfels than 32-bit indices can number.
    #[error(
        "the boundary has {surfels} surfels, more than the {} that can be numbered; take a part or a coarser volume",
        Self::MOST_SURFELS
    )]
    TooManySurfels {
        /// Number of surfels.
        surfels: u64,
    },
    /// The box has too many voxels.
    #[error("a box of {} × {} × {} voxels is too large (at most {} voxels, {} in a row); take a part or a coarser volume", size[0], size[1], size[2], Self::MOST_VOXELS, i32::MAX)]
    TooLarge {
        /// Number of voxels along each axis.
        size: [usize; 3],
    },
    /// Bounds are NaN, infinite, or in the wrong order.
    #[error("[{}, {}] is not an interval (coordinate {axis})", bounds[0], bounds[1])]
    Bounds {
        /// The axis: 0, 1 or 2.
        axis: usize,
        /// The bounds that were given.
        bounds: [f64; 2],
    },
}

impl DigitalError {
    /// Largest number of surfels. Their corners, four each, are numbered in 32 bits, and one number
    /// is reserved for "no corner".
    pub const MOST_SURFELS: u64 = (u32::MAX as u64 - 1) / 4;

    /// Largest number of voxels; they take 1 GiB at one bit each.
    pub const MOST_VOXELS: u64 = 1 << 33;
}

/// Formats the first few numbers.
fn first(sizes: &[usize]) -> String {
    const SHOWN: usize = 10;
    let shown: Vec<String> = sizes.iter().take(SHOWN).map(usize::to_string).collect();
    let rest = if sizes.len() > SHOWN { ", …" } else { "" };
    format!("{}{rest}", shown.join(", "))
}
