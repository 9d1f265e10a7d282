//! The record of a comparison.

use std::collections::BTreeMap;

use serde::Serialize;

use super::MapClass;
use crate::distortion::Distortion;

/// Seconds of both clocks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Seconds {
    /// Processor seconds of all threads; `None` if the system does not report them.
    pub cpu: Option<f64>,
    /// Wall-clock seconds.
    pub wall: f64,
}

/// Times and memory of one process.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Measured {
    /// Time from the mesh in memory to the map in memory: assembly, order, factorisation, solution.
    /// `None` for programs that only tell their whole time.
    pub solve: Option<Seconds>,
    /// The assembly, where it is told apart.
    pub assembly: Option<Seconds>,
    /// The rest of the solve, where it is told apart: ordering or analysis, factorisation, solution.
    pub factor: Option<Seconds>,
    /// Time of the whole process, with reading and writing.
    pub whole: Seconds,
    /// Peak memory in bytes.
    pub peak_bytes: Option<u64>,
}

impl Measured {
    /// Returns the processor seconds of this over those of `other`: of the factorisation if both tell it
    /// apart, otherwise of the solve if both tell it, otherwise of the whole process.
    pub fn over(&self, other: &Measured) -> Option<f64> {
        let cpu = |seconds: Option<Seconds>| seconds.and_then(|s| s.cpu);
        let parts = [(self.factor, other.factor), (self.solve, other.solve), (Some(self.whole), Some(other.whole))];
        let ratio = parts.into_iter().find_map(|(ours, its)| Some(cpu(ours)? / cpu(its)?));
        ratio.filter(|ratio| ratio.is_finite())
    }
}

/// Quality of a map, always measured by our code.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Quality {
    /// Mean of σ1/σ2 over the faces that are not flipped; `None` if there are none.
    pub quasi_conformal: Option<f64>,
    /// 99 % quantile of σ1/σ2.
    pub quasi_conformal_p99: Option<f64>,
    /// Mean of max(t, 1/t), where t is the area distortion.
    pub area: Option<f64>,
    /// Mean of the symmetric Dirichlet energy by area, of the map scaled to the area of the surface.
    pub symmetric_dirichlet: Option<f64>,
    /// Number of flipped faces.
    pub flipped: usize,
}

impl Quality {
    /// Returns the quality of a measured map.
    pub fn of(distortion: &Distortion) -> Quality {
        let error = distortion.quasi_conformal.as_ref();
        Quality {
            quasi_conformal: error.map(|e| e.mean),
            quasi_conformal_p99: error.map(|e| e.p99),
            area: distortion.area.as_ref().map(|a| a.mean),
            symmetric_dirichlet: distortion.symmetric_dirichlet,
            flipped: distortion.flipped,
        }
    }
}

/// Outcome of a contestant on a mesh.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "outcome")]
pub enum ContestOutcome {
    /// It returned a map.
    Done {
        /// Medians of the runs.
        median: Measured,
        /// Quality of its map.
        quality: Quality,
    },
    /// It was stopped at the time limit, or not started because it would exceed it, judging by a
    /// smaller mesh.
    OverTheLimit {
        /// Time limit of a process in seconds.
        limit: f64,
        /// Expected time at least, if it was not started.
        expected: Option<f64>,
        /// Processor seconds until it was stopped.
        spent: Option<f64>,
    },
    /// It ended with an error.
    Failed {
        /// Its last message.
        reason: String,
    },
    /// It is not installed.
    LeftOut {
        /// The missing package.
        lacks: &'static str,
        /// How to install it.
        install: String,
    },
}

/// The result of a contestant on a mesh.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Entry {
    /// Name of the case.
    pub case: &'static str,
    /// Requested number of vertices; for a file, the number it has.
    pub size: usize,
    /// Name or path of the mesh.
    pub mesh: String,
    /// Number of vertices.
    pub vertices: usize,
    /// Number of faces; peers map quads split into triangles.
    pub faces: usize,
    /// Name of the contestant.
    pub contestant: &'static str,
    /// Kind of its maps.
    pub kind: MapClass,
    /// All runs.
    pub runs: Vec<Measured>,
    /// The outcome.
    #[serde(flatten)]
    pub outcome: ContestOutcome,
    /// For peers with a map: ours over this one by [`Measured::over`].
    pub ratio: Option<f64>,
}

impl Entry {
    /// Returns the medians, if there are any.
    pub fn median(&self) -> Option<&Measured> {
        match &self.outcome {
            ContestOutcome::Done { median, .. } => Some(median),
            _ => None,
        }
    }

    /// The quality of its map, if there is one.
    pub fn quality(&self) -> Option<&Quality> {
        match &self.outcome {
            ContestOutcome::Done { quality, .. } => Some(quality),
            _ => None,
        }
    }
}

/// Speed of reading or writing a format.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Exchange {
    /// The operation, such as `read obj` or `write ply`.
    pub what: String,
    /// Size of the file in bytes.
    pub bytes: usize,
    /// Median of the processor seconds.
    pub cpu: f64,
}

impl Exchange {
    /// Returns the speed in 10⁶ bytes per second.
    pub fn megabytes_per_second(&self) -> f64 {
        self.bytes as f64 / 1e6 / self.cpu
    }
}

/// The whole record.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Record {
    /// Results of all contestants on all meshes.
    pub entries: Vec<Entry>,
    /// Speed of reading and writing the largest grid.
    pub exchange: Vec<Exchange>,
    /// Programs and packages with their versions.
    pub versions: BTreeMap<String, String>,
    /// Name of the processor.
    pub machine: String,
    /// Cases without a mesh, with the reasons.
    pub passed_over: Vec<String>,
    /// Time limit of a process in seconds.
    pub limit: f64,
}

impl Record {
    /// Returns the entry of a contestant on a mesh.
    pub fn entry(&self, case: &str, size: Option<usize>, contestant: &str) -> Option<&Entry> {
        let is = |e: &&Entry| e.case == case && size.is_none_or(|n| e.size == n) && e.contestant == contestant;
        self.entries.iter().find(is)
    }
}
