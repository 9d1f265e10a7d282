use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

/// What numbers given for boundary edges are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LengthUnit {
    /// Lengths in the plane.
    #[default]
    Lengths,
    /// What the edges' lengths on the surface are multiplied by.
    Factors,
}

/// Which edge each number is for.
#[derive(Clone, Debug, PartialEq)]
pub enum PerEdge {
    /// One an edge, along the boundary from its first vertex.
    InOrder(Vec<f64>),
    /// Edges by their ends, vertices of the source, and their numbers.
    ByEnds(Vec<([u32; 2], f64)>),
}

/// Lengths that the boundary edges of a free map are to have. In an experiment the name of a file, a list of lengths, or
/// `{ lengths = […] }`, `{ factors = […] }`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(try_from = "Written")]
pub struct BoundaryLengths {
    /// What the numbers are.
    pub unit: LengthUnit,
    /// The numbers, positive.
    pub values: PerEdge,
}

/// How an experiment gives them.
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

/// Why boundary lengths could not be read.
#[derive(Debug, thiserror::Error)]
pub enum BoundaryLengthsError {
    /// The system refused.
    #[error("cannot read {}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A line of no form that is known.
    #[error(
        "{}, line {line}: expected one positive number, or `v w number` with the ends of a boundary edge (vertices from 0), \
         the same on all lines (the first may be `lengths` or `factors`); found `{text}`",
        path.display()
    )]
    Line {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
        /// Its beginning.
        text: String,
    },
    /// An edge that an earlier line has.
    #[error("{}, line {line}: edge {} {} was in line {earlier} already", path.display(), ends[0], ends[1])]
    Twice {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
        /// The edge's ends.
        ends: [u32; 2],
        /// The earlier line.
        earlier: usize,
    },
    /// A number in an experiment that is no length.
    #[error("boundary length {edge} (from 0) is {value}: lengths and factors are positive")]
    Value {
        /// Its place in the list.
        edge: usize,
        /// The number.
        value: f64,
    },
}

/// Reads lengths of boundary edges. Each line has one number, in the order of the boundary; or all lines are `v w number`, in
/// any order, v and w the ends of an edge as the file of the surface numbers them, from 0. A first line `lengths`, or
/// `factors` of the lengths on the surface, says what the numbers are (lengths, without it). Blank lines and what
/// follows a `#` are passed over.
///
/// # Errors
/// A file that cannot be read, a line of another form, a number that is not positive, an edge given twice.
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

/// A number, and before it the ends of an edge or nothing.
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
