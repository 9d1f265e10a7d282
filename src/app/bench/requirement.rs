//! Performance bars: upper and lower limits for measured ratios, times and memory.

use serde::Serialize;

use super::record::{ContestOutcome, Record};

/// The quantity that a bar limits.
#[derive(Clone, Copy, Debug)]
enum Measure {
    /// Processor seconds of the first contestant over those of the second by [`Measured::over`](super::record::Measured::over):
    /// of the factorisation, of the solve, or of the process, whichever both tell first.
    Ratio(&'static str, &'static str),
    /// Symmetric Dirichlet energy of the map of the first contestant over that of the second.
    Energy(&'static str, &'static str),
    /// Processor seconds of the process of a contestant.
    Process(&'static str),
    /// Peak memory of the process of a contestant, in GB of 10⁹ bytes.
    Peak(&'static str),
    /// Processor seconds of the solve of a contestant over those at the given smaller size.
    Growth(&'static str, usize),
    /// Processor seconds of the whole process of a contestant over those of its solve.
    Whole(&'static str),
    /// Lowest speed of reading and writing, in MB/s.
    Slowest,
}

#[derive(Clone, Copy, Debug)]
enum Bound {
    AtMost(f64),
    AtLeast(f64),
}

struct Requirement {
    what: &'static str,
    case: &'static str,
    /// Approximate number of vertices; `None` if the case is a file.
    size: Option<usize>,
    measure: Measure,
    bound: Bound,
}

const TEN_THOUSAND: Option<usize> = Some(10_000);
const HUNDRED_THOUSAND: Option<usize> = Some(100_000);
const MILLION: Option<usize> = Some(1_000_000);

const fn bar(
    what: &'static str,
    case: &'static str,
    size: Option<usize>,
    measure: Measure,
    bound: Bound,
) -> Requirement {
    Requirement { what, case, size, measure, bound }
}

use Bound::{AtLeast, AtMost};
use Measure::{Energy, Growth, Peak, Process, Ratio, Slowest, Whole};

const BARS: &[Requirement] = &[
    bar(
        "circle map of 10⁶ quads over CHOLMOD's harmonic map",
        "grid",
        MILLION,
        Ratio("riemap-circle", "cholmod-harmonic"),
        AtMost(0.4),
    ),
    bar(
        "free map of 10⁶ quads over CHOLMOD's harmonic map",
        "grid",
        MILLION,
        Ratio("riemap-free", "cholmod-harmonic"),
        AtMost(0.4),
    ),
    bar(
        "circle map, Delaunay, 10⁴ vertices, over CHOLMOD's harmonic map",
        "delaunay",
        TEN_THOUSAND,
        Ratio("riemap-circle", "cholmod-harmonic"),
        AtMost(1.5),
    ),
    bar(
        "circle map, Delaunay, 10⁵ vertices, over CHOLMOD's harmonic map",
        "delaunay",
        HUNDRED_THOUSAND,
        Ratio("riemap-circle", "cholmod-harmonic"),
        AtMost(1.5),
    ),
    bar(
        "circle map, Delaunay, 10⁶ vertices, over CHOLMOD's harmonic map",
        "delaunay",
        MILLION,
        Ratio("riemap-circle", "cholmod-harmonic"),
        AtMost(0.9),
    ),
    bar(
        "free map, Delaunay, 10⁴ vertices, over libigl's LSCM",
        "delaunay",
        TEN_THOUSAND,
        Ratio("riemap-free", "libigl-lscm"),
        AtMost(0.6),
    ),
    bar(
        "free map, Delaunay, 10⁵ vertices, over libigl's LSCM",
        "delaunay",
        HUNDRED_THOUSAND,
        Ratio("riemap-free", "libigl-lscm"),
        AtMost(0.6),
    ),
    bar("free map of bff-face over libigl's LSCM", "bff-face", None, Ratio("riemap-free", "libigl-lscm"), AtMost(0.6)),
    bar(
        "circle map, Delaunay, 10⁵ vertices, whole program over BFF's",
        "delaunay",
        HUNDRED_THOUSAND,
        Ratio("riemap-circle", "bff-disc"),
        AtMost(0.4),
    ),
    bar(
        "free map, Delaunay, 10⁵ vertices, whole program over BFF's",
        "delaunay",
        HUNDRED_THOUSAND,
        Ratio("riemap-free", "bff-free"),
        AtMost(0.4),
    ),
    bar(
        "SD, Delaunay, 10⁴ vertices, over libigl's SLIM of 20 iterations",
        "delaunay",
        TEN_THOUSAND,
        Ratio("riemap-sd", "libigl-slim"),
        AtMost(0.5),
    ),
    bar("energy SD of that map over SLIM's", "delaunay", TEN_THOUSAND, Energy("riemap-sd", "libigl-slim"), AtMost(1.0)),
    bar(
        "SD, Delaunay, 10⁵ vertices, over libigl's SLIM of 20 iterations",
        "delaunay",
        HUNDRED_THOUSAND,
        Ratio("riemap-sd", "libigl-slim"),
        AtMost(0.5),
    ),
    bar(
        "energy SD of that map over SLIM's",
        "delaunay",
        HUNDRED_THOUSAND,
        Energy("riemap-sd", "libigl-slim"),
        AtMost(1.0),
    ),
    bar(
        "circle map of 10⁶ quads over libigl's harmonic map",
        "grid",
        MILLION,
        Ratio("riemap-circle", "libigl-harmonic"),
        AtMost(0.25),
    ),
    bar("free map of 10⁶ quads over libigl's LSCM", "grid", MILLION, Ratio("riemap-free", "libigl-lscm"), AtMost(0.1)),
    bar(
        "H + A + L of 10⁵ quads over libigl's SLIM",
        "grid",
        HUNDRED_THOUSAND,
        Ratio("riemap-isometric", "libigl-slim"),
        AtMost(0.3),
    ),
    bar("peak memory, circle map, Delaunay, 10⁶ vertices, GB", "delaunay", MILLION, Peak("riemap-circle"), AtMost(1.7)),
    bar("peak memory, free map, Delaunay, 10⁶ vertices, GB", "delaunay", MILLION, Peak("riemap-free"), AtMost(1.7)),
    bar("peak memory, circle map of 10⁶ quads, GB", "grid", MILLION, Peak("riemap-circle"), AtMost(0.8)),
    bar("peak memory, free map of 10⁶ quads, GB", "grid", MILLION, Peak("riemap-free"), AtMost(0.8)),
    bar(
        "circle map of a fan of 10⁵ triangles, whole program, s",
        "fan",
        HUNDRED_THOUSAND,
        Process("riemap-circle"),
        AtMost(10.0),
    ),
    bar(
        "free map of a fan of 10⁵ triangles, whole program, s",
        "fan",
        HUNDRED_THOUSAND,
        Process("riemap-free"),
        AtMost(10.0),
    ),
    bar("circle map of 10⁶ quads over that of 10⁵", "grid", MILLION, Growth("riemap-circle", 100_000), AtMost(15.0)),
    bar("free map of 10⁶ quads over that of 10⁵", "grid", MILLION, Growth("riemap-free", 100_000), AtMost(15.0)),
    bar(
        "circle map, Delaunay, 10⁶ vertices over 10⁵",
        "delaunay",
        MILLION,
        Growth("riemap-circle", 100_000),
        AtMost(15.0),
    ),
    bar(
        "`riemap map` of 10⁶ quads, read to write, over its solve",
        "grid",
        MILLION,
        Whole("riemap-circle"),
        AtMost(2.0),
    ),
    bar("slowest of reading and writing meshes, MB/s", "grid", None, Slowest, AtLeast(100.0)),
];

/// A bar and its outcome.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Verdict {
    /// Description of the quantity.
    pub what: &'static str,
    /// The measured value; `None` if a part of it was not measured.
    pub measured: Option<f64>,
    /// Whether the true value is below `measured`, because a peer was stopped at its time limit.
    pub at_most: bool,
    /// The limit, such as `≤ 0.6`.
    pub bound: String,
    /// Whether the limit is kept; `None` if this is not known.
    pub holds: Option<bool>,
}

/// Returns the outcome of every bar, as far as the record has measured it.
pub fn verdicts(record: &Record) -> Vec<Verdict> {
    BARS.iter().map(|bar| bar.verdict(record)).collect()
}

impl Requirement {
    fn verdict(&self, record: &Record) -> Verdict {
        let (measured, at_most) = self.measure(record).map_or((None, false), |(value, at_most)| (Some(value), at_most));
        let (bound, holds) = match self.bound {
            AtMost(most) => (format!("≤ {most}"), measured.map(|value| value <= most)),
            AtLeast(least) => (format!("≥ {least}"), measured.map(|value| value >= least)),
        };
        // What is known to be below some number may be below the bound as well.
        let holds = holds.filter(|holds| *holds || !at_most);
        Verdict { what: self.what, measured, at_most, bound, holds }
    }

    /// Returns the value, and whether it is only an upper bound.
    fn measure(&self, record: &Record) -> Option<(f64, bool)> {
        let median = |name: &str, size| record.entry(self.case, size, name).and_then(|entry| entry.median());
        let cpu = |name: &str, size| median(name, size).and_then(|m| m.solve?.cpu);
        let (value, at_most) = match self.measure {
            Ratio(ours, peer) => {
                let entry = record.entry(self.case, self.size, peer)?;
                match entry.outcome {
                    ContestOutcome::OverTheLimit { spent: Some(spent), .. } => (cpu(ours, self.size)? / spent, true),
                    _ => (median(ours, self.size)?.over(entry.median()?)?, false),
                }
            }
            Energy(ours, peer) => {
                let energy = |name| record.entry(self.case, self.size, name)?.quality()?.symmetric_dirichlet;
                (energy(ours)? / energy(peer)?, false)
            }
            Process(name) => (median(name, self.size)?.whole.cpu?, false),
            Peak(name) => (median(name, self.size)?.peak_bytes? as f64 / 1e9, false),
            Growth(name, smaller) => (cpu(name, self.size)? / cpu(name, Some(smaller))?, false),
            Whole(name) => (median(name, self.size)?.whole.cpu? / cpu(name, self.size)?, false),
            Slowest => {
                // Of less than that the opening of a file is the most.
                let large = record.exchange.iter().filter(|row| row.bytes >= 1_000_000);
                let speeds = large.map(|row| row.megabytes_per_second());
                (speeds.min_by(f64::total_cmp)?, false)
            }
        };
        Some((value, at_most)).filter(|(value, _)| value.is_finite())
    }
}
