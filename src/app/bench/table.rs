//! The record as Markdown and as CSV.

use std::fmt::Write;

use super::record::{ContestOutcome, Entry, Measured, Record};
use super::requirement::{Verdict, verdicts};
use super::{Contestant, contestant};

/// Returns the bars and one table per mesh as Markdown.
pub fn markdown(record: &Record) -> String {
    let mut text = String::from("# Speed against peers\n\n");
    let versions: Vec<String> = record.versions.iter().map(|(name, version)| format!("{name} {version}")).collect();
    text += &format!(
        "Seconds of the processor (all threads, user and system) and of the clock, medians of the runs. Each run is a process of \
         its own with one thread, contestants in turns. *Solve*: from the mesh in memory to the map in memory. It is the sum of \
         *assembly* (ours: diagnosis, quad graph and matrices; CHOLMOD's: its matrix, made by numpy) and *factor* (ordering or \
         analysis, factorisation and solution), where these are told apart; the functions of libigl and MeshLab assemble inside \
         and are timed as a whole. *Whole*: the process from start to end, reading and writing included; a peer's has the start \
         of Python in it, ours the exact check of the map, its distortion and its writing as OBJ, where peers of Python write \
         bare numbers. BFF is a program that reads and writes OBJ and tells its whole time alone. Peers get quads split into \
         triangles. Our maps are the conformal ones (`--valid off`), and flipped faces are counted as those of the peers. All maps are measured \
         by our code on the faces of the mesh as it is; *SD* is the symmetric Dirichlet energy of the map scaled to the area of \
         the surface, 4 for an isometry. *Ours/its*: the first map of ours of the same kind over this one, processor seconds: of \
         *factor* where the peer tells it apart, otherwise of the solve, otherwise of the whole process. Slow contestants are \
         kept from large meshes, and who has taken 15 s on a mesh is not run on it again.\n\n\
         Machine: {}. Versions: {}. Limit: {} s a process.\n\n",
        record.machine,
        versions.join(", "),
        record.limit
    );
    text += "## Bars\n\n";
    text += &bars(&verdicts(record));
    for mesh in meshes(record) {
        let first = mesh[0];
        let Entry { case, vertices, faces, .. } = first;
        text += &format!("\n## {case}: {vertices} vertices, {faces} faces\n\n");
        text += "| contestant | map | runs | solve cpu | assembly cpu | factor cpu | solve wall | whole cpu | whole wall | \
                 peak MB | σ₁/σ₂ mean | 99 % | area | SD | flipped | ours/its |\n";
        text += &format!("|{}\n", " --: |".repeat(16));
        mesh.iter().for_each(|entry| text += &row(entry));
    }
    if !record.exchange.is_empty() {
        text += "\n## Reading and writing the largest grid\n\n| what | MB | cpu | MB/s |\n| --: | --: | --: | --: |\n";
        for row in &record.exchange {
            let (megabytes, speed) = (row.bytes as f64 / 1e6, row.megabytes_per_second());
            text += &format!("| {} | {megabytes:.1} | {:.3} | {speed:.0} |\n", row.what, row.cpu);
        }
    }
    text += &notes(record);
    text
}

/// Returns the bars as a table.
pub fn bars(verdicts: &[Verdict]) -> String {
    let mut text = String::from("| what | measured | bar | holds |\n| :-- | --: | --: | :-- |\n");
    for Verdict { what, measured, at_most, bound, holds } in verdicts {
        let sign = if *at_most { "< " } else { "" };
        let measured = measured.map_or("not measured".to_owned(), |value| format!("{sign}{}", digits(value)));
        let holds = match holds {
            Some(true) => "yes",
            Some(false) => "**no**",
            None => "",
        };
        let _ = writeln!(text, "| {what} | {measured} | {bound} | {holds} |");
    }
    text
}

/// Returns the numbers of all runs as CSV, one line per entry.
pub fn csv(record: &Record) -> String {
    let mut text = String::from(
        "case,size,vertices,faces,contestant,map,outcome,runs,solve_cpu,solve_wall,assembly_cpu,factor_cpu,whole_cpu,whole_wall,peak_bytes,\
         quasi_conformal,quasi_conformal_p99,area,symmetric_dirichlet,flipped,ratio\n",
    );
    for entry in &record.entries {
        let Entry { case, size, vertices, faces, contestant, kind, runs, outcome, ratio, .. } = entry;
        let name = match outcome {
            ContestOutcome::Done { .. } => "done",
            ContestOutcome::OverTheLimit { .. } => "over-the-limit",
            ContestOutcome::Failed { .. } => "failed",
            ContestOutcome::LeftOut { .. } => "left-out",
        };
        let number = |x: Option<f64>| x.map(|x| format!("{x:?}")).unwrap_or_default();
        let of = |f: &dyn Fn(&Measured) -> Option<f64>| number(entry.median().and_then(f));
        let measured = entry.quality();
        let cells = [
            of(&|m| m.solve?.cpu),
            of(&|m| Some(m.solve?.wall)),
            of(&|m| m.assembly.and_then(|s| s.cpu)),
            of(&|m| m.factor.and_then(|f| f.cpu)),
            of(&|m| m.whole.cpu),
            of(&|m| Some(m.whole.wall)),
            entry.median().and_then(|m| m.peak_bytes).map(|b| b.to_string()).unwrap_or_default(),
            number(measured.and_then(|q| q.quasi_conformal)),
            number(measured.and_then(|q| q.quasi_conformal_p99)),
            number(measured.and_then(|q| q.area)),
            number(measured.and_then(|q| q.symmetric_dirichlet)),
            measured.map(|q| q.flipped.to_string()).unwrap_or_default(),
            number(*ratio),
        ];
        let (kind, runs) = (kind.name(), runs.len());
        let _ =
            writeln!(text, "{case},{size},{vertices},{faces},{contestant},{kind},{name},{runs},{}", cells.join(","));
    }
    text
}

