//! The summary of a map on the standard output, and warnings on the standard error stream.

use std::io::Write;

use anyhow::Result;

use crate::io::LengthUnit;
use crate::map::{Boundary, Ending, Exactly, MapOptions, Mapped, PinnedPoints, Replacement};
use crate::report::{EnergyRecord, Report};
use crate::solver::Status;

use super::validity::faults;
use crate::app::cli::plural;

/// Writes warnings and notes about the map to the standard error stream: non-convergence, replaced
/// maps, faults, and the options that may help.
pub(super) fn warn(options: &MapOptions, mapped: &Mapped) {
    let Mapped { map, distortion, validity, .. } = mapped;
    if options.pinned_points() == PinnedPoints::Two
        && options.pins.is_empty()
        && map.on_circle
        && map.smallest_singular_value.is_some()
    {
        eprintln!(
            "riemap: warning: two pinned points determine a circle map badly or not at all: the smallest singular value \
             is {:.1e}; --fix 3 makes it unique",
            map.smallest_singular_value.unwrap_or_default()
        );
    }
    match map.ending {
        Ending::Minimised(Status::MaxIterations) => {
            eprintln!(
                "riemap: warning: not converged after {} iterations; the map of lowest energy so far is taken{}",
                map.iterations,
                crowding(mapped).map(|why| format!(": {why}")).unwrap_or_default()
            );
        }
        Ending::Minimised(Status::Interrupted) => {
            eprintln!(
                "riemap: warning: interrupted after {} iterations; the map of lowest energy so far is taken",
                map.iterations
            );
        }
        Ending::Minimised(status) if map.provenance.is_repaired() => {
            let at_the_end = distortion.smallest_scale.is_some_and(|scale| scale < END_OF_DOUBLES);
            if let Some(why) = crowding(mapped).filter(|_| at_the_end || status == Status::Precision) {
                eprintln!("riemap: warning: rounding limits how conformal the map can become: {why}");
            }
        }
        _ => {}
    }
    if map.provenance.is_repaired() && options.weights().is_none() {
        let was = match map.provenance.flipped() {
            None => "did not converge".to_owned(),
            Some(0) => "had a boundary that crosses itself".to_owned(),
            Some(n) => format!("had {}", plural(n, "flipped face", "flipped faces")),
        };
        eprintln!(
            "riemap: note: the conformal map {was} and was replaced by one that passes the exact check; --valid off keeps it"
        );
    }
    if let Some(error) = distortion.length.and_then(|length| length.boundary_max)
        && map.exactly != Some(Exactly::Lengths)
        && error > LENGTHS_LOST
    {
        eprintln!(
            "riemap: note: the lengths of the boundary edges are not kept: the largest relative error is {error:.1e}"
        );
    }
    if let Some(Replacement::LessDistorted { mean }) = map.provenance.replaced.map(|replaced| replaced.by) {
        eprintln!(
            "riemap: note: the conformal map had a mean σ₁/σ₂ of {mean:.3} and was replaced by one of less distortion; --valid \
             off keeps it"
        );
    }
    if map.provenance.is_repaired()
        && map.on_circle
        && options.weights().is_none()
        && map.fixed.len() < options.pinned_points().count()
    {
        eprintln!(
            "riemap: note: one boundary point is pinned instead of {}: with all of them, parts of the map would be too small \
             for double precision",
            options.pinned_points().count()
        );
    }
    let mut help: Vec<&str> = Vec::new();
    help.extend(mapped.domain.is_of_triangles().then_some("another --dual"));
    help.extend(mapped.domain.planes.is_some().then_some("other --normals"));
    match map.ending {
        Ending::Solved if mapped.torus.is_some() => {}
        Ending::Solved => help.push("another --shape"),
        Ending::Minimised(_) if map.on_circle => {
            help.extend((!options.is_ordered()).then_some("--keep-order"));
            help.push("--boundary free");
        }
        Ending::Minimised(_) => {
            let may_overlap =
                matches!(options.boundary, Boundary::Free { overlap: true, .. }) && options.promises_valid();
            help.extend(may_overlap.then_some("--valid one-to-one"));
            help.push("--boundary circle");
        }
    }
    let help = match help.is_empty() {
        true => "a finer mesh may help".to_owned(),
        false => format!("{} may help", help.join(", or ")),
    };
    for fault in faults(validity, distortion) {
        eprintln!("riemap: warning: {fault}; {help}");
    }
    if let Some(count) = distortion.boundary_out_of_order.filter(|&count| count > 0) {
        let points = plural(count, "boundary point is", "boundary points are");
        eprintln!("riemap: warning: {points} out of order along the circle; {help}");
    }
}

/// Relative error of boundary lengths above which a note says that they are not kept.
const LENGTHS_LOST: f64 = 1e-6;

/// A minimisation converges slowly or not at all if the scales of its parts differ by more than
/// this.
const CROWDED: f64 = 1e-6;

/// Relative scale below which double precision no longer resolves the vertices of a part, except
/// near 0, so that a minimisation appears to have converged.
const END_OF_DOUBLES: f64 = 1e-13;

/// Explains that parts of a map are much smaller than others, and what helps; `None` if they are
/// not.
fn crowding(mapped: &Mapped) -> Option<String> {
    let smallest = mapped.distortion.smallest_scale.filter(|&scale| scale < CROWDED)?;
    let help = match mapped.map.on_circle {
        true => "--boundary free shrinks them less",
        false => "a longer boundary, from a cut through these parts, shrinks them less",
    };
    Some(format!(
        "its smallest parts are drawn at {smallest:.1e} of the scale of its largest, and double precision ends near \
         1e-16; {help}"
    ))
}

