//! Pictures as PNG or SVG bytes: flat maps, surfaces with the checkerboard of a map, plots,
//! diagrams.
//!
//! A figure takes plain data (points, polygons, one number per face) and never computes a map. It
//! returns bytes; the caller decides where they are written. The same input always gives the same
//! bytes.
//!
//! | file | what it holds |
//! |---|---|
//! | `flat.rs` | [`FlatMap`]: the data of a flat map, and its checks |
//! | `flat_page.rs` | layout; the order in which faces, edges and flipped faces are drawn, on vectors or pixels |
//! | `scale.rs`, `colour.rs` | values → [0, 1] → colours, and the tick marks of a scale |
//! | `frame.rs`, `colour_bar.rs` | plane → paper with equal units on both axes, coordinates; colour bar and legend |
//! | `outline.rs` | the edges of the mesh, and which of them are its boundary |
//! | `drawing.rs` | vector shapes and text, written as SVG or painted on a picture |
//! | `plot/` | [`Plot`]: series of points on linear or logarithmic axes, laid out by plotters on a `Drawing` |
//! | `view/` | [`SurfaceView`]: a surface in space, shaded, with a checkerboard on it |
//! | `pair.rs` | [`Pair`]: a map and its surface side by side |
//! | `schematic.rs` | [`Diagram`]: points, lines and labels that explain |
//! | `composition.rs`, `palette.rs` | finished pictures on one sheet; small copies in 256 colours |
//! | `raster.rs` | polygons → pixels by supersampling; PNG |
//! | `text.rs`, `style.rs` | the embedded font; colours and sizes that all figures share |
//!
//! ```
//! use riemap::{figure::{FlatMap, Format}, surface::Faces};
//!
//! let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
//! let faces: Faces = [[0, 1, 2, 3]].iter().collect();
//! let map = FlatMap {
//!     points: &points,
//!     faces: &faces,
//!     values: &[1.0],
//!     flipped: &[],
//!     mark: None,
//!     title: "One square",
//!     scale_label: "quasi-conformal error σ₁/σ₂",
//! };
//! let picture: Vec<u8> = map.render(Format::Svg)?;
//! assert!(picture.starts_with(b"<svg"));
//! # Ok::<(), riemap::figure::FigureError>(())
//! ```

mod colour;
mod colour_bar;
mod composition;
mod drawing;
mod flat;
mod flat_page;
mod frame;
mod outline;
mod pair;
mod palette;
mod plot;
mod raster;
mod scale;
mod schematic;
mod style;
mod text;
mod view;

use std::path::{Path, PathBuf};

pub use colour::{Colour, error_colour};
pub use composition::{compose, small_copy};
pub use flat::FlatMap;
pub use pair::Pair;
pub use plot::{Axis, Panels, Plot, Reference, Series};
pub use scale::{Scale, power_of_ten};
pub use schematic::{Diagram, Form, Item, LineStyle, Panel};
pub use style::{ALARM, MARK, OVER};
pub use view::{Camera, Checker, Shading, SurfaceView};

/// The file format of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// RGB pixels, about 1600 × 1400.
    Png,
    /// Vector graphics; with more than 60 000 faces, the faces are an embedded PNG.
    Svg,
}

impl Format {
    /// Returns the format of a file's extension, in upper or lower case.
    ///
    /// # Errors
    /// [`FigureError::UnknownFormat`] for anything but `.png` and `.svg`.
    pub fn from_path(path: &Path) -> Result<Format, FigureError> {
        match path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase).as_deref() {
            Some("png") => Ok(Format::Png),
            Some("svg") => Ok(Format::Svg),
            _ => Err(FigureError::UnknownFormat { path: path.to_owned() }),
        }
    }
}

