//! One experiment on the page.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use super::highlight::highlight;
use super::html::{address, escape, figure, folded, table};
use super::is_figure;
use crate::app::experiment::data::DataFile;
use crate::app::experiment::sheet::panel;
use crate::app::experiment::store::records;
use crate::app::experiment::tables::grids;
use crate::app::experiment::{Config, Outcome, Record, without};

/// The largest number of pictures of single runs that are shown unfolded.
const MANY_PICTURES: usize = 8;

/// The verdict on a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verdict {
    /// All results are within their bounds.
    Holds,
    /// The runs are made, and the config sets no bounds.
    Unbounded,
    /// A run is out of bounds.
    Refuted,
    /// A run has no result.
    Failed,
    /// Runs are missing.
    Incomplete,
    /// There is no run.
    NotMade,
}

impl Verdict {
    pub(super) const ALL: [Verdict; 6] =
        [Verdict::Holds, Verdict::Unbounded, Verdict::Refuted, Verdict::Failed, Verdict::Incomplete, Verdict::NotMade];

    pub(super) fn word(self) -> &'static str {
        match self {
            Verdict::Holds => "holds",
            Verdict::Unbounded => "made",
            Verdict::Refuted => "refuted",
            Verdict::Failed => "failed",
            Verdict::Incomplete => "incomplete",
            Verdict::NotMade => "not made",
        }
    }

    pub(super) fn html(self) -> String {
        let class = match self {
            Verdict::Holds => "good",
            Verdict::Refuted | Verdict::Failed => "bad",
            Verdict::Incomplete | Verdict::NotMade => "open",
            Verdict::Unbounded => "plain",
        };
        format!("<span class=\"verdict {class}\">{}</span>", self.word())
    }
}

/// An experiment with its records.
pub(super) struct Entry<'a> {
    pub(super) config: &'a Config,
    pub(super) records: Vec<Record>,
    /// The number of runs to be made that have no record.
    missing: usize,
}

