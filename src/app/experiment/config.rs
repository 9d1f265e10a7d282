use std::collections::{BTreeMap, HashMap};
use std::path::Path;

use serde::Deserialize;
use serde_json::Value;
use toml::Spanned;
use toml::de::DeValue;

use super::document::{Document, Settings, Sources, SweptKey};
use super::expect;
use super::folder::sweep_over_folder;
use super::name::{Names, SUFFIXES, canonical, is_config_name, is_plot_name, picture_base, run_base};
use super::{
    Bounds, ConfigError, DataFile, Expectation, ExperimentKind, GroupSpec, KINDS, PlotSpec, Shard, SheetSpec, Task,
    Without, convergence,
};

/// The largest number of runs of one config.
const MOST_RUNS: usize = 10_000;
/// The top-level keys that configs of every kind have and that belong to each run.
const HEAD: [&str; 5] = ["title", "claim", "kind", "expect", "expect-where"];
/// The top-level keys that concern all runs of a config together.
const OF_THE_WHOLE: [&str; 12] = [
    "alone",
    "folder",
    "time-limit",
    "may-fail",
    "sweep",
    "full",
    "names",
    "without",
    "table",
    "groups",
    "plots",
    "sheet",
];

/// A column of an experiment's table.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Column {
    /// Dotted key of the record.
    pub key: String,
    /// Heading.
    pub label: String,
}

/// `[table]`.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    columns: Vec<Column>,
}

/// One point of the sweep.
pub struct Run {
    /// Its position among all runs of the config, from 0.
    pub position: usize,
    /// The swept values, such as `n=33,dual=barycentre`; `run` without a sweep.
    pub name: String,
    /// The middle of the names of its pictures, such as `33-barycentre`.
    pub picture: String,
    /// The config as resolved.
    pub config: Value,
    /// The bounds that the claim sets on the result, by dotted key.
    pub expect: Bounds,
    /// The public file that the run needs.
    pub data: Option<DataFile>,
    /// The computation.
    pub task: Box<dyn Task>,
}

/// A checked config with its runs.
pub struct Config {
    /// The name of the file without extension, which is also the name of its results.
    pub name: String,
    /// Its path.
    pub path: String,
    /// Its title.
    pub title: String,
    /// The claim that the experiment tests.
    pub claim: String,
    /// The kind of experiment.
    pub kind: &'static dyn ExperimentKind,
    /// Whether its runs are timed, so that nothing else may run beside them.
    pub alone: bool,
    /// Time limit of a run in seconds. Each run is then made in a process of its own, if
    /// [`Batch::apart`](super::Batch::apart) says how.
    pub time_limit: Option<f64>,
    /// Whether runs without bounds may fail: their failure is then a result.
    pub may_fail: bool,
    /// The runs to be made: the last swept key varies fastest.
    pub runs: Vec<Run>,
    /// The runs of `[full]`, if they are not to be made.
    pub more: Vec<Run>,
    /// The swept dotted keys, in the order of the file.
    pub swept: Vec<String>,
    /// Runs of the sweep that are not made.
    pub without: Vec<Without>,
    /// Columns of the table, after the swept keys.
    pub columns: Vec<Column>,
    /// A table that sums up groups of runs.
    pub groups: Option<GroupSpec>,
    /// Plots over the runs, by name.
    pub plots: BTreeMap<String, PlotSpec>,
    /// The figure composed of the pictures of all runs, if there is one.
    pub sheet: Option<SheetSpec>,
}

impl Config {
    /// Reads a config and applies settings of the form `dotted.key=value`; see
    /// [`Config::load_with`].
    ///
    /// # Errors
    /// As [`Config::load_with`].
    pub fn load(path: &Path, sets: &[String]) -> Result<Self, ConfigError> {
        Config::load_with(path, &Settings { sets: sets.to_vec(), ..Settings::default() })
    }

    /// Reads a config with settings from outside.
    ///
    /// # Errors
    /// [`ConfigError`] for anything in the file or the settings that is not understood, with its
    /// line.
    pub fn load_with(path: &Path, settings: &Settings) -> Result<Self, ConfigError> {
        let text =
            std::fs::read_to_string(path).map_err(|source| ConfigError::Read { path: path.to_owned(), source })?;
        let name = path.file_stem().and_then(|stem| stem.to_str()).filter(|name| is_config_name(name));
        let name = name.ok_or_else(|| ConfigError::Name { path: path.to_owned() })?;
        Config::parse(name, Sources::new(&path.display().to_string(), text, settings)?, settings.full)
    }

