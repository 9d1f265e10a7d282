//! `riemap verify`: the cotan map beside libigl's harmonic map.

use std::io::Write;

use anyhow::{Context, Result, bail};
use clap::Args;
use serde_json::{Value, json};

use crate::app::compare::libigl::{Environment, Settings};
use crate::app::compare::verify::{Comparison, SURFACES, TOLERANCE, compare, cotan_map};
use crate::input::Input;

use super::plural;
use crate::app::measure::stopwatch::Stopwatch;

#[derive(Args)]
pub struct Arguments {
    /// Triangle meshes; without any, a built-in set of generated surfaces with many obtuse
    /// triangles
    #[arg(value_name = "MESH")]
    meshes: Vec<String>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<()> {
    let meshes: Vec<&str> = if arguments.meshes.is_empty() {
        SURFACES.to_vec()
    } else {
        arguments.meshes.iter().map(String::as_str).collect()
    };
    let settings = Settings::from_variables();
    if !Environment::is_ready(&settings) {
        eprintln!("riemap: creating a Python environment with libigl in {} (once)", settings.folder.display());
    }
    let libigl = Environment::with(&settings)?;
    if !arguments.json {
        write_heading(&libigl.versions.libigl, out)?;
    }
    let (mut failed, mut rows) = (Vec::new(), Vec::new());
    for mesh in meshes {
        let row = row(mesh, &libigl);
        if !matches!(&row, Ok((comparison, _)) if comparison.is_equal()) {
            failed.push(mesh);
        }
        match (arguments.json, row) {
            (true, row) => rows.push(as_json(mesh, &row)),
            (false, Ok((comparison, seconds))) => print(out, mesh, &comparison, seconds)?,
            (false, Err(error)) => eprintln!("riemap: error: {error:#}"),
        }
    }
    if arguments.json {
        let value = json!({ "libigl": libigl.versions.libigl, "tolerance": TOLERANCE, "meshes": rows });
        serde_json::to_writer_pretty(&mut *out, &value)?;
        writeln!(out)?;
    }
    match failed.len() {
        0 => Ok(()),
        n => bail!(
            "{} not equal to libigl's map to {TOLERANCE:e}: {}",
            plural(n, "mesh is", "meshes are"),
            failed.join(", ")
        ),
    }
}

/// Describes the comparison of one mesh for programs.
fn as_json(mesh: &str, row: &Result<(Comparison, f64)>) -> Value {
    match row {
        Ok((comparison, seconds)) => json!({
            "mesh": mesh,
            "equal": comparison.is_equal(),
            "vertices": comparison.vertices,
            "interior_edges": comparison.interior_edges,
            "negative_weights": comparison.negative_weights,
            "difference": comparison.difference,
            "backend": comparison.backend,
            "seconds": { "riemap": seconds, "libigl": comparison.libigl.seconds_wall },
        }),
        Err(error) => json!({ "mesh": mesh, "equal": false, "error": format!("{error:#}") }),
    }
}

fn write_heading(version: &str, out: &mut dyn Write) -> Result<()> {
    writeln!(out, "libigl {version} harmonic against system (2) with circumcentres; seconds of assembly and solution")?;
    writeln!(
        out,
        "{:>9}  {:>9}  {:>8}  {:>10}  {:>8}  {:>8}  mesh",
        "vertices", "negative", "share", "difference", "riemap", "libigl"
    )?;
    Ok(())
}

/// Compares the maps of one mesh, and measures the seconds that ours took.
fn row(mesh: &str, libigl: &Environment) -> Result<(Comparison, f64)> {
    let input = Input::open(mesh)?;
    let mut watch = Stopwatch::start();
    let ours = cotan_map(&input.surface, &mut watch).with_context(|| mesh.to_owned())?;
    let seconds = watch.seconds().total;
    Ok((compare(&ours, libigl).with_context(|| mesh.to_owned())?, seconds))
}

fn print(out: &mut dyn Write, mesh: &str, c: &Comparison, seconds: f64) -> Result<()> {
    writeln!(
        out,
        "{:>9}  {:>9}  {:>7.1}%  {:>10.1e}  {:>8.3}  {:>8.3}  {mesh}",
        c.vertices,
        c.negative_weights,
        100.0 * c.negative_weights as f64 / c.interior_edges.max(1) as f64,
        c.difference,
        seconds,
        c.libigl.seconds_wall
    )?;
    Ok(())
}
