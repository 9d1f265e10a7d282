use riemap::app::experiment::Outcome;

use super::shared::*;

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let configs = [load("a", &pictured()), load("b", &STUDY.replace("plane", "sphere"))];
    let serial = folder();
    let told = batch(&configs, serial.path(), &How::default());
    assert_eq!(told.made.len(), 16);
    assert_eq!(told.summed, ["a", "b"]);
    let parallel = folder();
    assert_eq!(batch(&configs, parallel.path(), &How { threads: 5, ..How::default() }).made.len(), 16);
    let (one, five) = (contents(serial.path()), contents(parallel.path()));
    // Records and a table each, and their provenance; 16 pictures, and a plot in two formats.
    assert_eq!(one.len(), 2 * 2 + 1 + 16 + 2, "{:?}", one.keys());
    assert!(one.keys().eq(five.keys()));
    for (path, bytes) in &one {
        assert!(five[path] == *bytes, "{}", path.display());
    }
}

#[test]
fn runs_that_are_timed_come_last_and_one_at_a_time() {
    let plain = "[surface]\nsource = \"plane\"\n[sweep]\n\"surface.parameters.n\" = [4, 5, 6, 7]\n";
    let alone = format!("alone = true\n{plain}");
    let configs = [load("timed", &alone), load("other", plain), load("timed-too", &alone)];
    let results = folder();
    let told = batch(&configs, results.path(), &How { threads: 3, ..How::default() });
    let (others, timed) = told.order.split_at(8);
    assert!(others.iter().all(|event| event.ends_with("other")), "{:?}", told.order);
    for (begun, ended) in timed.iter().step_by(2).zip(timed.iter().skip(1).step_by(2)) {
        assert!(begun.starts_with('+') && ended.starts_with('-'), "{:?}", told.order);
    }
    assert_eq!(timed.len(), 16);
}

#[test]
fn a_panic_is_a_failed_record_and_does_not_stop_the_others() {
    let mut config = load("study", STUDY);
    config.runs[2].task = Box::new(Made(|| panic!("a mistake in line {}", 7)));
    let results = folder();
    let told = batch(&[config], results.path(), &How { threads: 2, ..How::default() });
    assert_eq!(told.made.len(), 8);
    let (failed, done): (Vec<_>, Vec<_>) = told.made.iter().partition(|record| record.outcome == Outcome::Failed);
    assert!(done.len() == 7 && done.iter().all(|record| record.outcome == Outcome::Done));
    assert_eq!(failed[0].run, "mesh=quad,n=6");
    let error = failed[0].error.as_ref().unwrap();
    assert!(error.contains("panicked") && error.contains("a mistake in line 7"), "{error}");
    assert!(recorded(results.path(), "study").contains(&"mesh=quad,n=6".to_owned()) && told.summed == ["study"]);
}