/// A picture cannot be drawn. Indices of faces and vertices count from 0.
#[derive(Debug, thiserror::Error)]
pub enum FigureError {
    /// The extension does not belong to either format.
    #[error("cannot tell the picture's format from `{}`: name it .png or .svg", path.display())]
    UnknownFormat {
        /// The path as given.
        path: PathBuf,
    },
    /// There are no faces.
    #[error("the map has no faces, so there is nothing to draw")]
    NoFaces,
    /// The number of values is not the number of faces.
    #[error("{values} values for {faces} faces: the picture needs one value per face")]
    ValueCount {
        /// Number of values given.
        values: usize,
        /// Number of faces.
        faces: usize,
    },
    /// A value is NaN.
    #[error("the value of face {face} (0-based) is not a number")]
    Value {
        /// The face.
        face: usize,
    },
    /// A face refers to a vertex that has no position.
    #[error("face {face} has vertex {vertex}, but there are only {points} points (all counted from 0)")]
    Vertex {
        /// The face.
        face: usize,
        /// The vertex.
        vertex: u32,
        /// Number of points.
        points: usize,
    },
    /// A flipped face does not exist.
    #[error("face {face} is listed as flipped, but there are only {faces} faces (counted from 0)")]
    Flipped {
        /// The face.
        face: usize,
        /// Number of faces.
        faces: usize,
    },
    /// Coordinates are NaN or infinite.
    #[error("vertex {vertex} of face {face} (0-based) is mapped to ({x}, {y}), which is no point of the plane")]
    Point {
        /// The vertex.
        vertex: u32,
        /// The first face with this vertex.
        face: usize,
        /// Its first coordinate.
        x: f64,
        /// Its second coordinate.
        y: f64,
    },
    /// All vertices are at one position.
    #[error("all vertices are mapped to ({x}, {y}): the map has no extent to draw")]
    NoExtent {
        /// First coordinate.
        x: f64,
        /// Second coordinate.
        y: f64,
    },
    /// Width or height is too large to be scaled in floating point.
    #[error("the map is {width:e} wide and {height:e} high, too large to be scaled to paper")]
    Extent {
        /// Width of the bounding box.
        width: f64,
        /// Height of the bounding box.
        height: f64,
    },
    /// The number of texture coordinates is not the number of corners.
    #[error(
        "{given} texture coordinates for {corners} corners: the picture needs one pair per corner, face after face"
    )]
    TextureCount {
        /// Number of pairs given.
        given: usize,
        /// Number of corners of all faces.
        corners: usize,
    },
    /// Texture coordinates are NaN or infinite.
    #[error("vertex {vertex} of face {face} (0-based) has texture coordinates ({u}, {v}), which are not finite")]
    Texture {
        /// The vertex.
        vertex: u32,
        /// The face of the corner.
        face: usize,
        /// The first coordinate.
        u: f64,
        /// The second coordinate.
        v: f64,
    },
    /// The upper end of a scale that begins at 1 is not above 1.
    #[error("faces cannot be marked beyond {mark}: errors begin at 1, so the mark must be above it")]
    Mark {
        /// The requested upper end.
        mark: f64,
    },
    /// The number of squares does not suit the size of the map.
    #[error("{squares} squares cannot be laid across a map {width} wide and {height} high")]
    Squares {
        /// The requested number.
        squares: usize,
        /// Width of the map.
        width: f64,
        /// Height of the map.
        height: f64,
    },
    /// The number of normals is not the number of faces.
    #[error("{normals} normals for {faces} faces: the picture needs one normal per face")]
    NormalCount {
        /// Number of normals given.
        normals: usize,
        /// Number of faces.
        faces: usize,
    },
    /// A marked face does not exist.
    #[error("face {face} is to be marked, but there are only {faces} faces (counted from 0)")]
    Marked {
        /// The face.
        face: usize,
        /// Number of faces.
        faces: usize,
    },
    /// A seam ends at a vertex of no face.
    #[error("seam {seam} ends at vertex {vertex}, which no face has (both counted from 0)")]
    Seam {
        /// The seam.
        seam: usize,
        /// The vertex.
        vertex: u32,
    },
    /// A position is NaN or infinite.
    #[error("vertex {vertex} of face {face} (0-based) is at {at:?}, which is no point of space")]
    Position {
        /// The vertex.
        vertex: u32,
        /// The first face with this vertex.
        face: usize,
        /// Its position.
        at: [f64; 3],
    },
    /// The surface is a single point, or is seen as one.
    #[error("the surface is seen as a single point, at {at:?}: it has no extent to draw")]
    NoSurfaceExtent {
        /// One of its points.
        at: [f64; 3],
    },
    /// The surface is too large to be scaled in floating point.
    #[error("the surface measures {size:?}, too large to be scaled to paper")]
    SurfaceExtent {
        /// Size of the bounding box.
        size: [f64; 3],
    },
    /// A direction of the camera is zero or not finite.
    #[error("the camera's direction `{name}` is {vector:?}: it must be finite and not 0")]
    Direction {
        /// Name of the direction.
        name: &'static str,
        /// The vector that was given.
        vector: [f64; 3],
    },
    /// The field of view is out of range.
    #[error("the camera's field of view is {angle}°: it must be from 0.1 to 90")]
    FieldOfView {
        /// In degrees.
        angle: f64,
    },
    /// Margins and title leave no room for the picture.
    #[error("margins and title leave {width} × {height} pixels for the picture: ask for a larger one")]
    Room {
        /// Pixels across.
        width: f64,
        /// Pixels down.
        height: f64,
    },
    /// A sheet of this size cannot be allocated.
    #[error("a sheet of {width} × {height} pixels cannot be made")]
    Sheet {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// The plot has no points that can be shown.
    #[error("the plot has no point that its axes can show, so there is nothing to draw")]
    NoPoints,
    /// A reference line with a slope needs logarithmic axes.
    #[error("the reference line `{label}` has a slope, which needs both axes logarithmic")]
    Slope {
        /// Its label.
        label: String,
    },
    /// The range of the values is too large or too small to be scaled in floating point.
    #[error("the plot's values would need an axis from {low:e} to {high:e}, which cannot be drawn")]
    PlotRange {
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
    },
    /// An error of the crate plotters.
    #[error("the plot could not be laid out")]
    Layout(#[from] plotters::drawing::DrawingAreaErrorKind<std::convert::Infallible>),
    /// There are no panels or pictures.
    #[error("there is no picture to put on the sheet")]
    NoPanels,
    /// A position in a diagram is NaN or infinite.
    #[error("a position in the panel `{title}` is ({x}, {y}), which is no point of the plane")]
    PanelPoint {
        /// Title of the panel.
        title: String,
        /// Its first coordinate.
        x: f64,
        /// Its second coordinate.
        y: f64,
    },
    /// A panel is empty, or all of its items are at one position.
    #[error("the panel `{title}` has no extent to draw")]
    PanelExtent {
        /// Its title.
        title: String,
    },
    /// A PNG file does not have the pixel format of figures.
    #[error("the picture is not a PNG file of 8-bit RGB pixels")]
    Panel,
    /// A file is not a PNG file.
    #[error("the picture cannot be read as PNG")]
    Decode(#[from] png::DecodingError),
    /// The encoder refused the picture.
    #[error("the picture could not be encoded as PNG")]
    Encode(#[from] png::EncodingError),
}
