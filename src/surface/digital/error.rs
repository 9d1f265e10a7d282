/// Why a set of voxels has no such digital surface.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DigitalError {
    /// No voxel is inside.
    #[error("none of the {} × {} × {} voxels is inside: there is no surface; check the threshold", size[0], size[1], size[2])]
    Empty {
        /// The extent of the box.
        size: [usize; 3],
    },
    /// The boundary has fewer components.
    #[error("there is no component {component}: the boundary has {}, counted from 0, of {} surfels", sizes.len(), first(.sizes))]
    NoSuchComponent {
        /// What was asked for.
        component: usize,
        /// Number of surfels of every component, largest first.
        sizes: Vec<usize>,
    },
    /// More surfels than can be numbered.
    #[error(
        "the boundary has {surfels} surfels, more than the {} that can be numbered; take a part or a coarser volume",
        Self::MOST_SURFELS
    )]
    TooManySurfels {
        /// How many there are.
        surfels: u64,
    },
    /// A box of too many voxels.
    #[error("a box of {} × {} × {} voxels is too large (at most {} voxels, {} in a row); take a part or a coarser volume", size[0], size[1], size[2], Self::MOST_VOXELS, i32::MAX)]
    TooLarge {
        /// The extent of the box.
        size: [usize; 3],
    },
    /// Bounds that are NaN, infinite, or in the wrong order.
    #[error("[{}, {}] is no interval of coordinate {axis}", bounds[0], bounds[1])]
    Bounds {
        /// Coordinate 0, 1 or 2.
        axis: usize,
        /// What was given.
        bounds: [f64; 2],
    },
}

impl DigitalError {
    /// Corners are numbered in 32 bits, four to a surfel, and one number says that there is none.
    pub const MOST_SURFELS: u64 = (u32::MAX as u64 - 1) / 4;

    /// 1 GiB of bits.
    pub const MOST_VOXELS: u64 = 1 << 33;
}

/// The first few numbers.
fn first(sizes: &[usize]) -> String {
    const SHOWN: usize = 10;
    let shown: Vec<String> = sizes.iter().take(SHOWN).map(usize::to_string).collect();
    let rest = if sizes.len() > SHOWN { ", …" } else { "" };
    format!("{}{rest}", shown.join(", "))
}
