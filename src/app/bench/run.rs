//! All contests in sequence.

use std::env;
use std::fs;
use std::path::PathBuf;
use std::time::Duration;

use super::contest::{Entrant, Rules};
use super::exchange::exchange;
use super::median::compare;
use super::record::{ContestOutcome, Entry, Record};
use super::target::{Target, fan};
use super::{BenchError, CASES, CONTESTANTS, Case, Peers, Source, case};
use crate::input::{Input, InputError};

/// The cases, sizes and limits of a comparison.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Names of the cases; all cases if empty.
    pub cases: Vec<String>,
    /// Approximate numbers of vertices.
    pub sizes: Vec<usize>,
    /// Whether peers take part; those that are not installed are named in the record.
    pub against_peers: bool,
    /// The program of Boundary First Flattening, `bff-command-line`, as an absolute path.
    pub bff: Option<PathBuf>,
    /// Number of runs of each contestant on each mesh.
    pub repeats: usize,
    /// Time limit of a process.
    pub limit: Duration,
    /// Total time of the runs on a mesh after which a contestant is not run on it again.
    pub patience: Duration,
    /// Folders in which public files are searched.
    pub data: Vec<PathBuf>,
}

/// An event of a comparison.
#[derive(Debug)]
pub enum Event<'a> {
    /// A mesh is ready.
    Mesh {
        /// Name of the case.
        case: &'static str,
        /// Number of vertices.
        vertices: usize,
        /// Number of faces.
        faces: usize,
    },
    /// A contestant has finished on the mesh.
    Entry(&'a Entry),
    /// A case has no mesh.
    PassedOver(&'a str),
}

/// Runs every contestant on every mesh of the plan. Each run is a process with one thread, and
/// contestants take turns: the second runs follow after all first runs. Peers map quads split into
/// triangles; all maps are measured on the mesh itself, by our code.
///
/// # Errors
/// A case is unknown, a mesh cannot be generated, or the system cannot start processes. The failure
/// of a contestant is a [`ContestOutcome`].
pub fn run(plan: &Plan, peers: Option<&Peers>, tell: &mut dyn FnMut(Event)) -> Result<Record, BenchError> {
    let cases = chosen(&plan.cases)?;
    let riemap = env::current_exe().map_err(BenchError::io("the running program cannot be found"))?;
    let folder = tempfile::Builder::new().prefix("riemap-bench-").tempdir();
    let folder = folder.map_err(BenchError::io("a temporary folder cannot be made"))?;
    let (folder, limit) = (folder.path(), plan.limit);
    let bff = plan.bff.as_deref();
    let rules = Rules { riemap: &riemap, peers, bff, folder, limit, repeats: plan.repeats, patience: plan.patience };
    let mut record = Record::of_this_machine(peers, limit.as_secs_f64());
    for case in &cases {
        for (size, source) in meshes(case, plan, &mut record.passed_over) {
            let target = Target::new(open(case, size, source)?, folder)?;
            let (vertices, faces) = (target.vertices, target.faces);
            tell(Event::Mesh { case: case.name, vertices, faces });
            let mut entrants: Vec<Entrant> = CONTESTANTS
                .iter()
                .filter(|contestant| contestant.is_ours() || plan.against_peers)
                .filter(|contestant| contestant.enters(case, vertices))
                .map(|contestant| Entrant::new(contestant, expected(&record, case, contestant.name, vertices), &rules))
                .collect();
            for round in 0..plan.repeats {
                for entrant in entrants.iter_mut().filter(|entrant| entrant.is_next(round, &rules)) {
                    entrant.run(&target, &rules)?;
                }
            }
            let size = size.unwrap_or(vertices);
            let first = record.entries.len();
            for entrant in entrants {
                let (outcome, contestant) = (entrant.outcome(), entrant.contestant);
                record.entries.push(Entry {
                    case: case.name,
                    size,
                    mesh: target.name.clone(),
                    vertices,
                    faces,
                    contestant: contestant.name,
                    kind: contestant.kind,
                    runs: entrant.runs,
                    outcome,
                    ratio: None,
                });
            }
            compare(&mut record.entries);
            record.entries[first..].iter().for_each(|entry| tell(Event::Entry(entry)));
        }
        record
            .passed_over
            .iter()
            .filter(|reason| reason.starts_with(case.name))
            .for_each(|r| tell(Event::PassedOver(r)));
    }
    let largest = record.entries.iter().filter(|e| e.case == CASES[0].name).max_by_key(|e| e.vertices);
    if let Some(source) = largest.map(|entry| entry.mesh.clone()) {
        record.exchange = exchange(&source, folder, plan.repeats)?;
    }
    if record.entries.is_empty() && record.passed_over.is_empty() {
        return Err(BenchError::NoMesh { cases: plan.cases.join(", ") });
    }
    Ok(record)
}

/// Returns the cases of these names; without names, all cases.
///
/// # Errors
/// There is no case of a name.
pub fn chosen(names: &[String]) -> Result<Vec<&'static Case>, BenchError> {
    if names.is_empty() {
        return Ok(CASES.iter().collect());
    }
    let known = || CASES.iter().map(|case| case.name).collect::<Vec<_>>().join(", ");
    let unknown = |name: &String| BenchError::UnknownCase { name: name.clone(), known: known() };
    names.iter().map(|name| case(name).ok_or_else(|| unknown(name))).collect()
}

