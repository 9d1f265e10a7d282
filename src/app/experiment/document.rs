use std::ops::Range;
use std::path::PathBuf;

use serde::Deserialize;
use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Error, ValueDeserializer};

use super::error::ConfigError;
use super::name::{is_plot_name, near};
use super::place::Place;

/// The settings that a command applies to configs.
#[derive(Clone, Debug, Default)]
pub struct Settings {
    /// Texts like `dotted.key=value`. A value given to a swept key replaces the sweep over it.
    pub sets: Vec<String>,
    /// Whether the runs of `[full]` are made.
    pub full: bool,
    /// Folders in which the files of `data:` sources are looked up, in this order.
    pub data: Vec<PathBuf>,
}

/// The texts of a config: the file and every `--set`. Their bytes are numbered consecutively, so
/// that the span of a value tells which of them it came from.
#[derive(Clone, Debug)]
pub(super) struct Sources {
    /// Name, text, and first byte in the common numbering.
    texts: Vec<(String, String, usize)>,
    /// Folders in which public files are looked up.
    data: Vec<PathBuf>,
}

impl Sources {
    /// Joins a file and texts like `key=value`. A value that is not TOML becomes a string.
    pub(super) fn new(file: &str, text: String, settings: &Settings) -> Result<Self, ConfigError> {
        let mut start = text.len() + 1;
        let mut texts = vec![(file.to_owned(), text, 0)];
        for set in &settings.sets {
            let malformed = || ConfigError::Set { text: set.clone() };
            let (key, value) = set.split_once('=').ok_or_else(malformed)?;
            let bare = format!("{} = {}", key.trim(), value.trim());
            let quoted = || format!("{} = {:?}", key.trim(), value.trim());
            let text = if DeTable::parse(&bare).is_ok() { bare } else { quoted() };
            let single = DeTable::parse(&text).map(|table| table.get_ref().len() == 1);
            if !single.unwrap_or(false) {
                return Err(malformed());
            }
            // The blanks in front put the spans where the numbering has this text.
            let padded = " ".repeat(start) + &text;
            texts.push((format!("--set {set}"), padded, start));
            start += text.len() + 1;
        }
        Ok(Sources { texts, data: settings.data.clone() })
    }

    /// Parses the file, applies the `--set` values, and returns their dotted keys too.
    pub(super) fn tree(&self) -> Result<(Document<'_>, Vec<String>), ConfigError> {
        let mut trees = Vec::new();
        for (_, text, _) in &self.texts {
            trees.push(DeTable::parse(text).map_err(|e| self.error(&e, None))?);
        }
        let mut trees = trees.into_iter();
        let root = trees.next().unwrap_or_else(|| Spanned::new(0..0, DeTable::new()));
        let mut document = Document { sources: self, root, assigned: Vec::new() };
        let mut keys = Vec::new();
        for set in trees {
            for (path, value) in leaves(set.get_ref(), &[]) {
                document.assign(&path, value)?;
                keys.push(path.join("."));
            }
        }
        Ok((document, keys))
    }

    pub(super) fn file(&self) -> &str {
        self.texts.first().map_or("", |(name, ..)| name)
    }

    fn place(&self, span: Range<usize>) -> Box<Place> {
        let owner = self.texts.iter().rfind(|(_, _, start)| *start <= span.start);
        let Some((name, text, start)) = owner else {
            return Box::new(Place { source: String::new(), line: None, text: String::new(), column: 0, width: 1 });
        };
        let begin = span.start.min(text.len());
        let line_start = text[..begin].rfind('\n').map_or(0, |at| at + 1).max(*start);
        let line_end = text[begin..].find('\n').map_or(text.len(), |at| begin + at);
        let end = span.end.clamp(begin, line_end);
        Box::new(Place {
            source: name.clone(),
            line: (*start == 0).then(|| 1 + text[..begin].matches('\n').count()),
            text: text[line_start..line_end].trim_end().to_owned(),
            column: text[line_start..begin].chars().count(),
            width: text[begin..end].chars().count().max(1),
        })
    }

    fn error(&self, error: &Error, swept: Option<String>) -> ConfigError {
        self.error_at(error, error.span().unwrap_or(0..0), swept)
    }

