//! Diagrams that explain the method, drawn from computed values.

mod cotan;
mod dual_points;
mod initial;
mod surfel;
mod two_circles;

use serde::Deserialize;
use serde_json::{Value, json};

use super::surface::SurfaceSpec;
use super::{Caption, ConfigError, Document, ExperimentKind, Picture, RunError, Task, Yield};
use crate::figure::{Colour, Diagram, Format, Item, LineStyle};
use crate::input::Input;
use crate::map::MapOptions;
use crate::surface::oriented_mesh::NotADisc;

/// The kind of experiment that draws a diagram from computed values.
pub(super) struct DiagramKind;

/// `[diagram]`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Spec {
    /// One of [`DIAGRAMS`].
    name: String,
    /// Index of the face that is shown, from 0.
    #[serde(default)]
    face: usize,
    /// The edge of that face that is shown: the edge that follows corner 0, 1, ….
    #[serde(default)]
    corner: usize,
    /// The text below the diagram.
    caption: Option<Caption>,
}

/// The data from which a diagram is made.
struct Subject<'a> {
    input: &'a Input,
    options: &'a MapOptions,
    face: usize,
    corner: usize,
}

/// A diagram: its panels, how many stand in a row, and the numbers in it.
type Drawn = (Diagram, Value);

/// A diagram with its name in configs.
struct NamedDiagram {
    name: &'static str,
    draw: fn(&Subject) -> Result<Drawn, RunError>,
}

/// All diagrams.
static DIAGRAMS: &[NamedDiagram] = &[
    NamedDiagram { name: "dual-points", draw: dual_points::draw },
    NamedDiagram { name: "surfel", draw: surfel::draw },
    NamedDiagram { name: "cotan", draw: cotan::draw },
    NamedDiagram { name: "initial", draw: initial::draw },
    NamedDiagram { name: "two-circles", draw: two_circles::draw },
];

/// A surface that a diagram cannot be made of.
#[derive(Debug, thiserror::Error)]
pub enum DiagramError {
    /// The surface has faces of another kind than the diagram shows.
    #[error("the diagram `{diagram}` is of {wanted}, but {source_name} is not made of these")]
    Surface {
        /// Its name.
        diagram: &'static str,
        /// The required kind of faces.
        wanted: &'static str,
        /// The surface.
        source_name: String,
    },
    /// A surface that is not a disc.
    #[error(transparent)]
    NotADisc(#[from] NotADisc),
    /// A face index out of range.
    #[error("the diagram is about face {face}, but {source_name} has only {faces} faces (counted from 0)")]
    Face {
        /// The face.
        face: usize,
        /// The number of faces.
        faces: usize,
        /// The surface.
        source_name: String,
    },
    /// A boundary edge where one between two triangles is wanted.
    #[error(
        "the edge behind corner {corner} of face {face} is on the boundary, or there is no such corner: take another"
    )]
    Edge {
        /// The face.
        face: usize,
        /// The corner.
        corner: usize,
    },
}

struct DiagramTask {
    surface: SurfaceSpec,
    options: MapOptions,
    spec: Spec,
    row: &'static NamedDiagram,
    /// For captions.
    config: Value,
}

impl ExperimentKind for DiagramKind {
    fn name(&self) -> &'static str {
        "diagram"
    }

    fn description(&self) -> &'static str {
        "a drawing that explains, made of what the program computes"
    }

    fn tables(&self) -> &'static [&'static str] {
        &["surface", "map", "diagram"]
    }

    fn columns(&self) -> &'static [(&'static str, &'static str)] {
        &[("config.diagram.name", "diagram")]
    }

    fn task(&self, config: &Document) -> Result<Box<dyn Task>, ConfigError> {
        let spec: Spec = config.table("diagram")?;
        let known: Vec<&str> = DIAGRAMS.iter().map(|row| row.name).collect();
        config.check_name("diagram.name", "diagram", &spec.name, &known)?;
        let row = DIAGRAMS.iter().find(|row| row.name == spec.name).unwrap_or(&DIAGRAMS[0]);
        let (surface, options) = (SurfaceSpec::of(config)?, config.table("map")?);
        Ok(Box::new(DiagramTask { surface, options, spec, row, config: config.to_json()? }))
    }
}

impl Task for DiagramTask {
    fn run(&self) -> Result<Yield, RunError> {
        let input = self.surface.open()?;
        let faces = input.surface.faces.len();
        let Spec { face, corner, .. } = self.spec;
        if face >= faces {
            return Err(DiagramError::Face { face, faces, source_name: input.source }.into());
        }
        let (mut diagram, result) = (self.row.draw)(&Subject { input: &input, options: &self.options, face, corner })?;
        if let Some(caption) = &self.spec.caption {
            diagram.caption = caption.filled(&json!({ "config": self.config, "result": result }))?;
        }
        let picture = |format| Ok(Picture { suffix: "", format, bytes: diagram.render(format)? });
        let pictures = [Format::Png, Format::Svg].into_iter().map(picture).collect::<Result<_, RunError>>()?;
        Ok(Yield { result, pictures, ..Yield::default() })
    }
}

/// Colours that readers of any colour vision tell apart (Okabe and Ito), and greys.
const BLUE: Colour = Colour([0, 114, 178]);
const VERMILION: Colour = Colour([213, 94, 0]);
const GREEN: Colour = Colour([0, 138, 100]);
const ORANGE: Colour = Colour([230, 159, 0]);
const INK: Colour = Colour([32, 34, 38]);
const GREY: Colour = Colour([150, 150, 156]);
const PALE_BLUE: Colour = Colour([221, 235, 247]);
const PALE_ORANGE: Colour = Colour([252, 232, 200]);

type Point = [f64; 2];

fn line(points: Vec<Point>, colour: Colour, width: f64) -> Item {
    Item::Line { points, colour, width, style: LineStyle::Solid }
}

fn dashed(points: Vec<Point>, colour: Colour, width: f64) -> Item {
    Item::Line { points, colour, width, style: LineStyle::Dashed }
}

fn arrow(from: Point, to: Point, colour: Colour, width: f64) -> Item {
    Item::Line { points: vec![from, to], colour, width, style: LineStyle::Arrow }
}

fn label(at: Point, shift: Point, text: impl Into<String>) -> Item {
    Item::Label { at, shift, text: text.into(), covering: false }
}

/// Points of a circular arc from one angle to another, in radians.
fn arc(centre: Point, radius: f64, from: f64, to: f64) -> Vec<Point> {
    let at = |i: u32| from + (to - from) * f64::from(i) / 180.0;
    (0..=180).map(|i| [centre[0] + radius * at(i).cos(), centre[1] + radius * at(i).sin()]).collect()
}

fn closed(mut points: Vec<Point>) -> Vec<Point> {
    points.extend(points.first().copied());
    points
}
