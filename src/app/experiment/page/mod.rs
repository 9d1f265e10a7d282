//! `results/index.html`: every experiment with its claim, its figures, its tables, its config and
//! its command, on one page that needs nothing but the folder it lies in.
//!
//! It is made from configs, records and provenance only, so that the same results make the same
//! page; times are in it as the records have them.

mod entry;
mod highlight;
mod html;
mod speed;

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use entry::{Entry, Verdict};
use html::escape;

use super::files::make_folder;
use super::inside::inside;
use super::provenance::Provenance;
use super::{Config, ResultsError};
use crate::io::atomically;

const STYLE: &str = include_str!("style.css");

/// A part of the page.
struct Part {
    id: &'static str,
    heading: &'static str,
    about: &'static str,
    /// Whether an experiment belongs to the part.
    holds: fn(&Config) -> bool,
}

const PARTS: [Part; 3] = [
    Part {
        id: "part-figures",
        heading: "The paper’s figures",
        about: "In the order of the paper. Flat maps are coloured by the conformal error of their faces; the checkerboard on \
                the surface has squares where the map is conformal.",
        holds: |config| !needs_data(config) && is_figure(config),
    },
    Part {
        id: "part-studies",
        heading: "Studies",
        about: "What is claimed, and the runs that could have refuted it.",
        holds: |config| !needs_data(config) && !is_figure(config),
    },
    Part {
        id: "part-data",
        heading: "Public meshes and objects",
        about: "Made where the files are; experiments/data.md says where to get them.",
        holds: needs_data,
    },
];

/// Whether an experiment is a figure of the paper: its name is `fig01`, `fig02`, ….
fn is_figure(config: &Config) -> bool {
    config.name.strip_prefix("fig").is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
}

fn needs_data(config: &Config) -> bool {
    config.all_runs().iter().any(|run| run.data.is_some())
}

/// Writes `index.html` into `results` for all of `configs`, those without records included.
///
/// # Errors
/// [`ResultsError`] where it cannot be written.
pub fn write_page(configs: &[Config], results: &Path) -> Result<PathBuf, ResultsError> {
    let path = inside(results, "index.html")?;
    let text = page(configs, results);
    make_folder(results)?;
    atomically(&path, |out| out.write_all(text.as_bytes()))?;
    Ok(path)
}

/// The page as text. Experiments keep their order within the parts of the page.
pub fn page(configs: &[Config], results: &Path) -> String {
    let entries: Vec<Entry> = configs.iter().map(|config| Entry::new(config, results)).collect();
    let parts: Vec<(&Part, Vec<&Entry>)> = PARTS
        .iter()
        .map(|part| (part, entries.iter().filter(|entry| (part.holds)(entry.config)).collect::<Vec<_>>()))
        .filter(|(_, members)| !members.is_empty())
        .collect();
    let provenance = Provenance::read(results);
    let mut text = head(&entries, provenance.as_ref());
    let speed = speed::part(results);
    contents(&mut text, &parts, speed.is_some());
    text.push_str("<main>\n");
    for (part, members) in &parts {
        let Part { id, heading, about, .. } = part;
        let _ = writeln!(text, "<h2 id=\"{id}\">{heading}</h2>\n<p class=\"about\">{about}</p>");
        members.iter().for_each(|entry| text.push_str(&entry.section(results)));
    }
    text.push_str(&speed.unwrap_or_default());
    text.push_str("</main>\n");
    text.push_str(&foot(provenance.as_ref()));
    text.push_str("</body>\n</html>\n");
    text
}

fn head(entries: &[Entry], provenance: Option<&Provenance>) -> String {
    let mut text = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n<title>Riemap: results</title>\n\
         <link rel=\"icon\" href=\"data:,\">\n<style>\n{STYLE}</style>\n</head>\n<body id=\"top\">\n<header>\n<h1>Riemap</h1>\n\
         <p class=\"lead\">Discrete conformal maps of quad meshes, triangle meshes and digital surfaces. Every figure and \
         every study, with its claim, what came of it, its numbers, its configuration, and the command that makes it.</p>\n"
    );
    let runs: usize = entries.iter().map(|entry| entry.records.len()).sum();
    let mut facts = vec![format!("{runs} runs of {} experiments", entries.len())];
    for verdict in Verdict::ALL {
        match entries.iter().filter(|entry| entry.verdict() == verdict).count() {
            0 => {}
            count if count > 1 && verdict == Verdict::Holds => facts.push(format!("{count} hold")),
            count => facts.push(format!("{count} {}", verdict.word())),
        }
    }
    if let Some(Provenance { riemap, revision, platform, .. }) = provenance {
        facts.push(format!("version {riemap}"));
        facts.extend(revision.iter().map(|revision| format!("revision {revision}")));
        facts.push(platform.clone());
    }
    let facts: String = facts.iter().map(|fact| format!("<li>{}</li>", escape(fact))).collect();
    let _ = writeln!(text, "<ul class=\"facts\">{facts}</ul>\n</header>");
    text
}

fn contents(text: &mut String, parts: &[(&Part, Vec<&Entry>)], speed: bool) {
    text.push_str("<nav aria-label=\"Contents\">\n");
    for (Part { id, heading, .. }, members) in parts {
        let _ = writeln!(text, "<div class=\"part\">\n<p><a href=\"#{id}\">{heading}</a></p>\n<ol>");
        for entry in members {
            let (name, title) = (escape(&entry.config.name), escape(&entry.config.title));
            let verdict = entry.verdict().html();
            let _ = writeln!(text, "<li><a href=\"#{name}\">{title}</a> <code>{name}</code> {verdict}</li>");
        }
        text.push_str("</ol>\n</div>\n");
    }
    if speed {
        let _ =
            writeln!(text, "<div class=\"part\">\n<p><a href=\"#{}\">{}</a></p>\n</div>", speed::ID, speed::HEADING);
    }
    text.push_str("</nav>\n");
}

fn foot(provenance: Option<&Provenance>) -> String {
    let mut text = String::from(
        "<footer>\n<p>Made by <code>riemap reproduce</code> from the records that lie beside this page, \
         one line of <code>records.jsonl</code> a run, with config and numbers. Everything but times is the same on every run.</p>\n",
    );
    let versions = provenance.into_iter().flat_map(|provenance| &provenance.versions);
    let others: String =
        versions.map(|(name, version)| format!("<li>{} {}</li>", escape(name), escape(version))).collect();
    if !others.is_empty() {
        let _ = writeln!(text, "<p>What else took part:</p>\n<ul class=\"versions\">{others}</ul>");
    }
    text.push_str("</footer>\n");
    text
}
