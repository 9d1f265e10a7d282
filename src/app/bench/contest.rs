//! The contest on one mesh: contestants take turns, each run in its own process.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use num_complex::Complex64;
use serde_json::Value;

use super::bff;
use super::median::medians;
use super::python::{lacks, last_words, one_thread};
use super::record::{ContestOutcome, Measured, Quality, Seconds};
use super::target::Target;
use super::{BenchError, Contestant, Peers, Program};
use crate::app::measure::process::{Bounds, End, Ended, watch};

/// Settings of all contests.
pub(super) struct Rules<'a> {
    /// Path of this program.
    pub riemap: &'a Path,
    pub peers: Option<&'a Peers>,
    /// The program of Boundary First Flattening.
    pub bff: Option<&'a Path>,
    /// Folder of the maps that contestants write.
    pub folder: &'a Path,
    pub limit: Duration,
    pub repeats: usize,
    /// Time after which a contestant is not run on the same mesh again.
    pub patience: Duration,
}

/// A contestant on one mesh, with its runs so far and their outcome.
pub(super) struct Entrant {
    pub contestant: &'static Contestant,
    pub runs: Vec<Measured>,
    quality: Quality,
    end: Option<ContestOutcome>,
}

/// The result of a run.
enum Run {
    Done(Measured, Result<Quality, String>),
    Stopped { spent: Option<f64> },
    Failed(String),
}

impl Entrant {
    /// Enters a contestant on a mesh for which a process needs at least `expected` seconds, judging
    /// by a smaller mesh.
    pub fn new(contestant: &'static Contestant, expected: Option<f64>, rules: &Rules) -> Entrant {
        let limit = rules.limit.as_secs_f64();
        let over = expected.filter(|&seconds| seconds > limit);
        let end = match lacks(rules.peers, rules.bff, contestant) {
            Some((lacks, install)) => Some(ContestOutcome::LeftOut { lacks, install }),
            None => over.map(|seconds| ContestOutcome::OverTheLimit { limit, expected: Some(seconds), spent: None }),
        };
        Entrant { contestant, runs: Vec::new(), quality: Quality::default(), end }
    }

    /// Whether it runs in this round.
    pub fn is_next(&self, round: usize, rules: &Rules) -> bool {
        let taken: f64 = self.runs.iter().map(|run| run.whole.wall).sum();
        self.end.is_none() && round < rules.repeats && (round == 0 || taken < rules.patience.as_secs_f64())
    }

    /// Makes its next run.
    pub fn run(&mut self, target: &Target, rules: &Rules) -> Result<(), BenchError> {
        match once(self.contestant, target, rules)? {
            Run::Done(measured, Ok(quality)) => {
                self.runs.push(measured);
                self.quality = quality;
            }
            Run::Done(_, Err(reason)) | Run::Failed(reason) => self.end = Some(ContestOutcome::Failed { reason }),
            Run::Stopped { spent } => {
                let limit = rules.limit.as_secs_f64();
                self.end = Some(ContestOutcome::OverTheLimit { limit, expected: None, spent });
            }
        }
        Ok(())
    }

    /// Returns its outcome.
    pub fn outcome(&self) -> ContestOutcome {
        let done = || medians(&self.runs).map(|median| ContestOutcome::Done { median, quality: self.quality });
        let never = || ContestOutcome::Failed { reason: "it never ran".to_owned() };
        self.end.clone().or_else(done).unwrap_or_else(never)
    }
}

