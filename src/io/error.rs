use std::fmt;
use std::io;
use std::path::PathBuf;

use thiserror::Error;

use super::Format;

/// A mesh file could not be read.
#[derive(Debug, Error)]
pub enum ReadError {
    /// The operating system refused: no such file, no permission, ….
    #[error("cannot read {}: {source}", path.display())]
    Io {
        /// The requested file.
        path: PathBuf,
        /// The system's message.
        source: io::Error,
    },
    /// The path is a folder.
    #[error("{} is a directory; name a mesh file in it ({})", path.display(), Format::known())]
    Directory {
        /// The requested path.
        path: PathBuf,
    },
    /// The extension does not belong to a known format.
    #[error("{}: unknown mesh format; known extensions: {}", path.display(), Format::known())]
    UnknownFormat {
        /// The requested path.
        path: PathBuf,
    },
    /// The content is not a mesh in the format of its extension.
    #[error("{}, {source}", path.display())]
    Parse {
        /// The requested file.
        path: PathBuf,
        /// The defect and its place.
        source: ParseError,
    },
}

/// A defect in the content of a mesh or volume file, with its place.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{place}: {defect}")]
pub struct ParseError {
    /// Line or byte.
    pub place: Place,
    /// The defect.
    pub defect: Defect,
}

/// A place in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// Line of a text file, from 1.
    Line(usize),
    /// Byte of a binary file, from 0.
    Byte(usize),
    /// The file as a whole.
    Whole,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Place::Line(line) => write!(f, "line {line}"),
            Place::Byte(byte) => write!(f, "byte {byte}"),
            Place::Whole => f.write_str("the whole file"),
        }
    }
}

/// The defects of a mesh or volume file.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Defect {
    /// The file contains nothing but blanks and comments.
    #[error("the file is empty")]
    Empty,
    /// The first words are not those of the format.
    #[error("`{found}` where {wanted} was expected")]
    Unexpected {
        /// The text that was found.
        found: String,
        /// The expected text.
        wanted: &'static str,
    },
    /// The feature belongs to the format but is not supported.
    #[error("{what} cannot be read; {advice}")]
    Unsupported {
        /// The unsupported feature.
        what: &'static str,
        /// Advice to the user.
        advice: &'static str,
    },
    /// A number was expected.
    #[error("`{token}` is not a number ({wanted} was expected)")]
    NotANumber {
        /// The text that was found.
        token: String,
        /// The meaning of the expected number.
        wanted: &'static str,
    },
    /// A coordinate is NaN, infinite, or beyond the range of double precision.
    #[error("the coordinate `{token}` is not a finite number")]
    NotFinite {
        /// The text that was found.
        token: String,
    },
    /// A vertex or normal has fewer than three coordinates.
    #[error("only {found} of 3 coordinates")]
    MissingCoordinates {
        /// Number of coordinates found.
        found: usize,
    },
    /// An index is 0 in OBJ, where indices count from 1.
    #[error("the index 0 in `{token}`: this format counts from 1")]
    IndexZero {
        /// The corner with this index.
        token: String,
    },
    /// An index refers to a vertex or normal that the file does not have.
    #[error("{what} {index} does not exist: the file has {count} (counted from {base})")]
    IndexOutOfRange {
        /// `vertex` or `normal`.
        what: &'static str,
        /// The index as it is written in the file.
        index: i64,
        /// Number of vertices or normals in the file (for negative OBJ indices: up to this line).
        count: usize,
        /// The base of indices in this format: 0 or 1.
        base: usize,
    },
    /// A face has fewer than three corners.
    #[error("a face with {corners} corners; faces have 3 or more")]
    TooFewCorners {
        /// Number of corners.
        corners: usize,
    },
    /// The file ends early.
    #[error("the file ends too early: {wanted} was expected ({done} of {expected} {what} read)")]
    UnexpectedEnd {
        /// The expected next item.
        wanted: &'static str,
        /// `vertices`, `faces`, `header lines`, …
        what: &'static str,
        /// Number of complete items.
        done: u64,
        /// Number of items that the header declares.
        expected: u64,
    },
    /// The file ends early, in a format that does not declare counts.
    #[error("the file ends too early: {wanted} was expected ({done} {what} read)")]
    OpenEnd {
        /// The expected next item.
        wanted: &'static str,
        /// `facets`, …
        what: &'static str,
        /// Number of complete items.
        done: u64,
    },
    /// The header declares more elements than the file has bytes for.
    #[error("the header promises {count} {what} of at least {bytes_each} bytes, but only {left} bytes follow")]
    Truncated {
        /// `vertices`, `faces`, …
        what: String,
        /// The declared number.
        count: u64,
        /// Smallest size of an element.
        bytes_each: u64,
        /// Number of bytes left in the file.
        left: u64,
    },
    /// A text file continues after its last element.
    #[error("`{token}` after the end of the data: the counts in the header are too small, or a line above is too long")]
    Trailing {
        /// The first superfluous word.
        token: String,
    },
    /// A binary file continues after its last element.
    #[error("{bytes} bytes too many after the last element: the counts in the header do not fit the data")]
    TrailingBytes {
        /// Number of superfluous bytes.
        bytes: u64,
    },
    /// A record of an ascii PLY file has more values than its element has properties.
    #[error("`{token}` is one value too many for an element `{element}`")]
    ExtraValue {
        /// The first superfluous value.
        token: String,
        /// The element.
        element: String,
    },
    /// The header lacks something that a mesh or volume needs.
    #[error("the header has no {what}")]
    HeaderLacks {
        /// The missing part.
        what: &'static str,
    },
    /// A length or count is negative or fractional.
    #[error("{value} is not a {wanted}")]
    NotACount {
        /// The value in the file.
        value: f64,
        /// The expected kind of value.
        wanted: &'static str,
    },
    /// There are more elements than 32-bit indices can number.
    #[error("{count} {what} are more than the {} this program can index", u32::MAX)]
    TooMany {
        /// `vertices` or `corners`.
        what: &'static str,
        /// Number of elements.
        count: u64,
    },
    /// A volume has too many voxels.
    #[error("{} × {} × {} voxels are more than the {most} this program can hold", size[0], size[1], size[2])]
    TooLarge {
        /// Number of voxels along x, y, z.
        size: [usize; 3],
        /// Largest number of voxels, rows being padded to whole words.
        most: u64,
    },
    /// The length of a raw file does not match its size.
    #[error(
        "{} × {} × {} values of {bytes_each} byte(s) do not make the {found} bytes of the file",
        size[0], size[1], size[2]
    )]
    Length {
        /// Number of values along x, y, z.
        size: [usize; 3],
        /// Number of bytes of a value.
        bytes_each: u64,
        /// Length of the file in bytes.
        found: u64,
    },
    /// Compressed data cannot be decoded.
    #[error("the compressed data is damaged or ends too early: {reason}")]
    Compressed {
        /// The decoder's message.
        reason: String,
    },
    /// The file has points or lines but no faces.
    #[error("no faces ({vertices} vertices): a surface is needed, not a point cloud or a curve")]
    NoFaces {
        /// Number of vertices.
        vertices: usize,
    },
}

