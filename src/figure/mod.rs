//! Pictures: maps drawn flat, surfaces with the map's checkerboard, plots; as PNG or SVG bytes.
//!
//! A figure reads plain data (points, polygons, one number per face) and never computes a map. It returns bytes, so that
//! the caller decides where and how they are written. The same input gives the same bytes on every run.
//!
//! | file | what it holds |
//! |---|---|
//! | `flat.rs` | [`FlatMap`]: what is drawn, and its checks |
//! | `page.rs` | layout; the order in which faces, edges and flipped faces are drawn, on vectors or pixels |
//! | `scale.rs`, `colour.rs` | values → [0, 1] → colours, and the tick marks of a scale |
//! | `frame.rs`, `bar.rs` | plane → paper with equal units on both axes, coordinates; colour bar and legend |
//! | `outline.rs` | the edges of the mesh, and which of them are its boundary |
//! | `drawing.rs` | vector shapes and text, written as SVG or painted on a picture |
//! | `plot*.rs` | [`Plot`]: series of points on linear or logarithmic axes, laid out by plotters on a `Drawing` |
//! | `view/` | [`SurfaceView`]: a surface in space, shaded, with a checkerboard on it |
//! | `pair.rs` | [`Pair`]: a map and its surface side by side |
//! | `diagram.rs` | [`Diagram`]: points, lines and labels that explain |
//! | `sheet.rs`, `palette.rs` | finished pictures on one sheet; small copies in 256 colours |
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

mod bar;
mod colour;
mod diagram;
mod drawing;
mod flat;
mod frame;
mod outline;
mod page;
mod pair;
mod palette;
mod plot;
mod raster;
mod scale;
mod sheet;
mod style;
mod text;
mod view;

use std::path::{Path, PathBuf};

pub use colour::{Colour, error_colour};
pub use diagram::{Diagram, Form, Item, LineStyle, Panel};
pub use flat::FlatMap;
pub use pair::Pair;
pub use plot::{Axis, Panels, Plot, Reference, Series};
pub use scale::{Scale, power_of_ten};
pub use sheet::{compose, small_copy};
pub use style::{ALARM, MARK, OVER};
pub use view::{Camera, Checker, Shading, SurfaceView};

/// What a picture is written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// RGB pixels, about 1600 × 1400.
    Png,
    /// Vectors; above 60 000 faces the faces alone are an embedded PNG.
    Svg,
}

