//! Speed of reading and writing meshes.

use std::fs;
use std::io::Write;
use std::path::Path;

use super::BenchError;
use super::record::Exchange;
use crate::app::measure::median::median;
use crate::app::measure::stopwatch::cpu_seconds;
use crate::input::Input;
use crate::io::{self, Uv};
use crate::surface::Surface;

/// Measures the processor seconds of reading OBJ, OFF and PLY and of writing OBJ and PLY with
/// texture coordinates, for the mesh `source`, as medians of `repeats`. Files stay in the cache of
/// the system, so that only our part of the work counts. The result is empty if the system does not
/// report processor time.
///
/// # Errors
/// A mesh that cannot be made; files that cannot be written or read.
pub(super) fn exchange(source: &str, folder: &Path, repeats: usize) -> Result<Vec<Exchange>, BenchError> {
    let surface = Input::open(source)?.surface;
    // Coordinates with all their digits, as a map has them.
    let uv: Vec<[f64; 2]> = surface.positions.iter().map(|p| [p[0] / 3.0, p[2] / 7.0]).collect();
    let uv = Some(Uv::PerVertex(&uv));
    let file = |name: &str| folder.join(name);
    let mut rows = Vec::new();
    for format in ["obj", "ply"] {
        let path = file(&format!("written.{format}"));
        rows.extend(row(format!("write {format}"), &path, repeats, &mut || Ok(io::write(&path, &surface, None, uv)?))?);
    }
    io::atomically(&file("plain.off"), |out| off(out, &surface))?;
    fs::rename(file("written.obj"), file("plain.obj")).map_err(BenchError::io("a temporary file cannot be renamed"))?;
    fs::rename(file("written.ply"), file("plain.ply")).map_err(BenchError::io("a temporary file cannot be renamed"))?;
    for format in ["obj", "off", "ply"] {
        let path = file(&format!("plain.{format}"));
        let read = || io::read(&path).map(drop).map_err(|error| BenchError::Input(error.into()));
        rows.extend(row(format!("read {format}"), &path, repeats, &mut { read })?);
    }
    Ok(rows)
}

fn row(
    what: String,
    path: &Path,
    repeats: usize,
    work: &mut dyn FnMut() -> Result<(), BenchError>,
) -> Result<Option<Exchange>, BenchError> {
    let mut taken = Vec::new();
    for _ in 0..repeats {
        let before = cpu_seconds();
        work()?;
        taken.extend(before.zip(cpu_seconds()).map(|(before, after)| after - before));
    }
    let bytes = fs::metadata(path).map_err(BenchError::io("a temporary file cannot be read"))?.len() as usize;
    Ok(median(taken).map(|cpu| Exchange { what, bytes, cpu }))
}

/// Writes text OFF, which the program reads but does not write otherwise.
fn off(out: &mut dyn Write, surface: &Surface) -> std::io::Result<()> {
    writeln!(out, "OFF\n{} {} 0", surface.positions.len(), surface.faces.len())?;
    for [x, y, z] in &surface.positions {
        writeln!(out, "{x:?} {y:?} {z:?}")?;
    }
    for polygon in surface.faces.iter() {
        let corners: Vec<String> = polygon.iter().map(u32::to_string).collect();
        writeln!(out, "{} {}", corners.len(), corners.join(" "))?;
    }
    Ok(())
}
