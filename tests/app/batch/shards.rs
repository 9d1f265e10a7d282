use std::thread;

use riemap::app::experiment::Shard;

use super::shared::*;

#[test]
fn shards_at_work_at_the_same_time_leave_what_one_batch_leaves() {
    let configs = [load("a", &format!("{STUDY}{PLOT}")), load("b", &STUDY.replace("plane", "sphere"))];
    let (merged, whole) = (folder(), folder());
    batch(&configs, whole.path(), &How::default());
    thread::scope(|scope| {
        for index in 1..=3 {
            let (configs, merged) = (&configs, &merged);
            scope.spawn(move || {
                let how = How { shard: Shard { index, count: 3 }, ..How::default() };
                batch(configs, merged.path(), &how)
            });
        }
    });
    let (merged, whole) = (contents(merged.path()), contents(whole.path()));
    assert_eq!(merged.keys().collect::<Vec<_>>(), whole.keys().collect::<Vec<_>>());
    for (path, bytes) in &whole {
        assert!(merged[path] == *bytes, "{}", path.display());
    }
}

#[test]
fn a_shard_continues_as_itself_and_leaves_the_scratch_records_of_the_others() {
    let configs = [load("study", STUDY)];
    let results = folder();
    let of = |index| How { shard: Shard { index, count: 2 }, ..How::default() };
    let first = batch(&configs, results.path(), &How { stop_after: 2, ..of(1) });
    assert_eq!(batch(&configs, results.path(), &of(2)).made.len(), 4);
    let second = batch(&configs, results.path(), &of(1));
    assert_eq!(second.finished_before.len(), first.made.len());
    assert_eq!(first.made.len() + second.made.len(), 4);
    assert!(!results.path().join(".unfinished").exists());
}

#[test]
fn a_plot_of_runs_of_another_shard_waits_for_it() {
    let only = "only = { \"config.surface.parameters.n\" = 7 }\n";
    let configs = [load("study", &format!("{STUDY}{}", PLOT.replace("series =", &format!("{only}series ="))))];
    let results = folder();
    let plot = results.path().join("figures/study-h.svg");
    let shard = |index| How { shard: Shard { index, count: 4 }, ..How::default() };
    batch(&configs, results.path(), &shard(1));
    assert!(!plot.exists());
    (2..=4).for_each(|index| drop(batch(&configs, results.path(), &shard(index))));
    assert!(plot.exists());
}
