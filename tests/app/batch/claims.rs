use std::path::Path;

use riemap::app::experiment::{Config, Outcome, Record, Settings};

use super::shared::*;

const PLANE: &str = "[surface]\nsource = \"plane?n=4\"\n";

fn made(config: Config, results: &Path) -> Vec<Record> {
    batch(&[config], results, &How::default()).made
}

#[test]
fn a_number_beyond_its_bounds_or_missing_refutes_the_claim() {
    for (bound, holds) in [
        ("\"result.distortion.flipped\" = { max = 0 }", true),
        ("\"result.distortion.flipped\" = { min = 1 }", false),
        ("\"result.distortion.flipped\" = { min = 0, max = 1, equal = 0 }", true),
        ("\"result.distortion.fliped\" = { max = 0 }", false),
        ("\"result.input.kind\" = { max = 0 }", false),
    ] {
        let config = load("study", &format!("{PLANE}[expect]\n{bound}\n"));
        let results = folder();
        let record = &made(config, results.path())[0];
        assert_eq!(record.outcome == Outcome::Done, holds, "{bound}: {:?}", record.error);
    }
}

#[test]
fn a_claim_on_some_runs_binds_these_alone_and_comes_before_one_on_all() {
    let text = format!(
        "{PLANE}[sweep]\n\"map.weight\" = [\"unit\", \"integral\"]\n\
         [expect]\n\"result.distortion.flipped\" = {{ min = 1 }}\n\
         [[expect-where]]\nruns = {{ \"map.weight\" = \"unit\" }}\n\
         bounds = {{ \"result.distortion.flipped\" = {{ max = 0 }}, \"result.input.kind\" = {{ equal = \"quad\" }} }}\n"
    );
    let config = load("study", &text);
    assert_eq!(config.runs[0].expect.len(), 2);
    assert_eq!(config.runs[0].config["expect"]["result.distortion.flipped"], serde_json::json!({ "max": 0 }));
    assert_eq!(config.runs[1].config["expect"], serde_json::json!({ "result.distortion.flipped": { "min": 1 } }));
    assert!(config.runs.iter().all(|run| run.config.get("expect-where").is_none()));
    let results = folder();
    let outcomes: Vec<Outcome> = made(config, results.path()).iter().map(|r| r.outcome).collect();
    assert_eq!(outcomes, [Outcome::Done, Outcome::Refuted]);

    let misspelt = text.replace("{ \"map.weight\" = \"unit\" }", "{ \"map.dual\" = \"incentre\" }");
    let error = load_with("study", &misspelt, &Settings::default());
    let message = error.err().expect("not swept");
    assert!(message.contains("`map.dual` of [[expect-where]] is not swept"), "{message}");
}
