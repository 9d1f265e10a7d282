use std::io::Write;

use anyhow::{Context, Result, bail};
use clap::Args;

use crate::app::compare::libigl::{Environment, Settings};
use crate::app::compare::verify::{Comparison, SURFACES, TOLERANCE, compare, cotan_map};
use crate::input::Input;

use super::plural;
use crate::app::measure::stopwatch::Stopwatch;

#[derive(Args)]
pub struct Arguments {
    /// Triangle meshes; without any, a built-in set of generated surfaces with many obtuse triangles
    #[arg(value_name = "MESH")]
    meshes: Vec<String>,
}

pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<()> {
    let meshes: Vec<&str> = if arguments.meshes.is_empty() {
        SURFACES.to_vec()
    } else {
        arguments.meshes.iter().map(String::as_str).collect()
    };
    let settings = Settings::from_variables();
    if !Environment::is_ready(&settings) {
        eprintln!("riemap: making a Python environment with libigl in {} (once)", settings.folder.display());
    }
    let libigl = Environment::with(&settings)?;
    writeln!(
        out,
        "libigl {} harmonic against system (2) with circumcentres; seconds of assembly and solution",
        libigl.versions.libigl
    )?;
    writeln!(
        out,
        "{:>9}  {:>9}  {:>8}  {:>10}  {:>8}  {:>8}  mesh",
        "vertices", "negative", "share", "difference", "riemap", "libigl"
    )?;
    let mut failed = Vec::new();
    for mesh in meshes {
        match row(mesh, &libigl) {
            Ok((comparison, seconds)) => {
                print(out, mesh, &comparison, seconds)?;
                if !comparison.is_equal() {
                    failed.push(mesh);
                }
            }
            Err(error) => {
                eprintln!("riemap: error: {error:#}");
                failed.push(mesh);
            }
        }
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
