use std::io::Write;
use std::path::Path;

use flate2::Compression;
use flate2::write::ZlibEncoder;

use crate::io::{WriteError, atomically};
use crate::surface::digital::Solid;

/// Writes DGtal's `.vol`, version 3 (compressed): 1 for voxels of the solid, 0 for the others of
/// its box.
///
/// The centre is written so that reading gives the same origin. The format allows only integers, so
/// other origins are rounded.
///
/// # Errors
/// [`WriteError::Io`]; nothing is written then.
pub fn write_vol(path: &Path, solid: &Solid) -> Result<(), WriteError> {
    let [width, height, depth] = solid.size();
    atomically(path, |out| {
        for (k, axis) in ["X", "Y", "Z"].into_iter().enumerate() {
            let half = (solid.size()[k] as i64 - 1) / 2;
            writeln!(out, "Center-{axis}: {}", solid.origin()[k].round() as i64 + half)?;
        }
        writeln!(out, "X: {width}\nY: {height}\nZ: {depth}\nVoxel-Size: 1\nAlpha-Color: 0")?;
        writeln!(out, "Voxel-Endian: 0\nInt-Endian: 0123\nVersion: 3\n.")?;
        let mut encoder = ZlibEncoder::new(out, Compression::default());
        let mut line = vec![0; width];
        for k in 0..depth {
            for j in 0..height {
                let row = solid.row(j, k);
                for (i, value) in line.iter_mut().enumerate() {
                    *value = (row[i / 64] >> (i % 64) & 1) as u8;
                }
                encoder.write_all(&line)?;
            }
        }
        encoder.finish().map(drop)
    })
}
