use std::io::Write;

use anyhow::Result;

use riemap::backend::{LINEAR_BACKENDS, MINIMISERS};
use riemap::constraint::Shape;
use riemap::energy::ENERGIES;
use riemap::quad_graph::dual::DUAL_POINTS;
use riemap::surface::generate::SURFACES;

pub fn run(out: &mut dyn Write) -> Result<()> {
    section(
        out,
        "surfaces",
        "files .obj .off .ply .stl, or generated:",
        SURFACES.iter().map(|s| (format!("{}?{}", s.name, s.synopsis()), s.about.to_owned())),
    )?;
    section(
        out,
        "energies",
        "(--energy \"H + 0.5 L\"; --weight integral|unit)",
        ENERGIES.iter().map(|e| (e.name.to_owned(), e.about.to_owned())),
    )?;
    section(
        out,
        "constraints",
        "(--boundary circle|free|fixed; fixed: --shape, --positions FILE, --hold whole|primal; --pin V=X,Y; --fix K)",
        Shape::ALL.iter().map(|(name, about, _)| (name.to_string(), about.to_string())),
    )?;
    section(
        out,
        "dual points of triangle meshes",
        "(--dual)",
        DUAL_POINTS.iter().map(|d| (d.name().to_owned(), d.description().to_owned())),
    )?;
    section(
        out,
        "direct backends",
        "(--solver; auto takes the fastest that is exact)",
        LINEAR_BACKENDS.iter().map(|b| (b.name().to_owned(), b.description().to_owned())),
    )?;
    section(
        out,
        "iterative backends",
        "(--solver; auto takes the first)",
        MINIMISERS.iter().map(|m| (m.name().to_owned(), m.description().to_owned())),
    )?;
    Ok(())
}

fn section(
    out: &mut dyn Write,
    title: &str,
    how: &str,
    rows: impl IntoIterator<Item = (String, String)>,
) -> Result<()> {
    writeln!(out, "{title} {how}")?;
    for (name, about) in rows {
        writeln!(out, "  {name:<20} {about}")?;
    }
    writeln!(out)?;
    Ok(())
}
