use std::io::Write;

use anyhow::Result;
use clap::Args;

use riemap::input::Input;
use riemap::surface::diagnosis::{Diagnosis, Severity};
use riemap::surface::disc::Disc;
use riemap::surface::topology::Component;

use super::plural;

#[derive(Args)]
pub struct Arguments {
    /// A mesh file (.obj .off .ply .stl), or a generated surface such as `graph:cos+cos?n=33`
    #[arg(value_name = "MESH")]
    mesh: String,
    /// List the vertices of the boundary in order, surface on the left (from 0, as --pin and --positions count)
    #[arg(long)]
    boundary: bool,
}

pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<()> {
    let input = Input::open(&arguments.mesh)?;
    let diagnosis = Diagnosis::new(&input.surface);
    let topology = &diagnosis.topology;
    let faces = &input.surface.faces;
    let kind = match faces.arity() {
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
    if input.surface.face_normals.is_some() && faces.arity() == Some(4) {
        writeln!(out, "normals are given for all faces (--rho normals)")?;
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
        let label = match finding.severity() {
            Severity::Fatal => "problem",
            Severity::Repaired => "repaired",
            Severity::Note => "note",
        };
        writeln!(out, "{label}: {finding}\n  → {}", finding.advice())?;
    }
    if arguments.boundary
        && let Ok(disc) = Disc::new(&input.surface, &diagnosis)
    {
        let vertices = disc.boundary.iter().map(|&v| disc.source_vertex[v as usize].to_string());
        writeln!(out, "boundary: {}", vertices.collect::<Vec<_>>().join(" "))?;
    }
    match diagnosis.fatal().count() {
        0 => writeln!(out, "A disc: ready for `riemap map`.")?,
        n => writeln!(out, "Not ready for `riemap map`: {}.", plural(n, "problem", "problems"))?,
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
