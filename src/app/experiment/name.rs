//! Names of runs, plots and configs: short, of a safe alphabet, and unique by construction.

use std::collections::{HashMap, HashSet};

use serde_json::Value;

/// The largest length in bytes of the name of a run, without the number that tells equal names
/// apart.
const LONGEST: usize = 100;

/// What the names of a run's pictures end in: [`Picture::suffix`](super::Picture::suffix).
pub(super) const SUFFIXES: [&str; 3] = ["", "-flat", "-checkerboard"];

/// Names that mean something else in a folder of results.
const RESERVED: [&str; 3] = ["bench", "figures", "provenance"];

/// The names given so far. Every name is asked for by its base, so that naming `n` runs takes
/// `O(n)` look-ups even where all bases are equal: each base remembers the number it gave last.
#[derive(Default)]
pub(super) struct Names {
    given: HashSet<String>,
    last: HashMap<String, usize>,
}

impl Names {
    /// Makes a name taken.
    pub(super) fn reserve(&mut self, name: &str) {
        self.given.insert(name.to_owned());
    }

    /// Returns the first of `base`, `base-2`, `base-3`, … that is free with each of `suffixes`
    /// appended, and takes these names.
    pub(super) fn unique(&mut self, base: &str, suffixes: &[&str]) -> String {
        let last = self.last.entry(base.to_owned()).or_insert(0);
        loop {
            *last += 1;
            let name = if *last == 1 { base.to_owned() } else { format!("{base}-{last}") };
            if suffixes.iter().all(|suffix| !self.given.contains(&format!("{name}{suffix}"))) {
                self.given.extend(suffixes.iter().map(|suffix| format!("{name}{suffix}")));
                return name;
            }
        }
    }
}

/// The base of a run's name: the last part of each swept key with the name that `[names]` gives to
/// its value, else with the value, such as `n=33,dual=barycentre`. Every run of other characters
/// than ASCII letters, digits and `+-._=` becomes one hyphen, and a table contributes its values
/// alone, so that the name is one component of a path whatever the config says.
pub(super) fn run_base(config: &Value, swept: &[String], names: &[Option<&str>]) -> String {
    let part = |(key, name): (&String, &Option<&str>)| {
        let value = key.split('.').try_fold(config, |value, name| value.get(name)).unwrap_or(&Value::Null);
        let last = key.rsplit('.').next().unwrap_or(key);
        let value = name.map_or_else(|| text(value), str::to_owned);
        format!("{}={}", plain(last), plain(&value))
    };
    let mut name = swept.iter().zip(names).map(part).collect::<Vec<_>>().join(",");
    // Every character is one byte here.
    name.truncate(LONGEST);
    if name.is_empty() { "run".to_owned() } else { name }
}

/// A value as words: strings as they are, the values of tables and arrays one after the other.
fn text(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Object(fields) => fields.values().map(text).collect::<Vec<_>>().join("-"),
        Value::Array(items) => items.iter().map(text).collect::<Vec<_>>().join("-"),
        other => other.to_string(),
    }
}

fn plain(text: &str) -> String {
    let mut name = String::new();
    for c in text.chars().take(LONGEST) {
        if c.is_ascii_alphanumeric() || "+-._=".contains(c) {
            name.push(c);
        } else if !name.ends_with('-') && !name.is_empty() {
            name.push('-');
        }
    }
    name.truncate(name.trim_end_matches('-').len());
    name
}

/// The middle of the name of a run's pictures: [`run_base`] without the keys, of ASCII letters,
/// digits and hyphens, which neither LaTeX nor a shell gives a meaning.
pub(super) fn picture_base(run: &str) -> String {
    let values = run.split(',').map(|part| part.split_once('=').map_or(part, |(_, value)| value));
    let joined = values.collect::<Vec<_>>().join("-").replace(['+', '.', '_'], "-");
    let mut name = String::new();
    joined.chars().filter(|c| c.is_ascii_alphanumeric() || *c == '-').for_each(|c| {
        if c != '-' || !(name.is_empty() || name.ends_with('-')) {
            name.push(c);
        }
    });
    name.truncate(40);
    name.truncate(name.trim_end_matches('-').len());
    if name.is_empty() { "run".to_owned() } else { name }
}