    fn parse(name: &str, sources: Sources, full: bool) -> Result<Self, ConfigError> {
        let (mut document, set) = sources.tree()?;
        let kind_name = document.optional::<String>("kind")?.unwrap_or_else(|| KINDS[0].name().to_owned());
        let known: Vec<&str> = KINDS.iter().map(|kind| kind.name()).collect();
        document.check_name("kind", "kind of experiment", &kind_name, &known)?;
        let kind = *KINDS.iter().find(|kind| kind.name() == kind_name).unwrap_or(&KINDS[0]);
        document.check_keys(&[&HEAD[..], &OF_THE_WHOLE, kind.tables()].concat())?;
        let columns = match document.optional::<Table>("table")? {
            Some(table) => table.columns,
            None => kind.columns().iter().map(|(key, label)| Column::new(key, label)).collect(),
        };
        let mut sweep = document.sweep()?;
        let tables = [&HEAD[..], kind.tables()].concat();
        sweep.iter().try_for_each(|axis| document.check_axis(axis, &tables))?;
        sweep.retain(|axis| !set.contains(&axis.key));
        sweep_over_folder(&document, &mut sweep)?;
        let mut config = Config {
            name: name.to_owned(),
            path: document.file().to_owned(),
            title: document.optional("title")?.unwrap_or_else(|| name.to_owned()),
            claim: document.optional("claim")?.unwrap_or_default(),
            kind,
            alone: document.optional("alone")?.unwrap_or_default(),
            time_limit: document.time_limit()?,
            may_fail: document.optional("may-fail")?.unwrap_or_default(),
            runs: Vec::new(),
            more: Vec::new(),
            swept: sweep.iter().map(|axis| axis.key.clone()).collect(),
            without: document.optional("without")?.unwrap_or_default(),
            columns,
            groups: document.optional("groups")?,
            plots: document.optional("plots")?.unwrap_or_default(),
            sheet: document.optional("sheet")?,
        };
        let words =
            sweep.iter().map(|axis| (axis.key.clone(), axis.values.iter().all(|value| value.get_ref().is_str())));
        for (name, plot) in convergence::plots(&document, &words.collect::<Vec<_>>())? {
            config.plots.entry(name).or_insert(plot);
        }
        let expectations: Vec<Expectation> = document.optional("expect-where")?.unwrap_or_default();
        let selections = config.without.iter().map(|without| ("without", &without.runs));
        for (table, runs) in selections.chain(expectations.iter().map(|e| ("expect-where", &e.runs))) {
            let unknown = runs.0.keys().find(|key| !config.swept.contains(key) && !set.contains(*key));
            if let Some(key) = unknown {
                return Err(document.not_swept(table, key, &config.swept));
            }
        }
        for (name, plot) in &config.plots {
            let unsafe_name = "its name becomes that of files: it may have ASCII letters, digits, - and _, at most 100";
            let reason = if is_plot_name(name) { plot.contradiction(name) } else { Some(unsafe_name) };
            if let Some(reason) = reason {
                return Err(document.wrong_plot(name, reason));
            }
        }
        for key in OF_THE_WHOLE {
            document.remove(key);
        }
        let runs = sweep.iter().try_fold(1usize, |n, axis| n.checked_mul(axis.values.len()));
        if runs.is_none_or(|runs| runs > MOST_RUNS) {
            return Err(ConfigError::TooManyRuns { source_name: config.path, limit: MOST_RUNS });
        }
        let (mut names, mut pictures, mut known) = (Names::default(), Names::default(), HashMap::new());
        config.plots.keys().for_each(|plot| pictures.reserve(plot));
        let all_named = sweep.iter().all(|axis| !axis.names.is_empty());
        for (position, point) in product(&sweep).into_iter().enumerate() {
            let mut document = document.clone();
            for (key, value) in &point.values {
                document.assign(&key.split('.').collect::<Vec<_>>(), (*value).clone())?;
            }
            let mut run = run((kind, &expectations), position, document)?;
            if config.without.iter().any(|without| without.runs.holds_config(&run.config)) {
                continue;
            }
            run.name = names.unique(&run_base(&run.config, &config.swept, &point.names), &[""]);
            let picture = picture_base(&run.name);
            run.picture = pictures.unique(&picture, &SUFFIXES);
            if all_named && run.picture != picture && !sweep.is_empty() {
                return Err(ConfigError::SameFigure {
                    name: format!("{}-{picture}", config.name),
                    first: config.path.clone(),
                    second: config.path,
                });
            }
            if let Some(first) = known.insert(run.effective(), run.name.clone()) {
                return Err(ConfigError::EqualRuns { source_name: config.path, first, second: run.name });
            }
            match full || !point.full {
                true => config.runs.push(run),
                false => config.more.push(run),
            }
        }
        Ok(config)
    }