/// Returns the meshes of a case in ascending order: the requested size, unless it is a file, and
/// the source.
fn meshes(case: &Case, plan: &Plan, passed_over: &mut Vec<String>) -> Vec<(Option<usize>, String)> {
    if let Source::File(name) = case.source {
        let found = plan.data.iter().map(|folder| folder.join(name)).find(|path| path.is_file());
        if found.is_none() {
            passed_over.push(format!("{}: {name} is in none of the folders of public files ($RIEMAP_DATA)", case.name));
        }
        return found.into_iter().map(|path| (None, path.to_string_lossy().into_owned())).collect();
    }
    let mut sizes = plan.sizes.clone();
    sizes.sort_unstable();
    sizes.dedup();
    sizes.into_iter().filter_map(|size| Some((Some(size), case.mesh(size)?))).collect()
}

/// Opens the mesh of a case for the size asked for.
fn open(case: &Case, size: Option<usize>, source: String) -> Result<Input, InputError> {
    match (case.source, size) {
        (Source::Fan, Some(triangles)) => Ok(Input::of(source, fan(triangles))),
        _ => Input::open(&source),
    }
}

/// Returns a lower estimate of the seconds of a process: those on the largest smaller mesh, times
/// the ratio of the numbers of vertices.
fn expected(record: &Record, case: &Case, contestant: &str, vertices: usize) -> Option<f64> {
    let earlier = record.entries.iter().rev().find(|e| e.case == case.name && e.contestant == contestant)?;
    let seconds = match &earlier.outcome {
        ContestOutcome::Done { median, .. } => median.whole.wall,
        ContestOutcome::OverTheLimit { limit, expected, .. } => expected.unwrap_or(*limit),
        ContestOutcome::Failed { .. } | ContestOutcome::LeftOut { .. } => return None,
    };
    Some(seconds * vertices as f64 / earlier.vertices as f64)
}

impl Record {
    fn of_this_machine(peers: Option<&Peers>, limit: f64) -> Record {
        let mut versions = peers.map(|peers| peers.versions.clone()).unwrap_or_default();
        versions.insert("riemap".to_owned(), env!("CARGO_PKG_VERSION").to_owned());
        versions.extend(crate::app::experiment::revision().map(|revision| ("revision".to_owned(), revision)));
        let processor = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        let model = processor.lines().find(|line| line.starts_with("model name")).and_then(|l| l.split(": ").nth(1));
        let machine = format!("{}, {}", model.unwrap_or("unknown processor"), env::consts::OS);
        Record { entries: Vec::new(), exchange: Vec::new(), versions, machine, passed_over: Vec::new(), limit }
    }
}
