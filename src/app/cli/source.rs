//! The arguments that name a surface: a file or a generated surface, and how a volume becomes a
//! surface.

use anyhow::Result;
use clap::Args;

use crate::input::{Input, InputOptions};
use crate::io::Sample;
use crate::surface::digital::Adjacency;

use super::by_name;

#[derive(Args)]
pub struct Source {
    /// Mesh file (.obj .off .ply .stl), volume file (.vol .longvol .pgm3d .npy .raw), or generated
    /// surface
    ///
    /// A generated surface has a name such as `graph:cos+cos?n=33`; `riemap list` has all of them.
    #[arg(value_name = "MESH")]
    pub mesh: String,
    /// Threshold of a volume: voxels with larger values are inside [default: 0]
    #[arg(long, value_name = "T", allow_hyphen_values = true, help_heading = "Volumes")]
    threshold: Option<f64>,
    /// Extent of a raw volume, in voxels
    #[arg(long, value_name = "XxYxZ", value_parser = extent, help_heading = "Volumes")]
    size: Option<Extent>,
    /// Type of the voxels of a raw volume: u8, u16 (little-endian)
    #[arg(long = "type", value_name = "TYPE", value_parser = by_name::<Sample>, help_heading = "Volumes")]
    sample: Option<Sample>,
    /// Interior adjacency of voxels that share only an edge: 6 (separate), 18 (joined) [default: 6]
    #[arg(long, value_parser = by_name::<Adjacency>, help_heading = "Volumes")]
    adjacency: Option<Adjacency>,
    /// Component of the boundary of a volume, from 0, the largest [default: 0]
    #[arg(long, value_name = "K", help_heading = "Volumes")]
    component: Option<usize>,
}

#[derive(Clone, Copy)]
struct Extent([usize; 3]);

impl Source {
    /// Reads or generates the surface.
    pub fn open(&self) -> Result<Input> {
        let options = InputOptions {
            threshold: self.threshold,
            size: self.size.map(|Extent(size)| size),
            sample: self.sample,
            adjacency: self.adjacency,
            component: self.component,
        };
        Ok(Input::open_with(&self.mesh, &options)?)
    }
}

/// Parses `XxYxZ`.
fn extent(text: &str) -> Result<Extent, String> {
    let sides: Option<Vec<usize>> = text.split('x').map(|side| side.parse().ok().filter(|&n| n > 0)).collect();
    let sides = sides.and_then(|sides| <[usize; 3]>::try_from(sides).ok());
    sides.map(Extent).ok_or_else(|| "expected three whole numbers, as in 64x64x48".to_owned())
}
