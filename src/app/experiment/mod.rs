//! Experiments: one TOML file per claim, study or figure; one record per run; tables and plots made
//! of records alone.
//!
//! A config names what is run once (`[surface]`, `[map]`, …), what is varied (`[sweep]`: the
//! cartesian product over dotted keys; `[names]`: short names of swept values, for files), what
//! must come out (`[expect]`) and what is shown (`[table]`, `[plots.NAME]`). Any key can be set
//! from outside ([`Config::load`]). Keys of records are dotted too: `config.map.dual`,
//! `result.distortion.flipped`, `timings.total`.
//!
//! | file | what it holds |
//! |---|---|
//! | `document.rs`, `place.rs`, `error.rs` | TOML with places in the text; setting dotted keys; errors with line and caret |
//! | `config.rs`, `shard.rs` | [`Config`]: a file made into [`Run`]s; [`Shard`]s of them |
//! | `surface.rs`, `data.rs` | `[surface]`; public files, and where they come from |
//! | `expect.rs`, `without.rs`, `folder.rs` | bounds on results; runs that are not made; meshes of a folder |
//! | `name.rs` | names of runs and pictures, safe and unique |
//! | `record.rs` | [`Record`]: what a run leaves behind; dotted keys |
//! | `inside.rs`, `files.rs` | paths that stay in the folder of results; writing, removing, locking there |
//! | `run.rs`, `scratch.rs` | one run → its scratch record and pictures |
//! | `batch.rs`, `pool.rs` | [`Batch`]: runs in parallel, or in processes of their own; resuming after an interruption |
//! | `store.rs`, `provenance.rs` | scratch records → `records.jsonl`, `timings.jsonl`, `provenance.json`; removing stale records |
//! | `page/` | everything → `index.html` |
//! | `summary.rs`, `tables.rs`, `grid.rs`, `groups.rs`, `chart.rs` | records → `table.md`, `timings.md`, plots |
//! | `fit.rs`, `panels.rs` | exponents fitted to the series of plots; plots beside each other |
//! | `convergence.rs` | iterations as records keep them; the plots that `[figures] convergence` asks for |
//! | `map.rs`, `cotan.rs`, `normals.rs`, `peer.rs`, `theorem.rs` | the kinds of experiment, rows of [`KINDS`] |
//! | `picture.rs`, `marks.rs`, `caption.rs` | maps → their pictures: flat, or as a checkerboard on the surface; red faces; captions |
//! | `sheet.rs` | pictures of all runs → one figure, and its small copy |
//! | `model.rs` | maps → the surface under its checkerboard, to be turned around in a viewer |
//! | `repository.rs` | where experiments and results lie; the revision of the program |
//!
//! Results of one experiment are `<results>/<name>/records.jsonl`, one record a line, which the
//! same program writes again bit for bit on the same platform; `timings.jsonl`, which differs from
//! run to run and is not committed; `table.md`; and pictures and plots in `<results>/figures/`.
//! `<results>/provenance.json` says which program and platform made them.

mod batch;
mod caption;
mod chart;
mod config;
mod convergence;
mod cotan;
mod data;
mod document;
mod error;
mod expect;
mod explanation;
mod files;
mod fit;
mod folder;
mod grid;
mod groups;
mod inside;
mod map;
mod marks;
mod model;
mod name;
mod normals;
mod page;
mod panels;
mod peer;
mod picture;
mod place;
mod pool;
mod provenance;
mod record;
mod repository;
mod run;
mod scratch;
mod selection;
mod shard;
mod sheet;
mod store;
mod summary;
mod surface;
mod tables;
mod theorem;
mod without;

use std::collections::BTreeMap;

use serde_json::Value;

pub use batch::{Batch, Event, Maker};
pub use caption::{Caption, CaptionError};
pub use chart::{AxisSpec, PlotSpec, ReferenceSpec, SeriesSpec};
pub use config::{Column, Config, Run, check_figures};
pub use convergence::{Convergence, ConvergenceX, ConvergenceY, trace};
pub use data::{DataFile, Origin, data_folders};
pub use document::{Document, Settings};
pub use error::{ConfigError, ResultsError, RunError};
pub use expect::{Bound, Bounds, Expectation};
pub use explanation::DiagramError;
pub use fit::{Abscissa, FitSpec, Fitted};
pub use groups::{GroupColumn, GroupSpec, Take};
pub use marks::{Mark, Marks, Measure};
pub use model::{ModelError, stage_model};
pub use page::{page, write_page};
pub use panels::PanelSpec;
pub use picture::{Checkerboard, Up, checkerboard, checkerboard_pair, flat_map};
pub use place::Place;
pub use provenance::Provenance;
pub use record::{Outcome, Record};
pub use repository::{EXPERIMENTS, has_experiments, revision};
pub use run::make_one;
pub use scratch::Scratch;
pub use selection::Selection;
pub use shard::{NoShard, Shard};
pub use sheet::SheetSpec;
pub use store::{records, remove_stale};
pub use summary::{Summary, summarise};
pub use tables::table;
pub use without::Without;

use crate::figure::Format;

/// A kind of experiment, which defines the computation of a run.
pub trait ExperimentKind: Sync {
    /// The value of `kind` in configs.
    fn name(&self) -> &'static str;
    /// A description of one line.
    fn description(&self) -> &'static str;
    /// The top-level tables of its configs beyond those of all kinds.
    fn tables(&self) -> &'static [&'static str];
    /// The default columns of its table: dotted key of the record and heading.
    fn columns(&self) -> &'static [(&'static str, &'static str)];
    /// Makes the task of one run from a config without sweep.
    ///
    /// # Errors
    /// [`ConfigError`]: an error in the config. Nothing is computed yet.
    fn task(&self, config: &Document) -> Result<Box<dyn Task>, ConfigError>;
}

/// The computation of one run.
pub trait Task: Sync {
    /// Computes the run.
    ///
    /// # Errors
    /// [`RunError`]: there is no result. The text goes into the record.
    fn run(&self) -> Result<Yield, RunError>;
}

/// The yield of a run.
#[derive(Clone, Debug, Default)]
pub struct Yield {
    /// The result, which is the same every time the run is made.
    pub result: Value,
    /// Times in seconds.
    pub timings: Value,
    /// Versions of other programs that took part.
    pub versions: BTreeMap<String, String>,
    /// Pictures of the run.
    pub pictures: Vec<Picture>,
}

/// A picture of a run: `results/figures/<config>-<run><suffix>.<format>`.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Distinguishes several pictures of one run, such as `-checkerboard`; may be empty.
    pub suffix: &'static str,
    /// The format of the file.
    pub format: Format,
    /// The contents of the file.
    pub bytes: Vec<u8>,
}

/// Every kind of experiment; the first is the default.
pub static KINDS: &[&dyn ExperimentKind] = &[
    &map::MapKind,
    &cotan::CotanKind,
    &normals::NormalsKind,
    &peer::PeerKind,
    &explanation::DiagramKind,
    &theorem::TheoremKind,
];
