//! The results of `riemap bench`: the requirements with their verdicts, and the plots.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use serde_json::Value;

use super::html::{escape, folded, svg_size, table};
use crate::app::experiment::grid::{Grid, number};

/// The heading's anchor.
pub(super) const ID: &str = "part-speed";
pub(super) const HEADING: &str = "Speed against other programs";

/// The plots with their captions.
const PLOTS: [(&str, &str); 2] =
    [("solve.svg", "Processor seconds of the solve over vertices"), ("memory.svg", "Most memory held over vertices")];

/// The part of the page; `None` if there are no results of `riemap bench`.
pub(super) fn part(results: &Path) -> Option<String> {
    let folder = results.join("bench");
    let text = fs::read_to_string(folder.join("bench.json")).ok()?;
    let record: Value = serde_json::from_str(&text).ok()?;
    let bars = record.get("bars")?.as_array()?;
    let holds = bars.iter().filter(|bar| bar["holds"] == Value::Bool(true)).count();
    let mut text = format!(
        "<h2 id=\"{ID}\">{HEADING}</h2>\n<p class=\"about\">Each run a process of its own with one thread, in turns with its peers. \
         {holds} of {} bars hold.</p>\n<section aria-label=\"{HEADING}\">\n",
        bars.len()
    );
    // Without its size a picture that has not been read yet takes no place.
    let sized = PLOTS.iter().filter_map(|(file, alt)| Some((file, alt, svg_size(&folder.join(file))?)));
    for (file, alt, [width, height]) in sized {
        let _ = writeln!(
            text,
            "<figure><a href=\"bench/{file}\"><img src=\"bench/{file}\" width=\"{width}\" height=\"{height}\" loading=\"lazy\" \
             alt=\"{alt}\"></a></figure>"
        );
    }
    let word = |bar: &Value| match bar["holds"].as_bool() {
        Some(true) => "yes",
        Some(false) => "no",
        None => "not measured",
    };
    let cell = |value: &Value| if value.is_null() { "–".to_owned() } else { number(value) };
    let row = |bar: &Value| vec![cell(&bar["what"]), cell(&bar["measured"]), cell(&bar["bound"]), word(bar).to_owned()];
    let grid = Grid {
        headings: ["what", "measured", "bar", "holds"].map(str::to_owned).to_vec(),
        rows: bars.iter().map(row).collect(),
    };
    let _ = writeln!(text, "<div class=\"tables\">\n{}</div>", table("Bars", &grid));
    if let Ok(markdown) = fs::read_to_string(folder.join("table.md")) {
        text.push_str(&folded(
            "All runs, as text",
            &format!("<pre tabindex=\"0\">{}</pre>", escape(markdown.trim_end())),
        ));
    }
    text.push_str(
        "<p class=\"end\"><code>riemap bench</code> <a href=\"bench/\">records</a> <a href=\"#top\">top</a></p>\n</section>\n",
    );
    Some(text)
}
