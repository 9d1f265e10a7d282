//! `riemap list`: everything that has a name.

use std::io::Write;

use anyhow::Result;
use clap::Args;
use serde_json::{Map, Value};

use crate::app::bench::{CASES, CONTESTANTS};
use crate::constraint::Shape;
use crate::energy::{ENERGIES, EnergyKind};
use crate::quad_graph::dual::DUAL_POINTS;
use crate::solver::convex::EDGE_WEIGHTS;
use crate::solver::{LINEAR_SOLVERS, MINIMISERS, boundary};
use crate::surface::generate::SURFACES;
use crate::surface::normals::NORMAL_ESTIMATORS;

#[derive(Args)]
pub struct Arguments {
    /// Print one JSON object with a member per section, from names to descriptions
    #[arg(long)]
    json: bool,
}

/// A title and the rows below it.
struct Section {
    title: &'static str,
    how: &'static str,
    rows: Vec<(String, String)>,
}

pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<()> {
    if arguments.json {
        let table = |rows: Vec<(String, String)>| rows.into_iter().map(|(name, about)| (name, about.into())).collect();
        let all: Map<String, Value> =
            sections().into_iter().map(|s| (s.title.to_owned(), Value::Object(table(s.rows)))).collect();
        serde_json::to_writer_pretty(&mut *out, &all)?;
        writeln!(out)?;
        return Ok(());
    }
    for Section { title, how, rows } in sections() {
        writeln!(out, "{title} {how}")?;
        for (name, about) in rows {
            writeln!(out, "  {name:<20} {about}")?;
        }
        writeln!(out)?;
    }
    Ok(())
}

/// Returns all sections.
fn sections() -> Vec<Section> {
    vec![
        section(
            "surfaces",
            "meshes .obj .off .ply .stl, volumes .vol .longvol .pgm3d .npy .raw, or generated:",
            SURFACES.iter().map(|s| (format!("{}?{}", s.name, s.synopsis()), s.about.to_owned())),
        ),
        section(
            "normal estimators",
            "(--normals NAME?parameter=value; of digital surfaces and quad meshes)",
            NORMAL_ESTIMATORS.iter().map(|n| {
                let parameters: Vec<&str> = n.parameters().iter().map(|p| p.name).collect();
                let parameters =
                    if parameters.is_empty() { String::new() } else { format!(" ({})", parameters.join(", ")) };
                (n.name().to_owned(), format!("{}{parameters}", n.about()))
            }),
        ),
        section(
            "energies",
            "(--energy \"H + 0.5 L\"; --weight integral|unit)",
            ENERGIES.iter().map(|e| (e.name().to_owned(), e.about().to_owned())),
        ),
        section(
            "constraints",
            "(--boundary circle|free|fixed|periodic; fixed: --shape, --positions FILE, --hold whole|primal; --pin V=X,Y; --fix K)",
            Shape::ALL.iter().map(|(name, about, _)| (name.to_string(), about.to_string())),
        ),
        section(
            "dual points of triangle meshes",
            "(--dual)",
            DUAL_POINTS.iter().map(|d| (d.name().to_owned(), d.description().to_owned())),
        ),
        section(
            "weights of convex combination maps",
            "(--boundary fixed --weights NAME)",
            EDGE_WEIGHTS.iter().map(|w| (w.name.to_owned(), w.about.to_owned())),
        ),
        section(
            "direct solvers",
            "(--solver; auto takes the fastest that is exact)",
            LINEAR_SOLVERS.iter().map(|b| (b.name().to_owned(), b.description().to_owned())),
        ),
        section(
            "iterative solvers",
            "(--solver; auto takes reduced where it suits, else the next)",
            std::iter::once((boundary::NAME.to_owned(), boundary::DESCRIPTION.to_owned()))
                .chain(MINIMISERS.iter().map(|m| (m.name().to_owned(), m.description().to_owned()))),
        ),
        section(
            "cases of bench",
            "(riemap bench CASE…)",
            CASES.iter().map(|c| (c.name.to_owned(), c.about.to_owned())),
        ),
        section(
            "contestants of bench",
            "(peers where they are installed)",
            CONTESTANTS.iter().map(|c| (c.name.to_owned(), format!("{} map: {}", c.kind.name(), c.about))),
        ),
    ]
}

fn section(title: &'static str, how: &'static str, rows: impl IntoIterator<Item = (String, String)>) -> Section {
    Section { title, how, rows: rows.into_iter().collect() }
}
