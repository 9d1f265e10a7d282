use std::io;
use std::path::PathBuf;

use thiserror::Error;

use super::VolumeFormat;
use crate::io::ParseError;

/// Why a volume could not be read.
#[derive(Debug, Error)]
pub enum VolumeError {
    /// The operating system refused: no such file, no permission, …
    #[error("cannot read {}: {source}", path.display())]
    Io {
        /// The file asked for.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A folder was named.
    #[error("{} is a directory; name a volume in it ({})", path.display(), VolumeFormat::known())]
    Directory {
        /// The path asked for.
        path: PathBuf,
    },
    /// The extension is that of no known format.
    #[error("{}: unknown volume format; known extensions: {}", path.display(), VolumeFormat::known())]
    UnknownFormat {
        /// The path asked for.
        path: PathBuf,
    },
    /// The content is not a volume in the format its extension states.
    #[error("{}, {source}", path.display())]
    Parse {
        /// The file asked for.
        path: PathBuf,
        /// Where it is wrong and how.
        source: ParseError,
    },
    /// An option that a format has no use for.
    #[error("{}: a .{} file states its own {key}", path.display(), format.extension())]
    Superfluous {
        /// The file asked for.
        path: PathBuf,
        /// Its format.
        format: VolumeFormat,
        /// The option: `size` or `type`.
        key: &'static str,
    },
    /// A raw file without its size.
    #[error("{}: raw values have no header, and the number of values along x, y, z is not given", path.display())]
    SizeNeeded {
        /// The file asked for.
        path: PathBuf,
    },
    /// A threshold that is not a number.
    #[error("the threshold {threshold} is not a finite number")]
    Threshold {
        /// What was given.
        threshold: f64,
    },
    /// No value is above the threshold.
    #[error(
        "{}: none of the {values} values is above the threshold {threshold}; the largest is {most}",
        path.display()
    )]
    Empty {
        /// The file asked for.
        path: PathBuf,
        /// Number of values.
        values: u64,
        /// The largest of them.
        most: f64,
        /// What they must exceed.
        threshold: f64,
    },
}
