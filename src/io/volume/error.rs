use std::io;
use std::path::PathBuf;

use thiserror::Error;

use super::VolumeFormat;
use crate::io::ParseError;

/// A volume could not be read.
#[derive(Debug, Error)]
pub enum VolumeError {
    /// The operating system refused: no such file, no permission, ….
    #[error("cannot read {}: {source}", path.display())]
    Io {
        /// The requested file.
        path: PathBuf,
        /// The system's message.
        source: io::Error,
    },
    /// The path is a folder.
    #[error("{} is a directory; name a volume in it ({})", path.display(), VolumeFormat::known())]
    Directory {
        /// The requested path.
        path: PathBuf,
    },
    /// The extension does not belong to a known format.
    #[error("{}: unknown volume format; known extensions: {}", path.display(), VolumeFormat::known())]
    UnknownFormat {
        /// The requested path.
        path: PathBuf,
    },
    /// The content is not a volume in the format of its extension.
    #[error("{}, {source}", path.display())]
    Parse {
        /// The requested file.
        path: PathBuf,
        /// The defect and its place.
        source: ParseError,
    },
    /// An option is given that the format does not use.
    #[error("{}: a .{} file states its own {key}", path.display(), format.extension())]
    Superfluous {
        /// The requested file.
        path: PathBuf,
        /// Its format.
        format: VolumeFormat,
        /// The option: `size` or `type`.
        key: &'static str,
    },
    /// The size of a raw file is not given.
    #[error("{}: raw values have no header, and the number of values along x, y, z is not given", path.display())]
    SizeNeeded {
        /// The requested file.
        path: PathBuf,
    },
    /// The threshold is not a finite number.
    #[error("the threshold {threshold} is not a finite number")]
    Threshold {
        /// The threshold that was given.
        threshold: f64,
    },
    /// No value is above the threshold.
    #[error(
        "{}: none of the {values} values is above the threshold {threshold}; the largest is {most}",
        path.display()
    )]
    Empty {
        /// The requested file.
        path: PathBuf,
        /// Number of values.
        values: u64,
        /// The largest value.
        most: f64,
        /// The threshold.
        threshold: f64,
    },
}
