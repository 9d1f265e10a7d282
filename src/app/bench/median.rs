//! Medians of runs, and ratios of medians.

use super::record::{Measured, Seconds};
use super::{Entry, contestant};
use crate::app::measure::median::median;

/// Returns the median of each quantity over the runs that report it.
pub fn medians(runs: &[Measured]) -> Option<Measured> {
    let seconds = |of: &dyn Fn(&Measured) -> Option<Seconds>| {
        let known: Vec<Seconds> = runs.iter().filter_map(of).collect();
        let wall = median(known.iter().map(|s| s.wall))?;
        Some(Seconds { cpu: median(known.iter().filter_map(|s| s.cpu)), wall })
    };
    let bytes = median(runs.iter().filter_map(|run| run.peak_bytes).map(|b| b as f64));
    Some(Measured {
        solve: seconds(&|run| run.solve),
        assembly: seconds(&|run| run.assembly),
        factor: seconds(&|run| run.factor),
        whole: seconds(&|run| Some(run.whole))?,
        peak_bytes: bytes.map(|b| b as u64),
    })
}

/// Sets the ratio of every peer to our contestant of the same kind on the same mesh.
pub fn compare(entries: &mut [Entry]) {
    let ours: Vec<_> = entries
        .iter()
        .filter(|e| contestant(e.contestant).is_some_and(|c| c.is_ours()))
        .map(|e| (e.case, e.size, e.kind, e.median().copied()))
        .collect();
    for entry in entries {
        if contestant(entry.contestant).is_some_and(|c| c.is_ours()) {
            continue;
        }
        let own =
            ours.iter().find(|(case, size, kind, _)| (*case, *size, *kind) == (entry.case, entry.size, entry.kind));
        let own = own.and_then(|(_, _, _, median)| median.as_ref());
        entry.ratio = own.zip(entry.median()).and_then(|(own, peer)| own.over(peer));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::bench::record::{ContestOutcome, Quality};

    #[test]
    fn the_median_is_the_middle_one() {
        assert_eq!(median([]), None);
        assert_eq!(median([3.0]), Some(3.0));
        assert_eq!(median([9.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median([4.0, 1.0, 2.0, 9.0]), Some(3.0));
    }

    fn run(cpu: f64, peak_bytes: Option<u64>) -> Measured {
        let solve = Some(Seconds { cpu: Some(cpu), wall: 2.0 * cpu });
        Measured { solve, assembly: None, factor: None, whole: Seconds { cpu: None, wall: 10.0 * cpu }, peak_bytes }
    }

    #[test]
    fn medians_are_of_each_number_by_itself() {
        let runs = [run(3.0, Some(10)), run(1.0, Some(30)), run(2.0, None)];
        let median = medians(&runs).expect("three runs");
        assert_eq!(median.solve, Some(Seconds { cpu: Some(2.0), wall: 4.0 }));
        assert_eq!(median.whole, Seconds { cpu: None, wall: 20.0 });
        assert_eq!((median.factor, median.peak_bytes), (None, Some(20)));
        assert_eq!(medians(&[]), None);
    }

    fn entry(contestant_name: &'static str, size: usize, cpu: Option<f64>) -> Entry {
        let kind = contestant(contestant_name).expect("in the table").kind;
        let outcome = match cpu {
            Some(cpu) => ContestOutcome::Done { median: run(cpu, None), quality: Quality::default() },
            None => ContestOutcome::Failed { reason: "it failed".to_owned() },
        };
        let (case, mesh, runs, ratio) = ("grid", "grid".to_owned(), Vec::new(), None);
        Entry { case, size, mesh, vertices: size, faces: size, contestant: contestant_name, kind, runs, outcome, ratio }
    }

    #[test]
    fn ratios_are_ours_over_the_peer_of_the_same_kind_and_size() {
        let mut entries = [
            entry("riemap-circle", 100, Some(1.0)),
            entry("riemap-circle", 1000, Some(8.0)),
            entry("riemap-free", 1000, Some(6.0)),
            entry("libigl-harmonic", 1000, Some(16.0)),
            entry("libigl-lscm", 1000, Some(12.0)),
            entry("libigl-harmonic", 100, None),
            entry("libigl-slim", 1000, Some(2.0)),
        ];
        compare(&mut entries);
        let ratios: Vec<_> = entries.iter().map(|e| e.ratio).collect();
        // Ours have none, nor have peers that failed or stand alone.
        assert_eq!(ratios, [None, None, None, Some(0.5), Some(0.5), None, None]);
    }

    #[test]
    fn only_what_both_tell_is_compared() {
        let seconds = |cpu| Some(Seconds { cpu: Some(cpu), wall: cpu });
        let whole = Measured { whole: Seconds { cpu: Some(8.0), wall: 9.0 }, ..Measured::default() };
        let solve = Measured { solve: seconds(4.0), ..whole };
        let factor = Measured { assembly: seconds(3.0), factor: seconds(1.0), ..solve };
        let ours = Measured {
            solve: seconds(6.0),
            assembly: seconds(4.0),
            factor: seconds(2.0),
            whole: Seconds { cpu: Some(10.0), wall: 10.0 },
            peak_bytes: None,
        };
        assert_eq!([factor, solve, whole].map(|its| ours.over(&its)), [Some(2.0), Some(1.5), Some(1.25)]);
    }
}