    /// The runs of one shard, with their indices among the runs to be made.
    pub fn shard(&self, shard: Shard) -> impl Iterator<Item = (usize, &Run)> {
        self.runs.iter().enumerate().filter(move |(i, _)| i % shard.count == shard.index - 1)
    }

    /// The names, without extension, of the files that its results may have in `figures/`.
    fn figures(&self) -> Vec<String> {
        let drawn = |run: &Run, key: &str| run.config.pointer(key).is_some_and(|value| *value != Value::Bool(false));
        let has_two = |run: &&Run| drawn(run, "/figures/flat") && drawn(run, "/figures/checkerboard");
        let runs = self.all_runs();
        // Only two pictures of one run have suffixes.
        let suffixes = if runs.iter().any(has_two) { &SUFFIXES[1..] } else { &SUFFIXES[..1] };
        let middles: Vec<String> = match self.swept.is_empty() {
            true => vec![String::new()],
            false => runs.iter().map(|run| format!("-{}", run.picture)).collect(),
        };
        let plots = self.plots.keys().map(|plot| format!("{}-{plot}", self.name));
        let pictures = middles.iter().flat_map(|run| suffixes.iter().map(move |suffix| format!("{run}{suffix}")));
        let pictures = pictures.map(|picture| format!("{}{picture}", self.name));
        let mut names: Vec<String> = plots.chain(pictures).collect();
        // The figure of a sheet; with a single picture it is that picture.
        if self.sheet.is_some() && !names.contains(&self.name) {
            names.push(self.name.clone());
        }
        names
    }

    /// All runs in the order of the sweep, including those of `[full]` that are not to be made.
    pub fn all_runs(&self) -> Vec<&Run> {
        let mut runs: Vec<&Run> = self.runs.iter().chain(&self.more).collect();
        runs.sort_by_key(|run| run.position);
        runs
    }
}

/// Fails where two of `configs` would write the same file in `figures/`.
///
/// # Errors
/// [`ConfigError::SameFigure`].
pub fn check_figures(configs: &[Config]) -> Result<(), ConfigError> {
    let mut known: HashMap<String, &str> = HashMap::new();
    for config in configs {
        for name in config.figures() {
            if let Some(first) = known.insert(name.clone(), &config.path) {
                return Err(ConfigError::SameFigure { name, first: first.to_owned(), second: config.path.clone() });
            }
        }
    }
    Ok(())
}

impl Run {
    /// The config without its bounds, as a text that is equal for two runs if and only if their
    /// configs are.
    fn effective(&self) -> String {
        let mut config = self.config.clone();
        if let Some(fields) = config.as_object_mut() {
            fields.remove("expect");
        }
        canonical(&config)
    }

    /// Whether the run may fail: the config allows it and sets no bounds on this run.
    pub fn may_fail(&self, config: &Config) -> bool {
        config.may_fail && self.expect.is_empty()
    }
}

impl Column {
    fn new(key: &str, label: &str) -> Self {
        Column { key: key.to_owned(), label: label.to_owned() }
    }
}

fn run(
    (kind, expectations): (&dyn ExperimentKind, &[Expectation]),
    position: usize,
    mut document: Document,
) -> Result<Run, ConfigError> {
    let of_all: Bounds = document.optional("expect")?.unwrap_or_default();
    let task = kind.task(&document)?;
    document.remove("title");
    document.remove("claim");
    let mut config = document.to_json()?;
    let of_some = expect::resolve(&mut config, expectations);
    let expect = of_all.into_iter().chain(of_some).collect();
    let source = config.pointer("/surface/source").and_then(Value::as_str);
    let data = source.and_then(|source| DataFile::find(source, document.data_folders()));
    Ok(Run { position, name: String::new(), picture: String::new(), config, expect, data, task })
}

/// A choice of one value per swept key.
#[derive(Clone, Default)]
struct Point<'s, 'a> {
    values: Vec<(&'s str, &'s Spanned<DeValue<'a>>)>,
    /// The names that `[names]` gives to the values.
    names: Vec<Option<&'s str>>,
    /// Whether one of the values is of `[full]`.
    full: bool,
}

/// All choices of one value per swept key; the last key varies fastest.
fn product<'s, 'a>(axes: &'s [SweptKey<'a>]) -> Vec<Point<'s, 'a>> {
    let mut points = vec![Point::default()];
    for axis in axes {
        let longer = |point: &Point<'s, 'a>, (i, value)| {
            let values = point.values.iter().copied().chain([(axis.key.as_str(), value)]).collect();
            let names = point.names.iter().copied().chain([axis.names.get(i).map(String::as_str)]).collect();
            Point { values, names, full: point.full || i >= axis.usual }
        };
        points = points
            .iter()
            .flat_map(|point| axis.values.iter().enumerate().map(move |value| longer(point, value)))
            .collect();
    }
    points
}
