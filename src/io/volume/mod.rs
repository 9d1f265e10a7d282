//! Volumes: boxes of voxel values. The voxels whose value exceeds a threshold are inside.

mod error;
mod fill;
mod npy;
mod pgm3d;
mod raw;
mod vol;
mod write;

use std::fs;
use std::path::Path;

pub use error::VolumeError;
pub use write::write_vol;

use super::ParseError;
use super::error::Fault;
use crate::surface::digital::Solid;
use fill::Volume;

/// The information that a volume file does not contain itself.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct VolumeOptions {
    /// Voxels with a larger value are inside; the default is 0, as in DGtal.
    pub threshold: Option<f64>,
    /// Number of values along x, y, z of raw files.
    pub size: Option<[usize; 3]>,
    /// Type of the values of raw files; the default is [`Sample::U8`].
    pub sample: Option<Sample>,
}

/// The type of the values of a raw file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Sample {
    /// One byte.
    #[default]
    U8,
    /// Two bytes, little-endian.
    U16,
}

/// The volume formats that are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VolumeFormat {
    /// DGtal's `.vol`.
    Vol,
    /// DGtal's `.longvol`: values of 8 bytes.
    Longvol,
    /// PGM in three dimensions.
    Pgm3d,
    /// NumPy arrays, `a[x, y, z]`.
    Npy,
    /// Values without a header.
    Raw,
}

impl VolumeFormat {
    /// Every format.
    pub const ALL: [VolumeFormat; 5] =
        [VolumeFormat::Vol, VolumeFormat::Longvol, VolumeFormat::Pgm3d, VolumeFormat::Npy, VolumeFormat::Raw];

    /// The file name extension in lower case.
    pub fn extension(self) -> &'static str {
        match self {
            VolumeFormat::Vol => "vol",
            VolumeFormat::Longvol => "longvol",
            VolumeFormat::Pgm3d => "pgm3d",
            VolumeFormat::Npy => "npy",
            VolumeFormat::Raw => "raw",
        }
    }

    /// Returns the format of a path's extension, in upper or lower case.
    pub fn of(path: &Path) -> Option<VolumeFormat> {
        let extension = path.extension()?;
        VolumeFormat::ALL.into_iter().find(|format| extension.eq_ignore_ascii_case(format.extension()))
    }

    /// Lists all extensions for messages: `.vol, .longvol, …`.
    pub fn known() -> String {
        VolumeFormat::ALL.map(|format| format!(".{}", format.extension())).join(", ")
    }
}

/// Whether a path has the extension of a volume.
pub fn is_volume(path: &Path) -> bool {
    VolumeFormat::of(path).is_some()
}

/// Reads a volume; the extension determines the format. Voxels whose value exceeds the threshold
/// are inside.
///
/// # Errors
/// [`VolumeError`] if the path is not a readable file, the extension is unknown, the content is not
/// a volume in its format, an option is missing or superfluous, or no voxel is inside.
pub fn read_volume(path: &Path, options: &VolumeOptions) -> Result<Solid, VolumeError> {
    let owned = || path.to_owned();
    let threshold = options.threshold.unwrap_or(0.0);
    if !threshold.is_finite() {
        return Err(VolumeError::Threshold { threshold });
    }
    let io = |source| VolumeError::Io { path: owned(), source };
    if fs::metadata(path).map_err(io)?.is_dir() {
        return Err(VolumeError::Directory { path: owned() });
    }
    let format = VolumeFormat::of(path).ok_or_else(|| VolumeError::UnknownFormat { path: owned() })?;
    check(path, format, options)?;
    let bytes = fs::read(path).map_err(io)?;
    let located = |fault: Fault| VolumeError::Parse { path: owned(), source: fault.locate(&bytes) };
    let volume = parse(&bytes, format, options, threshold).map_err(located)?;
    if volume.solid.is_empty() {
        return Err(VolumeError::Empty { path: owned(), values: volume.values, most: volume.most, threshold });
    }
    Ok(volume.solid)
}

/// Reads a volume from the content of a file. The result can be empty.
///
/// # Errors
/// [`ParseError`] with the line or byte at which the content is not a volume in this format (for
/// raw values: of the size in `options`).
pub fn parse_volume(bytes: &[u8], format: VolumeFormat, options: &VolumeOptions) -> Result<Solid, ParseError> {
    let threshold = options.threshold.unwrap_or(0.0);
    parse(bytes, format, options, threshold).map(|volume| volume.solid).map_err(|fault| fault.locate(bytes))
}

/// Checks that size and type are given for raw files only.
fn check(path: &Path, format: VolumeFormat, options: &VolumeOptions) -> Result<(), VolumeError> {
    let path = || path.to_owned();
    match (format, options.size, options.sample) {
        (VolumeFormat::Raw, None, _) => Err(VolumeError::SizeNeeded { path: path() }),
        (VolumeFormat::Raw, ..) | (_, None, None) => Ok(()),
        (_, Some(_), _) => Err(VolumeError::Superfluous { path: path(), format, key: "size" }),
        (_, None, Some(_)) => Err(VolumeError::Superfluous { path: path(), format, key: "type" }),
    }
}

fn parse(bytes: &[u8], format: VolumeFormat, options: &VolumeOptions, threshold: f64) -> Result<Volume, Fault> {
    match format {
        VolumeFormat::Vol => vol::read(bytes, vol::VolKind::Vol, threshold),
        VolumeFormat::Longvol => vol::read(bytes, vol::VolKind::Longvol, threshold),
        VolumeFormat::Pgm3d => pgm3d::read(bytes, threshold),
        VolumeFormat::Npy => npy::read(bytes, threshold),
        VolumeFormat::Raw => {
            raw::read(bytes, options.size.unwrap_or_default(), options.sample.unwrap_or_default(), threshold)
        }
    }
}
