use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

/// The meaning of the numbers given for boundary edges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LengthUnit {
    /// Lengths in the plane.
    #[default]
    Lengths,
    /// Factors by which the edges' lengths on the surface are multiplied.
    Factors,
}

/// The assignment of numbers to boundary edges.
#[derive(Clone, Debug, PartialEq)]
pub enum PerEdge {
    /// One number per edge, along the boundary from its first vertex.
    InOrder(Vec<f64>),
    /// Pairs of end vertices, as indices of the source, with their numbers.
    ByEnds(Vec<([u32; 2], f64)>),
}

/// Prescribed lengths of the boundary edges of a free map.
///
/// An experiment gives them as the name of a file, a list of lengths, or `{ lengths = […] }`, `{
/// factors = […] }`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(try_from = "Written")]
pub struct BoundaryLengths {
    /// The meaning of the numbers.
    pub unit: LengthUnit,
    /// The numbers, all positive.
    pub values: PerEdge,
}

/// The forms allowed in an experiment.
#[derive(Deserialize)]
#[serde(untagged, expecting = "expected the name of a file, a list of numbers, { lengths = […] } or { factors = […] }")]
enum Written {
    File(PathBuf),
    Plain(Vec<f64>),
    Lengths { lengths: Vec<f64> },
    Factors { factors: Vec<f64> },
}

impl TryFrom<Written> for BoundaryLengths {
    type Error = BoundaryLengthsError;

    fn try_from(written: Written) -> Result<Self, Self::Error> {
        let (unit, values) = match written {
            Written::File(path) => return read_boundary_lengths(&path),
            Written::Plain(values) | Written::Lengths { lengths: values } => (LengthUnit::Lengths, values),
            Written::Factors { factors: values } => (LengthUnit::Factors, values),
        };
        match values.iter().position(|value| !is_length(*value)) {
            Some(edge) => Err(BoundaryLengthsError::Value { edge, value: values[edge] }),
            None => Ok(BoundaryLengths { unit, values: PerEdge::InOrder(values) }),
        }
    }
}

/// Boundary lengths could not be read.
#[derive(Debug, thiserror::Error)]
pub enum BoundaryLengthsError {
    /// The operating system refused to read the file.
    #[error("cannot read {}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The system's message.
        source: std::io::Error,
    },
    /// A line has an unknown form.
    #[error(
        "{}, line {line}: expected one positive number, or `v w number` with the ends of a boundary edge (vertices from 0), \
         the same on all lines (the first may be `lengths` or `factors`); found `{text}`",
        path.display()
    )]
    Line {
        /// The file.
        path: PathBuf,
        /// Number of the line, from 1.
        line: usize,
        /// Beginning of the line.
        text: String,
    },
    /// An edge occurs in two lines.
    #[error("{}, line {line}: edge {} {} is already given in line {earlier}", path.display(), ends[0], ends[1])]
    Twice {
        /// The file.
        path: PathBuf,
        /// Number of the line, from 1.
        line: usize,
        /// End vertices of the edge.
        ends: [u32; 2],
        /// Number of the earlier line.
        earlier: usize,
    },
    /// A number in an experiment is not a positive finite number.
    #[error("boundary length {edge} (from 0) is {value}: lengths and factors are positive")]
    Value {
        /// Its index in the list.
        edge: usize,
        /// The number.
        value: f64,
    },
}

/// Reads the lengths of boundary edges from a text file.
///
/// Either each line has one number, in the order of the boundary, or all lines are `v w number` in
/// any order, where v and w are the ends of an edge as indices of the source, from 0. An optional
/// first line `lengths` (the default) or `factors` gives the meaning of the numbers. Blank lines
/// and comments from `#` to the end of the line are ignored.
///
/// # Errors
/// A file that cannot be read, a malformed line, a number that is not positive, an edge given
/// twice.
pub fn read_boundary_lengths(path: &Path) -> Result<BoundaryLengths, BoundaryLengthsError> {
    let bytes = fs::read(path).map_err(|source| BoundaryLengthsError::Io { path: path.to_owned(), source })?;
    let text = String::from_utf8_lossy(&bytes);
    let lines = text.lines().enumerate().map(|(k, text)| (k + 1, text.split('#').next().unwrap_or("").trim()));
    let mut lines = lines.filter(|(_, content)| !content.is_empty()).peekable();
    let unit = match lines.peek() {
        Some((_, "lengths")) => Some(LengthUnit::Lengths),
        Some((_, "factors")) => Some(LengthUnit::Factors),
        _ => None,
    };
    if unit.is_some() {
        lines.next();
    }
    let (mut in_order, mut by_ends) = (Vec::new(), Vec::new());
    let mut line_of = HashMap::new();
    for (line, content) in lines {
        match parse(content) {
            Some((None, value)) if by_ends.is_empty() => in_order.push(value),
            Some((Some(ends), value)) if in_order.is_empty() => {
                if let Some(earlier) = line_of.insert([ends[0].min(ends[1]), ends[0].max(ends[1])], line) {
                    return Err(BoundaryLengthsError::Twice { path: path.to_owned(), line, ends, earlier });
                }
                by_ends.push((ends, value));
            }
            _ => {
                let text = content.chars().take(60).collect();
                return Err(BoundaryLengthsError::Line { path: path.to_owned(), line, text });
            }
        }
    }
    let values = if by_ends.is_empty() { PerEdge::InOrder(in_order) } else { PerEdge::ByEnds(by_ends) };
    Ok(BoundaryLengths { unit: unit.unwrap_or_default(), values })
}

/// Parses a number, optionally preceded by the ends of an edge.
fn parse(content: &str) -> Option<(Option<[u32; 2]>, f64)> {
    let words: Vec<&str> = content.split_whitespace().collect();
    let (ends, value) = match words.as_slice() {
        [value] => (None, value),
        [v, w, value] => (Some([v.parse().ok()?, w.parse().ok()?]), value),
        _ => return None,
    };
    value.parse().ok().filter(|value| is_length(*value)).map(|value| (ends, value))
}

fn is_length(value: f64) -> bool {
    value > 0.0 && value.is_finite()
}