    fn error_at(&self, error: &Error, span: Range<usize>, swept: Option<String>) -> ConfigError {
        let place = self.place(span);
        // The reader breaks some of its messages into lines.
        let message = error.message().lines().collect::<Vec<_>>().join(", ");
        ConfigError::Toml { place, message, swept }
    }
}

/// A swept key.
pub(super) struct SweptKey<'a> {
    /// The dotted key.
    pub(super) key: String,
    /// The values of `[sweep]`, then those of `[full]`.
    pub(super) values: Vec<Spanned<DeValue<'a>>>,
    /// The number of values of `[sweep]`.
    pub(super) usual: usize,
    /// The names that `[names]` gives to the values; empty where it gives none.
    pub(super) names: Vec<String>,
    pub(super) span: Range<usize>,
}

/// A config as a tree of TOML values with their places in the text.
#[derive(Clone, Debug)]
pub struct Document<'a> {
    sources: &'a Sources,
    root: Spanned<DeTable<'a>>,
    /// Dotted keys that a sweep or `--set` gave, with the places of their values.
    assigned: Vec<(String, Range<usize>)>,
}

impl<'a> Document<'a> {
    /// The table `name`, or its default where it is absent.
    ///
    /// # Errors
    /// Unknown keys, wrong values, missing keys.
    pub fn table<T: DeserializeOwned>(&self, name: &str) -> Result<T, ConfigError> {
        if let Some(table) = self.optional(name)? {
            return Ok(table);
        }
        let empty = ValueDeserializer::from(Spanned::new(0..0, DeValue::Table(DeTable::new())));
        T::deserialize(empty).map_err(|error| ConfigError::Missing {
            source_name: self.sources.file().to_owned(),
            table: name.to_owned(),
            message: error.message().to_owned(),
        })
    }

    /// The value of the top-level key `name`, where it is there.
    ///
    /// # Errors
    /// As [`Document::table`].
    pub fn optional<T: DeserializeOwned>(&self, name: &str) -> Result<Option<T>, ConfigError> {
        let Some(value) = self.root.get_ref().get(name) else { return Ok(None) };
        let value = T::deserialize(ValueDeserializer::from(value.clone()));
        value.map(Some).map_err(|error| {
            let span = error.span().unwrap_or_else(|| self.quoted(name, error.message()));
            self.sources.error_at(&error, span.clone(), self.assigned_at(Some(span)))
        })
    }

    /// Fails unless `name`, which stands at the dotted key `key`, is one of `known`.
    ///
    /// # Errors
    /// [`ConfigError::UnknownName`].
    pub fn check_name(&self, key: &str, what: &'static str, name: &str, known: &[&str]) -> Result<(), ConfigError> {
        if known.contains(&name) {
            return Ok(());
        }
        let place = self.place(self.span(key));
        Err(ConfigError::UnknownName { place, what, name: name.to_owned(), known: known.join(", ") })
    }

    /// Fails if a top-level key is not one of `known`.
    pub(super) fn check_keys(&self, known: &[&str]) -> Result<(), ConfigError> {
        let unknown = self.root.get_ref().keys().filter(|key| !known.contains(&key.get_ref().as_ref()));
        let Some(key) = unknown.min_by_key(|key| key.span().start) else { return Ok(()) };
        Err(self.unknown_key(key.span(), key.get_ref(), key.get_ref(), known))
    }

    /// Fails unless the first part of a swept key is one of `known`. A table that this kind of
    /// experiment does not read would have no effect, and the runs would differ in their names
    /// only.
    pub(super) fn check_axis(&self, axis: &SweptKey, known: &[&str]) -> Result<(), ConfigError> {
        let first = axis.key.split('.').next().unwrap_or(&axis.key);
        if known.contains(&first) {
            return Ok(());
        }
        Err(self.unknown_key(axis.span.clone(), &axis.key, first, known))
    }

    /// The error of a dotted key whose first part is unknown.
    fn unknown_key(&self, span: Range<usize>, key: &str, first: &str, known: &[&str]) -> ConfigError {
        let meant = near(first, known).map(|near| format!("{near}{}", &key[first.len()..]));
        ConfigError::UnknownKey { place: self.place(span), key: key.to_owned(), meant, known: known.join(", ") }
    }

