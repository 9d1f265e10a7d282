//! The files that `riemap map` writes.

use std::io::Write;
use std::path::Path;

use anyhow::{Result, bail};

use crate::app::experiment::{Checkerboard, checkerboard, flat_map, stage_model};
use crate::app::measure::stopwatch::Traced;
use crate::figure::Format;
use crate::input::Input;
use crate::io::{Staged, can_be_written, is_glb, stage, stage_mesh, writable, write_matrix_market};
use crate::map::{Domain, Map, Mapped, TextureCoordinates};
use crate::problem::linear::system;
use crate::report::Report;
use crate::solver::Iteration;
use crate::surface::oriented_mesh::OrientedMesh;

use super::arguments::Arguments;
use super::validity::{faults, of_written};
use super::written::WrittenReport;

/// Draws the pictures that were asked for, and returns each with its file.
pub(super) fn draw<'a>(
    arguments: &'a Arguments,
    input: &Input,
    mapped: &Mapped,
    record: &Report,
) -> Result<Vec<(&'a Path, Vec<u8>)>> {
    let name = Path::new(&record.input.path).file_name().map(|name| name.to_string_lossy());
    let title = format!("{}: {} faces", name.unwrap_or_default(), record.input.faces);
    let mut pictures = Vec::new();
    if let Some(path) = arguments.picture.as_deref() {
        pictures.push((path, flat_map(mapped, None, &title, Format::from_path(path)?)?));
    }
    if let Some(path) = arguments.texture.as_deref() {
        pictures.push((path, checkerboard(input, mapped, Checkerboard::default(), &title)?));
    }
    Ok(pictures)
}

/// Refuses outputs that cannot be written, and two outputs with one name.
pub(super) fn refuse_outputs(arguments: &Arguments) -> Result<()> {
    if let Some(path) = &arguments.output {
        writable(path)?;
    }
    if let Some(path) = &arguments.picture {
        Format::from_path(path)?;
    }
    if let Some(path) = &arguments.texture
        && !matches!(Format::from_path(path), Ok(Format::Png))
    {
        bail!("{}: a shaded surface can only be written as .png", path.display());
    }
    let outputs: Vec<&Path> = arguments.outputs().collect();
    for (k, &path) in outputs.iter().enumerate() {
        can_be_written(path)?;
        if outputs[..k].contains(&path) {
            bail!("two outputs have the same name, {}: each needs its own", path.display());
        }
    }
    Ok(())
}

/// Writes all outputs, or none of them.
pub(super) fn write_all(
    arguments: &Arguments,
    input: &Input,
    mapped: &Mapped,
    report: &WrittenReport,
    pictures: &[(&Path, Vec<u8>)],
    trace: &[Traced],
) -> Result<()> {
    let Mapped { domain: Domain { disc, graph, .. }, map, .. } = mapped;
    let mut staged: Vec<Staged> = Vec::new();
    if let Some(path) = arguments.output.as_ref().filter(|path| is_glb(path)) {
        staged.push(stage_model(path, input, mapped, Checkerboard::default())?);
    } else if let Some(path) = &arguments.output {
        let texture = mapped.texture_coordinates(&input.surface, arguments.tiling);
        warn_of_written(path, input, mapped, &texture);
        staged.push(stage_mesh(path, &input.surface, input.vertex_text.as_ref(), Some(texture.uv()))?);
    }
    if let Some(path) = &arguments.system {
        let comments = system_comments(&input.source, disc, map);
        staged.push(stage(path, |out| write_matrix_market(out, &system(graph), &comments))?);
    }
    if let Some(path) = &arguments.report {
        let json = serde_json::to_string_pretty(report)?;
        staged.push(stage(path, |out| writeln!(out, "{json}"))?);
    }
    for (path, bytes) in pictures {
        staged.push(stage(path, |out| out.write_all(bytes))?);
    }
    if let Some(path) = &arguments.trace {
        staged.push(stage(path, |out| write_trace(out, trace))?);
    }
    for file in staged {
        file.publish()?;
    }
    Ok(())
}

/// Warns if a periodic map is injective and its texture coordinates as written are not. Those of
/// other maps are the doubles of the map itself.
fn warn_of_written(path: &Path, input: &Input, mapped: &Mapped, texture: &TextureCoordinates) {
    if mapped.torus.is_none() || !mapped.validity.is_one_to_one() {
        return;
    }
    let written = of_written(&mapped.domain.disc, &input.surface, &texture.of_corners(&input.surface));
    for fault in faults(&written, &mapped.distortion) {
        eprintln!("riemap: warning: as written to {}: {fault}", path.display());
    }
}

/// Describes the rows and columns of the system, and the constraints that make its solution unique.
fn system_comments(source: &str, disc: &OrientedMesh, map: &Map) -> Vec<String> {
    let mut comments = vec![
        format!("system (2) of {source}: z3 - z1 - i rho (z2 - z0) = 0, one row per quad, one column per vertex"),
        format!(
            "columns 1 to {} are the vertices of the mesh that faces use, the others dual vertices",
            disc.positions.len()
        ),
        "held vertices (column, Re z, Im z):".to_owned(),
    ];
    comments.extend(map.fixed.iter().map(|(v, z)| format!("held {} {:?} {:?}", v + 1, z.re, z.im)));
    comments
}

/// Writes one line per iteration. A map may have several stages, each of which begins with
/// iteration 0.
fn write_trace(out: &mut dyn Write, trace: &[Traced]) -> std::io::Result<()> {
    let mut names: Vec<&str> = Vec::new();
    for name in trace.iter().flat_map(|t| t.iteration.terms.iter().map(|(name, _)| *name)) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    writeln!(out, "iteration,total,{},gradient_norm,step,seconds", names.join(","))?;
    for Traced { iteration, seconds } in trace {
        let of = |name: &&str| iteration.terms.iter().find(|(n, _)| n == name).map_or(0.0, |(_, value)| *value);
        let terms: Vec<String> = names.iter().map(|name| format!("{:?}", of(name))).collect();
        let Iteration { number, total, gradient_norm, step, .. } = iteration;
        writeln!(out, "{number},{total:?},{},{gradient_norm:?},{step:?},{seconds:.6}", terms.join(","))?;
    }
    Ok(())
}
