use std::fmt;
use std::io;
use std::path::PathBuf;

use thiserror::Error;

use super::Format;

/// Why a mesh file could not be read.
#[derive(Debug, Error)]
pub enum ReadError {
    /// The operating system refused: no such file, no permission, …
    #[error("cannot read {}: {source}", path.display())]
    Io {
        /// The file asked for.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A folder was named.
    #[error("{} is a directory; name a mesh file in it ({})", path.display(), Format::known())]
    Directory {
        /// The path asked for.
        path: PathBuf,
    },
    /// The extension is that of no known format.
    #[error("{}: unknown mesh format; known extensions: {}", path.display(), Format::known())]
    UnknownFormat {
        /// The path asked for.
        path: PathBuf,
    },
    /// The content is not a mesh in the format its extension states.
    #[error("{}, {source}", path.display())]
    Parse {
        /// The file asked for.
        path: PathBuf,
        /// Where it is wrong and how.
        source: ParseError,
    },
}

/// What is wrong in the content of a mesh or volume file, and where.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{place}: {defect}")]
pub struct ParseError {
    /// Line or byte.
    pub place: Place,
    /// What was found there.
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

/// What can be wrong with a mesh or volume file.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Defect {
    /// Nothing but blanks and comments.
    #[error("the file is empty")]
    Empty,
    /// The first words are not those of the format.
    #[error("`{found}` where {wanted} was expected")]
    Unexpected {
        /// What stands there.
        found: String,
        /// What should.
        wanted: &'static str,
    },
    /// The format allows it, this program does not read it.
    #[error("{what} cannot be read; {advice}")]
    Unsupported {
        /// The feature.
        what: &'static str,
        /// What the user can do.
        advice: &'static str,
    },
    /// A number was expected.
    #[error("`{token}` is not a number ({wanted} was expected)")]
    NotANumber {
        /// What stands there.
        token: String,
        /// What the number should have said.
        wanted: &'static str,
    },
    /// NaN, an infinity, or a number beyond the range of doubles.
    #[error("the coordinate `{token}` is not a finite number")]
    NotFinite {
        /// What stands there.
        token: String,
    },
    /// A vertex or normal has fewer than three coordinates.
    #[error("only {found} of 3 coordinates")]
    MissingCoordinates {
        /// How many there are.
        found: usize,
    },
    /// OBJ counts from 1: there is no index 0.
    #[error("the index 0 in `{token}`: this format counts from 1")]
    IndexZero {
        /// The corner it stands in.
        token: String,
    },
    /// A vertex or normal that the file does not have.
    #[error("{what} {index} does not exist: the file has {count} (counted from {base})")]
    IndexOutOfRange {
        /// `vertex` or `normal`.
        what: &'static str,
        /// The index as the file has it.
        index: i64,
        /// How many of these were read (OBJ with a negative index: up to this line).
        count: usize,
        /// What the format counts from: 0 or 1.
        base: usize,
    },
    /// A point or a segment among the faces.
    #[error("a face with {corners} corners; faces have 3 or more")]
    TooFewCorners {
        /// How many corners it has.
        corners: usize,
    },
    /// The file ends early.
    #[error("the file ends too early: {wanted} was expected ({done} of {expected} {what} read)")]
    UnexpectedEnd {
        /// What should have come next.
        wanted: &'static str,
        /// `vertices`, `faces`, `header lines`, …
        what: &'static str,
        /// How many of them are complete.
        done: u64,
        /// How many the header promises.
        expected: u64,
    },
    /// The same in a format that does not count beforehand.
    #[error("the file ends too early: {wanted} was expected ({done} {what} read)")]
    OpenEnd {
        /// What should have come next.
        wanted: &'static str,
        /// `facets`, …
        what: &'static str,
        /// How many of them are complete.
        done: u64,
    },
    /// More elements than the file has bytes for.
    #[error("the header promises {count} {what} of at least {bytes_each} bytes, but only {left} bytes follow")]
    Truncated {
        /// `vertices`, `faces`, …
        what: String,
        /// The promised number.
        count: u64,
        /// Smallest size of one.
        bytes_each: u64,
        /// What is left of the file.
        left: u64,
    },
    /// The file goes on after its last element.
    #[error("`{token}` after the end of the data: the counts in the header are too small, or a line above is too long")]
    Trailing {
        /// The first thing that is too much.
        token: String,
    },
    /// A binary file goes on after its last element.
    #[error("{bytes} bytes too many after the last element: the counts in the header do not fit the data")]
    TrailingBytes {
        /// How many.
        bytes: u64,
    },
    /// An ascii PLY record has more values than its element has properties.
    #[error("`{token}` is one value too many for an element `{element}`")]
    ExtraValue {
        /// The first value that is too much.
        token: String,
        /// The element.
        element: String,
    },
    /// A PLY header lacks what a mesh needs.
    #[error("the header has no {what}")]
    HeaderLacks {
        /// The missing part.
        what: &'static str,
    },
    /// A list of negative or fractional length, or an index that is no whole number.
    #[error("{value} is not a {wanted}")]
    NotACount {
        /// The value in the file.
        value: f64,
        /// What it should have been.
        wanted: &'static str,
    },
    /// 32-bit indices are used throughout.
    #[error("{count} {what} are more than the {} this program can index", u32::MAX)]
    TooMany {
        /// `vertices` or `corners`.
        what: &'static str,
        /// How many there are.
        count: u64,
    },
    /// A volume of too many voxels.
    #[error("{} × {} × {} voxels are more than the {most} this program can hold", size[0], size[1], size[2])]
    TooLarge {
        /// Voxels along x, y, z.
        size: [usize; 3],
        /// Most voxels, rows being filled up to whole words.
        most: u64,
    },
    /// A raw file of another length than its size says.
    #[error(
        "{} × {} × {} values of {bytes_each} byte(s) do not make the {found} bytes of the file",
        size[0], size[1], size[2]
    )]
    Length {
        /// Values along x, y, z.
        size: [usize; 3],
        /// Bytes of a value.
        bytes_each: u64,
        /// Length of the file.
        found: u64,
    },
    /// Data that zlib does not understand.
    #[error("the compressed data is damaged or ends too early: {reason}")]
    Compressed {
        /// What the decoder said.
        reason: String,
    },
    /// Points or lines without a surface.
    #[error("no faces ({vertices} vertices): a surface is needed, not a point cloud or a curve")]
    NoFaces {
        /// How many vertices there are.
        vertices: usize,
    },
}

/// A defect at a byte offset; [`Place`] is worked out from it once, when the reader has given up.
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

/// 1-based line of a byte offset; lines end with `\n`, `\r\n` or `\r`.
fn line_of(bytes: &[u8], offset: usize) -> usize {
    let before = &bytes[..offset.min(bytes.len())];
    let ends = |(i, &b): (usize, &u8)| b == b'\n' || (b == b'\r' && bytes.get(i + 1) != Some(&b'\n'));
    1 + before.iter().enumerate().filter(|&x| ends(x)).count()
}

/// A token for a message: printable and short.
pub(super) fn quote(token: &[u8]) -> String {
    const LONGEST: usize = 40;
    let text = String::from_utf8_lossy(&token[..token.len().min(4 * LONGEST)]);
    let mut out: String = text.chars().take(LONGEST).flat_map(char::escape_debug).collect();
    if text.chars().count() > LONGEST {
        out.push('…');
    }
    out
}