    /// The error of the plot called `name`.
    pub(super) fn wrong_plot(&self, name: &str, reason: &'static str) -> ConfigError {
        let plot = self.root.get_ref().get("plots").and_then(|plots| plots.get_ref().as_table()?.get(name));
        ConfigError::Plot { place: self.sources.place(plot.map_or(0..0, Spanned::span)), plot: name.to_owned(), reason }
    }

    /// The error of a key in `[[without]]`, `[[expect-where]]` or `[names]` that is not swept.
    pub(super) fn not_swept(&self, table: &str, key: &str, swept: &[String]) -> ConfigError {
        let value = self.root.get_ref().get(table);
        let place = self.sources.place(value.map_or(0..0, Spanned::span));
        let is_array = value.is_some_and(|value| value.get_ref().as_array().is_some());
        let table = if is_array { format!("[[{table}]]") } else { format!("[{table}]") };
        ConfigError::NotSwept { place, table, key: key.to_owned(), known: swept.join(", ") }
    }

    /// The value of `time-limit`, in seconds.
    pub(super) fn time_limit(&self) -> Result<Option<f64>, ConfigError> {
        let limit = self.optional::<f64>("time-limit")?;
        match limit.filter(|seconds| !(*seconds > 0.0 && seconds.is_finite())) {
            Some(seconds) => Err(ConfigError::TimeLimit { place: self.place(self.span("time-limit")), seconds }),
            None => Ok(limit),
        }
    }

