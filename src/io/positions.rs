use std::fs;
use std::path::{Path, PathBuf};

/// Vertices with their positions in the plane, as listed in a text file.
pub type Places = Vec<(u32, [f64; 2])>;

/// A file of positions could not be read.
#[derive(Debug, thiserror::Error)]
pub enum PositionsError {
    /// The operating system refused to read the file.
    #[error("cannot read {}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The system's message.
        source: std::io::Error,
    },
    /// A line is not of the form `vertex x y`.
    #[error("{}, line {line}: expected `vertex x y` (a vertex index from 0 and two finite numbers), found `{text}`", path.display())]
    Line {
        /// The file.
        path: PathBuf,
        /// Number of the line, from 1.
        line: usize,
        /// Beginning of the line.
        text: String,
    },
    /// A vertex occurs in two lines.
    #[error("{}, line {line}: vertex {vertex} was placed in line {earlier} already", path.display())]
    Twice {
        /// The file.
        path: PathBuf,
        /// Number of the line, from 1.
        line: usize,
        /// The vertex.
        vertex: u32,
        /// Number of the earlier line.
        earlier: usize,
    },
}

/// Reads lines `vertex x y`, with vertices counted from 0; blank lines and comments from `#` to the
/// end of the line are ignored.
///
/// # Errors
/// A file that cannot be read, a malformed line, a vertex given twice.
pub fn read_positions(path: &Path) -> Result<Places, PositionsError> {
    let bytes = fs::read(path).map_err(|source| PositionsError::Io { path: path.to_owned(), source })?;
    let mut places = Places::new();
    let mut line_of = std::collections::BTreeMap::new();
    for (k, text) in String::from_utf8_lossy(&bytes).lines().enumerate() {
        let content = text.split('#').next().unwrap_or("").trim();
        if content.is_empty() {
            continue;
        }
        let Some((vertex, place)) = parse(content) else {
            let text = content.chars().take(60).collect();
            return Err(PositionsError::Line { path: path.to_owned(), line: k + 1, text });
        };
        if let Some(earlier) = line_of.insert(vertex, k + 1) {
            return Err(PositionsError::Twice { path: path.to_owned(), line: k + 1, vertex, earlier });
        }
        places.push((vertex, place));
    }
    Ok(places)
}

fn parse(content: &str) -> Option<(u32, [f64; 2])> {
    let mut words = content.split_whitespace();
    let vertex = words.next()?.parse().ok()?;
    let mut number = || words.next()?.parse::<f64>().ok().filter(|x| x.is_finite());
    let place = [number()?, number()?];
    words.next().is_none().then_some((vertex, place))
}
