//! Text and pictures as HTML.

use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

use crate::app::experiment::grid::Grid;

/// Longer tables are folded.
const LONG_TABLE: usize = 16;
/// Longer cells, in characters, are broken into lines: messages of runs that failed.
const LONG_CELL: usize = 40;

/// Escapes `text` for HTML text and attribute values.
pub(super) fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            c => escaped.push(c),
        }
    }
    escaped
}

/// `path` as a relative address: bytes that an address gives another meaning are written as `%XX`.
pub(super) fn address(path: &str) -> String {
    let mut address = String::new();
    for byte in path.bytes() {
        match byte {
            b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' | b'-' | b'_' | b'.' | b'~' | b'/' | b',' | b'=' | b'+' => {
                address.push(char::from(byte));
            }
            byte => {
                let _ = write!(address, "%{byte:02X}");
            }
        }
    }
    address
}

/// Width and height of a PNG file, from its header; `None` for other files.
pub(super) fn png_size(path: &Path) -> Option<[u32; 2]> {
    let mut header = [0u8; 24];
    File::open(path).ok()?.read_exact(&mut header).ok()?;
    let number = |at: usize| u32::from_be_bytes([header[at], header[at + 1], header[at + 2], header[at + 3]]);
    header.starts_with(b"\x89PNG\r\n\x1a\n").then(|| [number(16), number(20)])
}

/// Width and height of an SVG file, from its first tag; `None` where that does not have them in
/// pixels.
pub(super) fn svg_size(path: &Path) -> Option<[u32; 2]> {
    let text = fs::read_to_string(path).ok()?;
    let tag = text[text.find("<svg")?..].split('>').next()?;
    let number = |name: &str| tag.split(&format!(" {name}=\"")).nth(1)?.split('"').next()?.parse().ok();
    Some([number("width")?, number("height")?])
}

/// A picture in `figures/` of `results`, linked to its SVG file if there is one; `None` if it
/// cannot be shown.
pub(super) fn figure(results: &Path, file: &str, alt: &str, caption: Option<&str>) -> Option<String> {
    let folder = results.join("figures");
    let [width, height] = png_size(&folder.join(file))?;
    let vectors = format!("{}.svg", file.strip_suffix(".png").unwrap_or(file));
    let target = if folder.join(&vectors).is_file() { &vectors } else { file };
    let (source, target) = (address(&format!("figures/{file}")), address(&format!("figures/{target}")));
    let caption = caption.map(|text| format!("<figcaption>{}</figcaption>", escape(text))).unwrap_or_default();
    Some(format!(
        "<figure><a href=\"{target}\"><img src=\"{source}\" width=\"{width}\" height=\"{height}\" loading=\"lazy\" \
         alt=\"{}\"></a>{caption}</figure>\n",
        escape(alt)
    ))
}

/// A table that scrolls in its own box, folded where it is long.
pub(super) fn table(label: &str, grid: &Grid) -> String {
    let columns = 0..grid.headings.len();
    let words: Vec<bool> =
        columns.map(|k| !grid.rows.iter().all(|row| row.get(k).is_none_or(|c| is_number(c)))).collect();
    let class = |k: usize, text: &str| match words.get(k) {
        Some(true) if text.chars().count() > LONG_CELL => " class=\"word long\"",
        Some(true) => " class=\"word\"",
        _ => "",
    };
    let mut text =
        format!("<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{}\"><table>\n", escape(label));
    text.push_str("<thead><tr>");
    for (k, heading) in grid.headings.iter().enumerate() {
        let _ = write!(text, "<th scope=\"col\"{}>{}</th>", class(k, ""), escape(heading));
    }
    text.push_str("</tr></thead>\n<tbody>\n");
    for row in &grid.rows {
        text.push_str("<tr>");
        for (k, cell) in row.iter().enumerate() {
            let _ = write!(text, "<td{}>{}</td>", class(k, cell), escape(cell));
        }
        text.push_str("</tr>\n");
    }
    text.push_str("</tbody></table></div>\n");
    match grid.rows.len() {
        rows if rows > LONG_TABLE => folded(&format!("{label}: {rows} rows"), &text),
        _ => format!("<div>\n<p class=\"soft\">{}</p>\n{text}</div>\n", escape(label)),
    }
}

/// Whether a cell is aligned to the right: it is a number or empty.
fn is_number(cell: &str) -> bool {
    cell.is_empty() || cell == "–" || cell.parse::<f64>().is_ok()
}

/// `html` that is unfolded by a click on a line of text.
pub(super) fn folded(summary: &str, html: &str) -> String {
    format!("<details><summary>{}</summary>\n{html}</details>\n", escape(summary))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_of_numbers_go_right_and_columns_of_words_left() {
        let row = |cells: [&str; 3]| cells.map(str::to_owned).to_vec();
        let rows = vec![row(["quad", "1.5e-3", "–"]), row(["3", "12", "-4"])];
        let text = table("T", &Grid { headings: row(["mesh", "H", "<n>"]), rows });
        assert_eq!(text.matches(" class=\"word\"").count(), 3, "{text}");
        assert!(text.contains("<th scope=\"col\">&lt;n&gt;</th>") && text.contains("<td>-4</td>"), "{text}");
    }

    #[test]
    fn long_tables_are_folded() {
        let of = |rows| table("T", &Grid { headings: vec!["n".to_owned()], rows: vec![vec!["1".to_owned()]; rows] });
        assert!(!of(LONG_TABLE).contains("<details>") && of(LONG_TABLE + 1).contains("<summary>T: 17 rows</summary>"));
    }

    #[test]
    fn nothing_of_a_text_is_taken_for_markup() {
        assert_eq!(escape("a < b & \"c\" > 'd'"), "a &lt; b &amp; &quot;c&quot; &gt; &#39;d&#39;");
        assert_eq!(address("figures/fig 7-energy=H+C?#%.png"), "figures/fig%207-energy=H+C%3F%23%25.png");
    }
}