/// Prints the summary of a map.
pub(super) fn print(out: &mut dyn Write, record: &Report) -> Result<()> {
    let Report { input, quad_graph, solver, distortion, .. } = record;
    let (vertices, faces) = (plural(input.vertices, "vertex", "vertices"), plural(input.faces, "face", "faces"));
    let what = if input.kind == "digital" { "surface" } else { "mesh" };
    writeln!(out, "{}: {} {what}, {vertices}, {faces}", input.path, input.kind)?;
    let negative = match quad_graph.negative_rho {
        0 => String::new(),
        n => format!(", {n} not positive"),
    };
    if let Some(cut) = &record.cut {
        writeln!(out, "{cut}")?;
    }
    let tilted = match quad_graph.clamped {
        0 => String::new(),
        n => format!("; {} tilted for it", plural(n, "normal", "normals")),
    };
    writeln!(
        out,
        "quad graph: {} vertices, {}, {} vertices on the boundary, Re ρ from {:.3e}{negative}{tilted}",
        quad_graph.vertices,
        plural(quad_graph.quads, "quad", "quads"),
        quad_graph.boundary_vertices,
        quad_graph.min_re_rho
    )?;
    let seconds = &solver.seconds;
    let how = match (solver.residual, solver.gradient_norm) {
        (Some(residual), _) if solver.epsilon.is_some() => format!(
            "{} after {}, boundary on two circles to {residual:.1e}, ε = {:.2e}",
            solver.status,
            plural(solver.iterations, "iteration", "iterations"),
            solver.epsilon.unwrap_or_default()
        ),
        // The lengths of the boundary have a line of their own.
        (Some(_), _) if solver.exactly.is_some() => {
            format!("{} after {}", solver.status, plural(solver.iterations, "iteration", "iterations"))
        }
        (Some(residual), _) => format!("to a relative residual of {residual:.1e}"),
        (None, gradient) => format!(
            "{} after {}, |gradient| {:.1e}",
            if solver.status == "precision" { "converged to rounding" } else { solver.status },
            plural(solver.iterations, "iteration", "iterations"),
            gradient.unwrap_or_default()
        ),
    };
    writeln!(
        out,
        "{}: {how}; read {:.3} s, assemble {:.3} s, order {:.3} s, factor {:.3} s, solve {:.3} s",
        solver.backend, seconds.read, seconds.assemble, seconds.order, seconds.factor, seconds.solve
    )?;
    let EnergyRecord { total, H, C, A, L, Lb, MIPS, SD } = &record.energy;
    let terms: Vec<String> = [("H", H), ("C", C), ("A", A), ("L", L), ("L'", Lb), ("MIPS", MIPS), ("SD", SD)]
        .into_iter()
        .filter_map(|(name, value)| Some(format!("{name} = {:.6e}", (*value)?)))
        .collect();
    if let Some(total) = total {
        writeln!(out, "energy {total:.6e}: {}", terms.join(", "))?;
    }
    if let Some(sigma) = solver.smallest_singular_value {
        writeln!(out, "smallest singular value of the Jacobian: {sigma:.3e}")?;
    }
    if let Some(periods) = &record.periods {
        let number = |[re, im]: [f64; 2]| format!("{re:.7} + {im:.7} i");
        let [first, second] = periods.loops.each_ref().map(|walk| plural(walk.vertices.len(), "edge", "edges"));
        writeln!(out, "periods 1 and τ = {}, along loops of {first} and {second}", number(periods.tau))?;
        if let (Some(exact), Some(error)) = (periods.exact, periods.error) {
            writeln!(out, "exact τ = {}: {:.4} % off", number(exact), 100.0 * error)?;
        }
    }
    if let Some(error) = &record.error {
        writeln!(out, "distance to the exact map: max {:.3e}, rms {:.3e}", error.max, error.rms)?;
    }
    if let Some(error) = distortion.length.and_then(|length| length.boundary_max) {
        writeln!(out, "lengths of boundary edges: off by {error:.1e} at most")?;
    }
    if let Some(lengths) = &record.boundary_lengths {
        let given = if lengths.given == LengthUnit::Factors { "by factors" } else { "as lengths" };
        writeln!(
            out,
            "{}, given {given}, {:.6e} together: off by {:.1e} at most",
            plural(lengths.edges, "boundary edge", "boundary edges"),
            lengths.perimeter,
            lengths.error.max
        )?;
    }
    if let Some(error) = &distortion.quasi_conformal {
        writeln!(
            out,
            "quasi-conformal error σ1/σ2: median {:.5}, 90 % {:.5}, mean without ears {}, mean {:.5}, by area {:.5}, 99 % {:.5}, max {:.5}",
            error.median,
            error.p90,
            error.without_ears.map_or("–".to_owned(), |mean| format!("{mean:.5}")),
            error.mean,
            error.area_mean,
            error.p99,
            error.max
        )?;
    }
    if let Some(area) = &distortion.area {
        let smallest = distortion.smallest_scale.unwrap_or(1.0);
        writeln!(
            out,
            "area distortion: mean {:.4}, max {:.4}; the smallest scale is {smallest:.2e} of the largest",
            area.mean, area.max
        )?;
    }
    let simple = if distortion.boundary_crosses { "crosses itself" } else { "is simple" };
    let one_to_one = if solver.valid { "; injective by the exact check" } else { "" };
    writeln!(out, "{} flipped; the boundary {simple}{one_to_one}", plural(distortion.flipped, "face", "faces"))?;
    Ok(())
}