/// Whether a plot may have this name, which becomes a part of the names of its files.
pub(super) fn is_plot_name(name: &str) -> bool {
    (1..=LONGEST).contains(&name.len()) && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '-' || c == '_')
}

/// Whether the results of a config may have this name, which becomes a folder and a part of the
/// names of files.
pub(super) fn is_config_name(name: &str) -> bool {
    let allowed = |c: char| c.is_alphanumeric() || "-_.".contains(c);
    name.len() <= LONGEST
        && name.starts_with(char::is_alphanumeric)
        && name.chars().all(allowed)
        && !RESERVED.contains(&name)
}

/// The one of `known` that `word` is a misspelling of: at most two single-character edits, and
/// fewer than its length.
pub(super) fn near<'k>(word: &str, known: &[&'k str]) -> Option<&'k str> {
    let distances = known.iter().map(|name| (edits(word, name), *name));
    distances.filter(|(edits, name)| *edits <= 2 && *edits < name.chars().count()).min().map(|(_, name)| name)
}

/// The Levenshtein distance of two words.
fn edits(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let substituted = diagonal + usize::from(x != *y);
            diagonal = row[j + 1];
            row[j + 1] = substituted.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

/// A text that two values have in common if and only if they are equal, 33 and 33.0 included.
pub(super) fn canonical(value: &Value) -> String {
    match value {
        Value::Object(fields) => {
            let fields: Vec<_> = fields.iter().map(|(name, field)| format!("{name:?}:{}", canonical(field))).collect();
            format!("{{{}}}", fields.join(","))
        }
        Value::Array(items) => format!("[{}]", items.iter().map(canonical).collect::<Vec<_>>().join(",")),
        Value::Number(number) => match number.as_f64() {
            Some(x) if x.abs() < 9e15 => format!("{:?}", x + 0.0),
            _ => number.to_string(),
        },
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn equal_bases_get_distinct_names_in_linear_time() {
        let mut names = Names::default();
        let all: HashSet<String> = (0..200_000).map(|_| names.unique("n=1", &[""])).collect();
        assert_eq!(all.len(), 200_000);
        assert!(all.contains("n=1") && all.contains("n=1-200000"));
    }

    #[test]
    fn a_base_that_looks_numbered_stays_distinct() {
        let mut names = Names::default();
        let given = ["a-2", "a", "a", "a-2", "a"].map(|base| names.unique(base, &[""]));
        assert_eq!(given, ["a-2", "a", "a-3", "a-2-2", "a-4"]);
    }

    #[test]
    fn pictures_with_their_suffixes_and_plots_have_distinct_names() {
        let mut names = Names::default();
        names.reserve("error");
        let given = ["a", "a-flat", "error", "b-flat", "b"].map(|base| names.unique(base, &SUFFIXES));
        assert_eq!(given, ["a", "a-flat-2", "error-2", "b-flat", "b-2"]);
    }

    #[test]
    fn run_names_are_one_component_of_a_path() {
        let keys = ["x./VICTIM////thesis", "x.aééééééééé", "x...", "x.\n", "surface.source"].map(str::to_owned);
        for key in keys {
            let name = run_base(
                &json!({"surface": {"source": "../../$(touch a)%&~.off"}}),
                std::slice::from_ref(&key),
                &[None],
            );
            assert!(name.chars().all(|c| c.is_ascii_alphanumeric() || "+-._=".contains(c)), "{name}");
            assert!(name.contains('='), "{name} could be . or ..");
        }
    }

    #[test]
    fn a_swept_table_is_named_by_its_values() {
        let config = json!({"map": {"boundary": "free", "cut": true}});
        let name = run_base(&config, &["map".to_owned()], &[None]);
        assert_eq!(name, "map=free-true");
        assert_eq!(run_base(&config, &["map".to_owned()], &[Some("cut")]), "map=cut");
        assert_eq!(picture_base(&name), "free-true");
        assert_eq!(picture_base("energy=H-0.03-A,n=33"), "H-0-03-A-33");
    }

    #[test]
    fn near_names_are_found_and_distant_ones_are_not() {
        assert_eq!(near("maps", &["surface", "map", "solver"]), Some("map"));
        assert_eq!(near("nonsense", &["surface", "map", "solver"]), None);
    }
}