    /// The swept keys with their values, in the order of the file.
    pub(super) fn sweep(&self) -> Result<Vec<SweptKey<'a>>, ConfigError> {
        let mut axes = self.arrays("sweep")?;
        for more in self.arrays("full")? {
            let Some(axis) = axes.iter_mut().find(|axis| axis.key == more.key) else {
                let known: Vec<&str> = axes.iter().map(|axis| axis.key.as_str()).collect();
                let known = if known.is_empty() { "nothing".to_owned() } else { known.join(", ") };
                let place = self.sources.place(more.span);
                return Err(ConfigError::NotSwept { place, table: "[full]".to_owned(), key: more.key, known });
            };
            axis.values.extend(more.values);
        }
        for given in self.arrays("names")? {
            let Some(axis) = axes.iter_mut().find(|axis| axis.key == given.key) else {
                let known = axes.iter().map(|axis| axis.key.clone()).collect::<Vec<_>>();
                return Err(self.not_swept("names", &given.key, &known));
            };
            let wrong =
                |reason| ConfigError::Names { place: self.place(given.span.clone()), key: given.key.clone(), reason };
            let names: Vec<String> =
                given.values.iter().filter_map(|name| Some(name.get_ref().as_str()?.to_owned())).collect();
            if given.values.len() != axis.values.len() {
                return Err(wrong("has another number of names than [sweep] and [full] have values"));
            }
            if names.len() < given.values.len() || !names.iter().all(|name| is_plot_name(name)) {
                return Err(wrong("has something else than names of ASCII letters, digits, - and _"));
            }
            if (1..names.len()).any(|i| names[..i].contains(&names[i])) {
                return Err(wrong("has the same name twice"));
            }
            axis.names = names;
        }
        Ok(axes)
    }

    /// The dotted keys of a table of arrays, in the order of the file.
    fn arrays(&self, name: &str) -> Result<Vec<SweptKey<'a>>, ConfigError> {
        let Some(value) = self.root.get_ref().get(name) else { return Ok(Vec::new()) };
        let DeValue::Table(table) = value.get_ref() else {
            let place = self.sources.place(value.span());
            return Err(ConfigError::EmptySweep { place, key: name.to_owned() });
        };
        let mut found = leaves(table, &[]);
        found.sort_by_key(|(_, value)| value.span().start);
        let mut arrays = Vec::new();
        for (path, values) in found {
            let (key, span) = (path.join("."), values.span());
            match values.get_ref().as_array() {
                Some(array) if !array.is_empty() => {
                    arrays.push(SweptKey { key, values: array.to_vec(), usual: array.len(), names: Vec::new(), span });
                }
                _ => return Err(ConfigError::EmptySweep { place: self.sources.place(span), key }),
            }
        }
        Ok(arrays)
    }

    /// The folders in which the files of `data:` sources are looked up.
    pub fn data_folders(&self) -> &[PathBuf] {
        &self.sources.data
    }

    /// Assigns `value` to the dotted key with the parts `path`, creating missing tables.
    pub(super) fn assign<S: AsRef<str>>(&mut self, path: &[S], value: Spanned<DeValue<'a>>) -> Result<(), ConfigError> {
        let span = value.span();
        let names: Vec<&str> = path.iter().map(S::as_ref).collect();
        let key = names.join(".");
        let Some((last, path)) = names.split_last() else { return Ok(()) };
        let mut table = self.root.get_mut();
        for name in path {
            let fresh = || Spanned::new(span.clone(), DeValue::Table(DeTable::new()));
            let at = (*name).to_owned();
            table = match table.entry(Spanned::new(span.clone(), at.clone().into())).or_insert_with(fresh).get_mut() {
                DeValue::Table(inner) => inner,
                _ => return Err(ConfigError::NoTable { place: self.sources.place(span), key, at }),
            };
        }
        table.insert(Spanned::new(span.clone(), (*last).to_owned().into()), value);
        self.assigned.push((key, span));
        Ok(())
    }

    pub(super) fn remove(&mut self, name: &str) {
        self.root.get_mut().remove(name);
    }

    /// The whole tree as JSON.
    pub(super) fn to_json(&self) -> Result<serde_json::Value, ConfigError> {
        let root = Spanned::new(self.root.span(), DeValue::Table(self.root.get_ref().clone()));
        serde_json::Value::deserialize(ValueDeserializer::from(root)).map_err(|e| self.sources.error(&e, None))
    }

    pub(super) fn file(&self) -> &str {
        self.sources.file()
    }

    /// The place of the value of a dotted key.
    pub(super) fn span(&self, key: &str) -> Range<usize> {
        self.find(key).map_or(0..0, Spanned::span)
    }

    /// The source, line and text of a span, for error messages.
    pub(super) fn place(&self, span: Range<usize>) -> Box<Place> {
        self.sources.place(span)
    }

    fn find(&self, key: &str) -> Option<&Spanned<DeValue<'a>>> {
        let mut names = key.split('.');
        let mut value = self.root.get_ref().get(names.next()?)?;
        for name in names {
            value = value.get_ref().as_table()?.get(name)?;
        }
        Some(value)
    }

    /// The place of an error about the table `name` that has no span of its own, such as options
    /// that contradict each other: the first key of the table that the message quotes, or the
    /// table.
    fn quoted(&self, name: &str, message: &str) -> Range<usize> {
        let value = self.root.get_ref().get(name);
        let keys = value.and_then(|value| value.get_ref().as_table()).into_iter().flat_map(|table| table.keys());
        let quoted = keys.filter_map(|key| Some((message.find(&format!("`{}`", key.get_ref()))?, key.span())));
        let first = quoted.min_by_key(|(at, _)| *at).map(|(_, span)| span);
        first.or_else(|| value.map(Spanned::span)).unwrap_or(0..0)
    }

    fn assigned_at(&self, span: Option<Range<usize>>) -> Option<String> {
        let span = span?;
        let holds = |given: &Range<usize>| given.start <= span.start && span.end <= given.end;
        self.assigned.iter().rfind(|(_, given)| holds(given)).map(|(key, _)| key.clone())
    }
}

/// The values in `table`, nested ones included, that are not tables or are empty tables, each with
/// its path.
fn leaves<'a>(table: &DeTable<'a>, path: &[String]) -> Vec<(Vec<String>, Spanned<DeValue<'a>>)> {
    let mut found = Vec::new();
    for (name, value) in table.iter() {
        let path = [path, &[name.get_ref().to_string()]].concat();
        match value.get_ref() {
            DeValue::Table(inner) if !inner.is_empty() => found.extend(leaves(inner, &path)),
            _ => found.push((path, value.clone())),
        }
    }
    found
}