impl<'a> Entry<'a> {
    pub(super) fn new(config: &'a Config, results: &Path) -> Entry<'a> {
        let records = records(config, results);
        let made: BTreeSet<&str> = records.iter().map(|record| record.run.as_str()).collect();
        let missing = config.runs.iter().filter(|run| !made.contains(run.name.as_str())).count();
        Entry { config, records, missing }
    }

    fn count(&self, outcome: Outcome) -> usize {
        self.records.iter().filter(|record| record.outcome == outcome).count()
    }

    /// Whether a run has failed that may not fail.
    fn has_failed(&self) -> bool {
        let mut failed = self.records.iter().filter(|record| record.outcome == Outcome::Failed);
        let runs = self.config.all_runs();
        let run = |record: &Record| runs.iter().find(|run| run.name == record.run);
        failed.any(|record| !run(record).is_some_and(|run| run.may_fail(self.config)))
    }

    pub(super) fn verdict(&self) -> Verdict {
        match () {
            () if self.records.is_empty() => Verdict::NotMade,
            () if self.count(Outcome::Refuted) > 0 => Verdict::Refuted,
            () if self.has_failed() => Verdict::Failed,
            () if self.missing > 0 => Verdict::Incomplete,
            () if self.config.all_runs().iter().all(|run| run.expect.is_empty()) => Verdict::Unbounded,
            () => Verdict::Holds,
        }
    }

    pub(super) fn section(&self, results: &Path) -> String {
        let Entry { config, records, .. } = self;
        let name = escape(&config.name);
        let mut text = format!(
            "<section aria-labelledby=\"{name}\">\n<h3 id=\"{name}\">{}</h3>\n<p class=\"fate\">{} {}</p>\n",
            escape(&config.title),
            self.verdict().html(),
            escape(&self.outcome())
        );
        if !config.claim.is_empty() {
            let _ = writeln!(text, "<p class=\"claim\">{}</p>", escape(&config.claim));
        }
        text.push_str(&self.figures(results));
        let tables: String = grids(config, records).iter().map(|(label, grid)| table(label, grid)).collect();
        if !tables.is_empty() {
            let _ = writeln!(text, "<div class=\"tables\">\n{tables}</div>");
        }
        for sentence in without::sentences(&config.without) {
            let _ = writeln!(text, "<p class=\"soft\">{}</p>", escape(&sentence));
        }
        let path = Path::new(&config.path);
        let file = path.file_name().map(|file| file.to_string_lossy()).unwrap_or_default();
        let among_experiments = path.parent().is_some_and(|folder| folder.ends_with("experiments"));
        if let Ok(toml) = fs::read_to_string(path) {
            let label = if among_experiments { format!("experiments/{file}") } else { file.to_string() };
            text.push_str(&folded(&label, &format!("<pre tabindex=\"0\">{}</pre>", highlight(toml.trim_end()))));
        }
        let command = if among_experiments {
            format!("riemap reproduce {name}")
        } else {
            format!("riemap run {}", escape(&file))
        };
        let _ = write!(text, "<p class=\"end\"><code>{command}</code>");
        if !records.is_empty() {
            let _ = write!(text, " <a href=\"{}/\">records</a>", address(&config.name));
        }
        text.push_str(" <a href=\"#top\">top</a></p>\n</section>\n");
        text
    }

    /// The outcome of the runs in a sentence.
    fn outcome(&self) -> String {
        let absent = self.config.runs.iter().filter_map(|run| run.data.as_ref()).find(|data| data.path.is_none());
        let (refuted, failed) = (self.count(Outcome::Refuted), self.count(Outcome::Failed));
        let mut parts = vec![match self.records.len() {
            0 => return absent.map_or("Run the command below.".to_owned(), needs),
            1 => "1 run".to_owned(),
            n => format!("{n} runs"),
        }];
        match self.verdict() {
            Verdict::Holds => {
                parts.push(if self.records.len() == 1 { "as claimed" } else { "all as claimed" }.to_owned())
            }
            Verdict::Unbounded => parts.push("with no bounds to keep".to_owned()),
            _ => {}
        }
        let counts = [(refuted, "against the claim"), (failed, "failed"), (self.missing, "missing")];
        parts.extend(counts.iter().filter(|(n, _)| *n > 0).map(|(n, word)| format!("{n} {word}")));
        let rest = absent.map(|data| format!(" {}", needs(data))).unwrap_or_default();
        format!("{}.{rest}", parts.join(", "))
    }

    /// The figure of the whole experiment, its plots, and the pictures of its runs.
    fn figures(&self, results: &Path) -> String {
        let Entry { config, records, .. } = self;
        let whole = format!("{}.png", config.name);
        let plots: Vec<(String, &str)> = config
            .plots
            .iter()
            .map(|(name, plot)| (format!("{}-{name}.png", config.name), plot.title.as_str()))
            .collect();
        let titled = |title: &str| if title.is_empty() { config.title.clone() } else { title.to_owned() };
        let mut text: String = figure(results, &whole, &config.title, None).unwrap_or_default();
        // Plots of several panels are too small beside another.
        let (mut alone, mut beside) = (Vec::new(), Vec::new());
        for ((file, title), plot) in plots.iter().zip(config.plots.values()) {
            let row = if plot.panels.keys().next().is_some() { &mut alone } else { &mut beside };
            row.extend(figure(results, file, &titled(title), None));
        }
        let on_sheet = config.sheet.is_some() && !text.is_empty();
        text.push_str(&alone.concat());
        text.push_str(&side_by_side(&beside));
        let shown = |file: &String| *file == whole || plots.iter().any(|(plot, _)| plot == file);
        let mut singles = Vec::new();
        for record in records {
            let panel = panel(record).filter(|_| on_sheet);
            let pictures = record.pictures.iter().filter(|file| file.ends_with(".png") && panel != Some(file));
            for file in pictures.filter(|file| !shown(file)) {
                let alt = format!("{}: {}", config.title, record.run);
                let caption = (!config.swept.is_empty()).then(|| record.run.replace(',', ", "));
                singles.extend(figure(results, file, &alt, caption.as_deref()));
            }
        }
        let fold = singles.len() > MANY_PICTURES || (!text.is_empty() && !is_figure(config) && singles.len() > 1);
        let gallery = side_by_side(&singles);
        text.push_str(&if fold {
            folded(&format!("{} pictures of single runs", singles.len()), &gallery)
        } else {
            gallery
        });
        text
    }
}

fn side_by_side(figures: &[String]) -> String {
    match figures {
        [] => String::new(),
        [one] => one.clone(),
        more => format!("<div class=\"gallery\">\n{}</div>\n", more.concat()),
    }
}

/// Says which public file is missing, without naming folders of this machine.
fn needs(data: &DataFile) -> String {
    match data.origin() {
        Some(origin) => format!("It needs data:{}, {} of github.com/{}.", data.name, origin.path, origin.repository),
        None => format!("It needs data:{}.", data.name),
    }
}
