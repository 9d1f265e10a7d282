//! What is kept of a comparison.

use std::collections::BTreeMap;

use serde::Serialize;

use super::MapClass;
use crate::distortion::Distortion;

/// Seconds by both clocks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Seconds {
    /// Of the processor, all threads; `None` where the system does not say.
    pub cpu: Option<f64>,
    /// By the clock on the wall.
    pub wall: f64,
}

/// One process.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Measured {
    /// From the mesh in memory to the map there: assembly, factorisation, solution.
    pub solve: Seconds,
    /// The part of it after the assembly, where a peer tells.
    pub factor: Option<Seconds>,
    /// The whole process, from its start over reading and writing to its end.
    pub whole: Seconds,
    /// The most memory held at once.
    pub peak_bytes: Option<u64>,
}

/// How good a map is; all by our code.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Quality {
    /// Mean of σ1/σ2 over faces that are not turned over; `None` where there are none.
    pub quasi_conformal: Option<f64>,
    /// Its 99 % quantile.
    pub quasi_conformal_p99: Option<f64>,
    /// Mean of max(t, 1/t), t the area distortion.
    pub area: Option<f64>,
    /// Faces turned over.
    pub flipped: usize,
}

impl Quality {
    /// Of a measured map.
    pub fn of(distortion: &Distortion) -> Quality {
        let error = distortion.quasi_conformal.as_ref();
        Quality {
            quasi_conformal: error.map(|e| e.mean),
            quasi_conformal_p99: error.map(|e| e.p99),
            area: distortion.area.as_ref().map(|a| a.mean),
            flipped: distortion.flipped,
        }
    }
}

/// How a contestant did on a mesh.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "outcome")]
pub enum ContestOutcome {
    /// It has a map.
    Done {
        /// Medians of the runs.
        median: Measured,
        /// Of its map.
        quality: Quality,
    },
    /// It was stopped, or not begun because a smaller mesh says that it would take longer.
    OverTheLimit {
        /// Seconds a process may take.
        limit: f64,
        /// What it would have taken, at the least, where it was not begun.
        expected: Option<f64>,
        /// Processor seconds that it had when it was stopped.
        spent: Option<f64>,
    },
    /// It ended with an error.
    Failed {
        /// Its last words.
        reason: String,
    },
    /// It is not installed.
    LeftOut {
        /// The package that is missing.
        lacks: &'static str,
        /// What makes it available.
        install: String,
    },
}

/// A contestant on a mesh.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Entry {
    /// Name of the case.
    pub case: &'static str,
    /// Vertices asked for; those of the mesh where it is a file.
    pub size: usize,
    /// Name or path of the mesh.
    pub mesh: String,
    /// Vertices.
    pub vertices: usize,
    /// Faces; peers map them split into triangles.
    pub faces: usize,
    /// Name of the contestant.
    pub contestant: &'static str,
    /// What it seeks.
    pub kind: MapClass,
    /// Every run.
    pub runs: Vec<Measured>,
    /// What came of them.
    #[serde(flatten)]
    pub outcome: ContestOutcome,
    /// Ours over this, processor seconds of the solve; peers that are done.
    pub ratio: Option<f64>,
}

impl Entry {
    /// The medians, where there are any.
    pub fn median(&self) -> Option<&Measured> {
        match &self.outcome {
            ContestOutcome::Done { median, .. } => Some(median),
            _ => None,
        }
    }
}

/// Reading or writing a format.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Exchange {
    /// `read obj`, `write ply`.
    pub what: String,
    /// Size of the file.
    pub bytes: usize,
    /// Processor seconds, median.
    pub cpu: f64,
}

impl Exchange {
    /// 10⁶ bytes a second.
    pub fn megabytes_per_second(&self) -> f64 {
        self.bytes as f64 / 1e6 / self.cpu
    }
}

/// All of it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Record {
    /// Every contestant on every mesh.
    pub entries: Vec<Entry>,
    /// Reading and writing the largest grid.
    pub exchange: Vec<Exchange>,
    /// What took part.
    pub versions: BTreeMap<String, String>,
    /// The processor.
    pub machine: String,
    /// Cases without a mesh, and why.
    pub passed_over: Vec<String>,
    /// Seconds that a process may take.
    pub limit: f64,
}

impl Record {
    /// The entry of a contestant on a mesh.
    pub fn entry(&self, case: &str, size: Option<usize>, contestant: &str) -> Option<&Entry> {
        let is = |e: &&Entry| e.case == case && size.is_none_or(|n| e.size == n) && e.contestant == contestant;
        self.entries.iter().find(is)
    }
}