fn once(contestant: &Contestant, target: &Target, rules: &Rules) -> Result<Run, BenchError> {
    let of = |name: &str| rules.folder.join(name);
    let (map, obj, report) = (of("map"), of("map.obj"), of("report.json"));
    let path = |path: &PathBuf| path.to_string_lossy().into_owned();
    let mut command = match (contestant.program, rules.peers, rules.bff) {
        (Program::Peer(_), Some(peers), _) => peers.command(&[contestant.name, &path(&target.triangles), &path(&map)]),
        (Program::Bff(_), _, Some(bff)) => Command::new(bff),
        _ => Command::new(rules.riemap),
    };
    match contestant.program {
        Program::Riemap(options) => {
            command.arg("map").arg(&target.mesh).arg("-o").arg(&obj).arg("--report").arg(&report);
            command.arg("--quiet").args(options);
            one_thread(&mut command);
        }
        Program::Bff(options) => {
            command.arg(&target.triangles).arg(&obj).args(options);
            one_thread(&mut command);
        }
        Program::Peer(_) => {}
    }
    // What an earlier run has left is not of this one.
    for file in [&map, &obj, &report] {
        let _ = fs::remove_file(file);
    }
    // In a folder without anything that a program might take for its own.
    command.current_dir(rules.folder);
    // A terminal's Ctrl-C reaches the contestant, too.
    let bounds = Bounds { limit: rules.limit, stop: &|| false, with_its_own: false };
    let ended = watch(&mut command, &bounds).map_err(BenchError::io(format!("{} cannot be run", contestant.name)))?;
    match ended.end {
        End::OverTime | End::Stopped => return Ok(Run::Stopped { spent: ended.cpu }),
        End::Itself(status) if !status.success() => {
            return Ok(Run::Failed(format!("{status}: {}", last_words(&ended.stderr))));
        }
        End::Itself(_) => {}
    }
    let lost = || Run::Failed("it ended well and left no map".to_owned());
    Ok(match contestant.program {
        Program::Riemap(_) => match fs::read(&report) {
            Ok(bytes) => {
                let report: Value = serde_json::from_slice(&bytes)?;
                match measured(&ours(&report), &ended) {
                    Some(measured) => Run::Done(measured, Ok(quality(&report))),
                    None => Run::Failed("its report lacks times".to_owned()),
                }
            }
            Err(_) => lost(),
        },
        Program::Bff(_) if !obj.exists() => lost(),
        Program::Bff(_) => {
            let whole = Seconds { cpu: ended.cpu, wall: ended.wall };
            let measured = Measured { whole, peak_bytes: ended.peak_bytes, ..Measured::default() };
            Run::Done(measured, bff::read(&obj, target.vertices).map(|z| either_side(target, z)))
        }
        Program::Peer(_) => match measured(&serde_json::from_str(ended.stdout.trim()).unwrap_or_default(), &ended) {
            Some(measured) => fs::read(&map).map_or_else(|_| lost(), |map| Run::Done(measured, target.quality(&map))),
            None => Run::Failed(format!("it printed `{}`", last_words(&ended.stdout))),
        },
    })
}

/// Measures a map of texture coordinates, or its mirror image if that has fewer flipped faces: the side is not part of them.
fn either_side(target: &Target, z: Vec<Complex64>) -> Quality {
    let mirrored = z.iter().map(Complex64::conj).collect();
    let quality = target.measure(z);
    if 2 * quality.flipped > target.faces { target.measure(mirrored) } else { quality }
}

/// Returns our report in the form of a peer's answer.
fn ours(report: &Value) -> Value {
    let solver = &report["solver"];
    let sum =
        |seconds: &Value, phases: &[&str]| phases.iter().map(|phase| seconds[phase].as_f64()).sum::<Option<f64>>();
    let both = |phases: &[&str]| serde_json::json!({ "wall": sum(&solver["seconds"], phases), "cpu": sum(&solver["cpu_seconds"], phases) });
    serde_json::json!({
        "solve": both(&["assemble", "order", "factor", "solve"]),
        "assembly": both(&["assemble"]),
        "factor": both(&["order", "factor", "solve"]),
        "peak_bytes": solver["peak_bytes"],
    })
}

/// Returns the run from the answer of a process and its measurements; `None` if the answer has no
/// times.
fn measured(answer: &Value, ended: &Ended) -> Option<Measured> {
    let seconds = |of: &Value| Some(Seconds { cpu: of["cpu"].as_f64(), wall: of["wall"].as_f64()? });
    Some(Measured {
        solve: Some(seconds(&answer["solve"])?),
        assembly: seconds(&answer["assembly"]),
        factor: seconds(&answer["factor"]),
        whole: Seconds { cpu: ended.cpu, wall: ended.wall },
        peak_bytes: answer["peak_bytes"].as_u64().max(ended.peak_bytes),
    })
}

fn quality(report: &Value) -> Quality {
    let distortion = &report["distortion"];
    Quality {
        quasi_conformal: distortion["quasi_conformal"]["mean"].as_f64(),
        quasi_conformal_p99: distortion["quasi_conformal"]["p99"].as_f64(),
        area: distortion["area"]["mean"].as_f64(),
        symmetric_dirichlet: distortion["symmetric_dirichlet"].as_f64(),
        // A number of our own report.
        flipped: distortion["flipped"].as_u64().unwrap_or_default() as usize,
    }
}