impl Format {
    /// The format that a file's extension names, in upper or lower case.
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

/// Why a picture cannot be drawn. Faces and vertices count from 0.
#[derive(Debug, thiserror::Error)]
pub enum FigureError {
    /// The extension names neither format.
    #[error("cannot tell the picture's format from `{}`: name it .png or .svg", path.display())]
    UnknownFormat {
        /// The path as given.
        path: PathBuf,
    },
    /// Nothing to draw.
    #[error("the map has no faces, so there is nothing to draw")]
    NoFaces,
    /// One value per face is wanted.
    #[error("{values} values for {faces} faces: the picture needs one value per face")]
    ValueCount {
        /// Number of values given.
        values: usize,
        /// Number of faces.
        faces: usize,
    },
    /// A value that no colour stands for.
    #[error("the value of face {face} (0-based) is not a number")]
    Value {
        /// The face.
        face: usize,
    },
    /// A face names a vertex that has no position.
    #[error("face {face} has vertex {vertex}, but there are only {points} points (all counted from 0)")]
    Vertex {
        /// The face.
        face: usize,
        /// The vertex it names.
        vertex: u32,
        /// Number of points.
        points: usize,
    },
    /// A flipped face that does not exist.
    #[error("face {face} is said to be flipped, but there are only {faces} faces (counted from 0)")]
    Flipped {
        /// The face.
        face: usize,
        /// Number of faces.
        faces: usize,
    },
    /// NaN or infinite coordinates.
    #[error("vertex {vertex} of face {face} (0-based) is mapped to ({x}, {y}), which is no point of the plane")]
    Point {
        /// The vertex.
        vertex: u32,
        /// The first face that has it.
        face: usize,
        /// Its first coordinate.
        x: f64,
        /// Its second coordinate.
        y: f64,
    },
    /// All vertices at one place.
    #[error("all vertices are mapped to ({x}, {y}): the map has no extent to draw")]
    NoExtent {
        /// First coordinate.
        x: f64,
        /// Second coordinate.
        y: f64,
    },
    /// Width or height exceeds what floating point can scale.
    #[error("the map is {width:e} wide and {height:e} high, too large to be scaled to paper")]
    Extent {
        /// Width of the bounding box.
        width: f64,
        /// Height of the bounding box.
        height: f64,
    },
    /// Texture coordinates do not match the corners of the faces.
    #[error(
        "{given} texture coordinates for {corners} corners: the picture needs one pair per corner, face after face"
    )]
    TextureCount {
        /// Number of pairs given.
        given: usize,
        /// Number of corners of all faces.
        corners: usize,
    },
    /// Texture coordinates that are NaN or infinite.
    #[error("vertex {vertex} of face {face} (0-based) has texture coordinates ({u}, {v}), which are not finite")]
    Texture {
        /// The vertex.
        vertex: u32,
        /// The face at whose corner they are.
        face: usize,
        /// The first coordinate.
        u: f64,
        /// The second coordinate.
        v: f64,
    },
    /// A scale of values from 1 that would end before it begins.
    #[error("faces cannot be marked beyond {mark}: errors begin at 1, so the mark must be above it")]
    Mark {
        /// As asked for.
        mark: f64,
    },
    /// Squares that a map has no place for.
    #[error("{squares} squares cannot be laid across a map {width} wide and {height} high")]
    Squares {
        /// As asked for.
        squares: usize,
        /// Width of the map.
        width: f64,
        /// Height of the map.
        height: f64,
    },
    /// One normal per face is wanted.
    #[error("{normals} normals for {faces} faces: the picture needs one normal per face")]
    NormalCount {
        /// Number of normals given.
        normals: usize,
        /// Number of faces.
        faces: usize,
    },
    /// A marked face that does not exist.
    #[error("face {face} is to be marked, but there are only {faces} faces (counted from 0)")]
    Marked {
        /// The face.
        face: usize,
        /// Number of faces.
        faces: usize,
    },
    /// A seam ends in a vertex that is on no face.
    #[error("seam {seam} ends at vertex {vertex}, which no face has (both counted from 0)")]
    Seam {
        /// The seam.
        seam: usize,
        /// The vertex.
        vertex: u32,
    },
    /// A position that is NaN or infinite.
    #[error("vertex {vertex} of face {face} (0-based) is at {at:?}, which is no point of space")]
    Position {
        /// The vertex.
        vertex: u32,
        /// The first face that has it.
        face: usize,
        /// Its position.
        at: [f64; 3],
    },
    /// A surface that is a point, or is seen as one.
    #[error("the surface is seen as a single point, at {at:?}: it has no extent to draw")]
    NoSurfaceExtent {
        /// One of its points.
        at: [f64; 3],
    },
    /// A surface whose size floating point cannot scale.
    #[error("the surface measures {size:?}, too large to be scaled to paper")]
    SurfaceExtent {
        /// Of its bounding box.
        size: [f64; 3],
    },
    /// A direction of the camera that is none.
    #[error("the camera's direction `{name}` is {vector:?}: it must be finite and not 0")]
    Direction {
        /// Which.
        name: &'static str,
        /// As given.
        vector: [f64; 3],
    },
    /// An angle that no lens has.
    #[error("the camera's field of view is {angle}°: it must be from 0.1 to 90")]
    FieldOfView {
        /// In degrees.
        angle: f64,
    },
    /// Margins and title leave no room.
    #[error("margins and title leave {width} × {height} pixels for the picture: ask for a larger one")]
    Room {
        /// Pixels across.
        width: f64,
        /// Pixels down.
        height: f64,
    },
    /// No such sheet of pixels.
    #[error("a sheet of {width} × {height} pixels cannot be made")]
    Sheet {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// A plot without a single point.
    #[error("the plot has no point that its axes can show, so there is nothing to draw")]
    NoPoints,
    /// A straight line of that slope is not straight on these axes.
    #[error("the reference line `{label}` has a slope, which needs both axes logarithmic")]
    Slope {
        /// Its name.
        label: String,
    },
    /// Values that floating point cannot scale to paper.
    #[error("the plot's values would need an axis from {low:e} to {high:e}, which cannot be drawn")]
    PlotRange {
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
    },
    /// What plotters says.
    #[error("the plot could not be laid out")]
    Layout(#[from] plotters::drawing::DrawingAreaErrorKind<std::convert::Infallible>),
    /// A sheet of nothing.
    #[error("there is no picture to put on the sheet")]
    NoPanels,
    /// A place in a diagram that is NaN or infinite.
    #[error("a place in the panel `{title}` is ({x}, {y}), which is no point of the plane")]
    PanelPoint {
        /// Title of the panel.
        title: String,
        /// Its first coordinate.
        x: f64,
        /// Its second coordinate.
        y: f64,
    },
    /// A panel in which all is at one place, or nothing is.
    #[error("the panel `{title}` has no extent to draw")]
    PanelExtent {
        /// Its title.
        title: String,
    },
    /// A PNG file of another kind than figures are.
    #[error("the picture is no PNG of 8-bit RGB, as figures are")]
    Panel,
    /// No PNG file.
    #[error("the picture cannot be read as PNG")]
    Decode(#[from] png::DecodingError),
    /// The encoder refused the picture.
    #[error("the picture could not be encoded as PNG")]
    Encode(#[from] png::EncodingError),
}