/// A defect at a byte offset. Its [`Place`] is computed only once, when the reader has failed.
#[derive(Debug)]
pub(super) struct Fault {
    pub at: At,
    pub defect: Defect,
}

#[derive(Debug, Clone, Copy)]
pub(super) enum At {
    /// Byte offset in text: reported as a line.
    Text(usize),
    /// Byte offset in binary data.
    Binary(usize),
    Whole,
}

impl Fault {
    pub fn text(offset: usize, defect: Defect) -> Self {
        Fault { at: At::Text(offset), defect }
    }

    pub fn binary(offset: usize, defect: Defect) -> Self {
        Fault { at: At::Binary(offset), defect }
    }

    pub fn whole(defect: Defect) -> Self {
        Fault { at: At::Whole, defect }
    }

    pub fn locate(self, bytes: &[u8]) -> ParseError {
        let place = match self.at {
            At::Text(offset) => Place::Line(line_of(bytes, offset)),
            At::Binary(offset) => Place::Byte(offset),
            At::Whole => Place::Whole,
        };
        ParseError { place, defect: self.defect }
    }
}

/// Returns the line, from 1, of a byte offset; lines end with `\n`, `\r\n` or `\r`.
fn line_of(bytes: &[u8], offset: usize) -> usize {
    let before = &bytes[..offset.min(bytes.len())];
    let ends = |(i, &b): (usize, &u8)| b == b'\n' || (b == b'\r' && bytes.get(i + 1) != Some(&b'\n'));
    1 + before.iter().enumerate().filter(|&x| ends(x)).count()
}

/// Formats a token for a message: printable and short.
pub(super) fn quote(token: &[u8]) -> String {
    const LONGEST: usize = 40;
    let text = String::from_utf8_lossy(&token[..token.len().min(4 * LONGEST)]);
    let mut out: String = text.chars().take(LONGEST).flat_map(char::escape_debug).collect();
    if text.chars().count() > LONGEST {
        out.push('…');
    }
    out
}
