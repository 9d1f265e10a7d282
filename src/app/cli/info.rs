//! `riemap info`: the kind, topology and defects of a surface.

use std::io::Write;

use anyhow::{Result, bail};
use clap::Args;
use serde_json::{Value, json};

use crate::app::cli::advice::of_finding;
use crate::input::Input;
use crate::surface::digital::Digital;
use crate::surface::oriented_mesh::OrientedMesh;
use crate::surface::topology::Component;
use crate::surface::topology::diagnosis::{Diagnosis, Finding, Severity};

use super::plural;
use super::source::Source;

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    source: Source,
    /// List the boundary vertices in order, with the surface on the left, counted from 0
    #[arg(long)]
    boundary: bool,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<()> {
    let input = arguments.source.open()?;
    let diagnosis = input.diagnosis();
    let problems = diagnosis.fatal().count();
    if arguments.json {
        serde_json::to_writer_pretty(&mut *out, &as_json(&input, &diagnosis, arguments.boundary))?;
        writeln!(out)?;
        return verdict(&input.source, problems);
    }
    let topology = &diagnosis.topology;
    let faces = &input.surface.faces;
    let kind = match faces.arity() {
        _ if input.digital.is_some() => "digital surface",
        Some(3) => "triangle mesh",
        Some(4) => "quad mesh",
        Some(_) => "polygon mesh",
        None => "mixed polygon mesh",
    };
    writeln!(out, "{}: {kind}", input.source)?;
    writeln!(
        out,
        "{}, {}, {}",
        plural(input.surface.positions.len(), "vertex", "vertices"),
        plural(topology.edges.len(), "edge", "edges"),
        plural(faces.len(), "face", "faces")
    )?;
    if let Some(digital) = &input.digital {
        describe_digital(digital, out)?;
    }
    if input.surface.face_normals.is_some() && faces.arity() == Some(4) {
        writeln!(out, "normals are given for all faces (--normals file)")?;
    } else if let Some(face) = input.face_without_normal {
        writeln!(out, "normals are given, but not for all faces: face {face} has none")?;
    }
    const SHOWN: usize = 20;
    writeln!(out, "{}", plural(topology.components.len(), "component", "components"))?;
    for (k, component) in topology.components.iter().take(SHOWN).enumerate() {
        writeln!(out, "  component {k}, from face {}: {}", component.first_face, describe(component))?;
    }
    if topology.components.len() > SHOWN {
        writeln!(out, "  … and {} more", topology.components.len() - SHOWN)?;
    }
    for finding in &diagnosis.findings {
        writeln!(out, "{}: {finding}\n  → {}", label(finding), of_finding(finding))?;
    }
    if arguments.boundary
        && let Ok(disc) = OrientedMesh::new(&input.surface, &diagnosis)
    {
        let vertices = disc.boundary.iter().map(|&v| disc.source_vertex[v as usize].to_string());
        writeln!(out, "boundary: {}", vertices.collect::<Vec<_>>().join(" "))?;
    }
    match problems {
        0 => writeln!(out, "A disc: ready for `riemap map`.")?,
        n => writeln!(out, "Not ready for `riemap map`: {}.", plural(n, "problem", "problems"))?,
    }
    verdict(&input.source, problems)
}

/// Fails if the surface cannot be mapped as it is, so that the exit code is 1.
fn verdict(source: &str, problems: usize) -> Result<()> {
    if problems > 0 {
        bail!("{source} cannot be mapped as it is: {}", plural(problems, "problem", "problems"));
    }
    Ok(())
}

/// Describes the surface for programs.
fn as_json(input: &Input, diagnosis: &Diagnosis, boundary: bool) -> Value {
    let Diagnosis { topology, findings, .. } = diagnosis;
    let component = |component: &Component| {
        json!({
            "first_face": component.first_face, "vertices": component.vertices, "edges": component.edges,
            "faces": component.faces, "boundary_loops": component.boundary_loops, "euler": component.euler(),
            "genus": component.genus(), "orientable": component.orientable, "manifold": component.manifold,
        })
    };
    let finding = |finding: &Finding| {
        json!({
            "severity": label(finding), "text": finding.to_string(), "advice": of_finding(finding).to_string(),
        })
    };
    let mut value = json!({
        "path": input.source,
        "kind": match (&input.digital, input.surface.faces.arity()) {
            (Some(_), _) => "digital",
            (None, Some(3)) => "triangle",
            (None, Some(4)) => "quad",
            (None, _) => "polygon",
        },
        "vertices": input.surface.positions.len(),
        "edges": topology.edges.len(),
        "faces": input.surface.faces.len(),
        "components": topology.components.iter().map(component).collect::<Vec<_>>(),
        "findings": findings.iter().map(finding).collect::<Vec<_>>(),
        "ready": diagnosis.fatal().count() == 0,
    });
    if boundary && let Ok(mesh) = OrientedMesh::new(&input.surface, diagnosis) {
        let vertices: Vec<u32> = mesh.boundary.iter().map(|&v| mesh.source_vertex[v as usize]).collect();
        value["boundary"] = json!(vertices);
    }
    value
}

/// Returns the severity of a finding in one word.
fn label(finding: &Finding) -> &'static str {
    match finding.severity() {
        Severity::Fatal => "problem",
        Severity::Repaired => "repaired",
        Severity::Note => "note",
    }
}

/// Describes the voxels, and the component of their boundary.
fn describe_digital(digital: &Digital, out: &mut dyn Write) -> Result<()> {
    const SHOWN: usize = 8;
    let [x, y, z] = digital.solid.size();
    writeln!(
        out,
        "{} in a box of {x} × {y} × {z}; interior adjacency {}",
        plural(digital.solid.len(), "voxel", "voxels"),
        digital.adjacency
    )?;
    let sizes: Vec<String> = digital.components.iter().take(SHOWN).map(usize::to_string).collect();
    let more = if digital.components.len() > SHOWN { ", …" } else { "" };
    match digital.components.len() {
        1 => {}
        n => writeln!(
            out,
            "this is component {} of {n} of their boundary, which have {}{more} surfels (--component)",
            digital.component,
            sizes.join(", ")
        )?,
    }
    Ok(())
}

fn describe(component: &Component) -> String {
    let counts = format!(
        "{}, {}, {}",
        plural(component.vertices, "vertex", "vertices"),
        plural(component.edges, "edge", "edges"),
        plural(component.faces, "face", "faces")
    );
    let loops = match component.boundary_loops.as_slice() {
        [] => "closed".to_owned(),
        chains if !component.edge_manifold => plural(chains.iter().sum(), "boundary edge", "boundary edges"),
        loops => {
            let lengths: Vec<String> = loops.iter().take(12).map(usize::to_string).collect();
            let more = if loops.len() > 12 { ", …" } else { "" };
            format!("{} of {}{more} edges", plural(loops.len(), "boundary loop", "boundary loops"), lengths.join(", "))
        }
    };
    let orientation = if component.orientable { "" } else { ", not orientable" };
    let shape = match component.genus() {
        Some(genus) if component.manifold => format!("genus {genus}{orientation}"),
        Some(genus) => format!("genus {genus}{orientation} (pulled apart where it touches itself)"),
        None => format!("not a manifold{orientation}"),
    };
    format!("{counts}; {loops}; Euler number {}, {shape}", component.euler())
}