/// Groups the entries by mesh.
fn meshes(record: &Record) -> Vec<Vec<&Entry>> {
    let mut meshes: Vec<Vec<&Entry>> = Vec::new();
    for entry in &record.entries {
        match meshes.last_mut().filter(|mesh| (mesh[0].case, mesh[0].size) == (entry.case, entry.size)) {
            Some(mesh) => mesh.push(entry),
            None => meshes.push(vec![entry]),
        }
    }
    meshes
}

fn row(entry: &Entry) -> String {
    let (name, kind) = (entry.contestant, entry.kind.name());
    let ContestOutcome::Done { median, quality } = &entry.outcome else {
        return format!("| {name} | {kind} | {}{} |\n", brief(&entry.outcome), " |".repeat(13));
    };
    let seconds = |s: Option<f64>| s.map_or("–".to_owned(), |s| format!("{s:.3}"));
    let quality = [quality.quasi_conformal, quality.quasi_conformal_p99, quality.area, quality.symmetric_dirichlet]
        .map(|q| q.map_or("–".to_owned(), |q| format!("{q:.4}")))
        .into_iter()
        .chain([quality.flipped.to_string()])
        .collect::<Vec<_>>()
        .join(" | ");
    format!(
        "| {name} | {kind} | {} | {} | {} | {} | {} | {} | {:.3} | {} | {quality} | {} |\n",
        entry.runs.len(),
        seconds(median.solve.and_then(|s| s.cpu)),
        seconds(median.assembly.and_then(|s| s.cpu)),
        seconds(median.factor.and_then(|s| s.cpu)),
        seconds(median.solve.map(|s| s.wall)),
        seconds(median.whole.cpu),
        median.whole.wall,
        median.peak_bytes.map_or("–".to_owned(), |b| format!("{:.0}", b as f64 / 1e6)),
        entry.ratio.map(digits).unwrap_or_default(),
    )
}

/// Describes an outcome without numbers in a few words.
pub fn brief(outcome: &ContestOutcome) -> String {
    match outcome {
        ContestOutcome::Done { .. } => "done".to_owned(),
        ContestOutcome::OverTheLimit { limit, expected: None, .. } => format!("over the limit of {limit} s, stopped"),
        ContestOutcome::OverTheLimit { limit, expected: Some(seconds), .. } => {
            format!("over the limit of {limit} s by the smaller mesh ({seconds:.0} s or more), not begun")
        }
        ContestOutcome::Failed { .. } => "failed".to_owned(),
        ContestOutcome::LeftOut { lacks, .. } => format!("left out: {lacks} is not installed"),
    }
}

/// Describes the contestants, and the failures.
fn notes(record: &Record) -> String {
    let mut text = String::from("\n## Contestants\n\n");
    let mut named: Vec<&str> = Vec::new();
    let mut said: Vec<String> = record.passed_over.iter().map(|reason| format!("passed over: {reason}")).collect();
    for entry in &record.entries {
        if !named.contains(&entry.contestant) {
            named.push(entry.contestant);
        }
        let name = entry.contestant;
        let what = match &entry.outcome {
            ContestOutcome::Failed { reason } => {
                format!("{name} failed on {} at {}: {reason}", entry.case, entry.vertices)
            }
            ContestOutcome::LeftOut { lacks, install } => {
                format!("{name} is left out: {lacks} is not installed; {install}")
            }
            ContestOutcome::Done { .. } | ContestOutcome::OverTheLimit { .. } => continue,
        };
        if !said.contains(&what) {
            said.push(what);
        }
    }
    for Contestant { name, about, .. } in named.into_iter().filter_map(contestant) {
        let _ = writeln!(text, "- {name}: {about}");
    }
    if !said.is_empty() {
        text += "\n## Notes\n\n";
        said.iter().for_each(|what| text += &format!("- {}\n", what.replace('\n', " ")));
    }
    text
}

/// Formats three significant digits, which suffice to compare with a bar.
fn digits(value: f64) -> String {
    let decimals = (2 - value.abs().max(1e-9).log10().floor() as i32).clamp(0, 9) as usize;
    format!("{value:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::digits;

    #[test]
    fn numbers_have_three_digits() {
        let values = [0.0123456, 0.25, 1.0, 12.34, 123.4, 1234.5, 0.0];
        assert_eq!(values.map(digits), ["0.0123", "0.250", "1.00", "12.3", "123", "1234", "0.000000000"]);
    }
}
