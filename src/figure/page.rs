use tiny_skia::{Pixmap, PixmapPaint, Transform};

use super::bar::Bar;
use super::colour::{Colour, error_colour, grey};
use super::drawing::{Anchor, Drawing, Shape};
use super::frame::Frame;
use super::outline::edges;
use super::raster::{Raster, SAMPLES, Sheet, blank_sheet, encode_png};
use super::scale::Scale;
use super::{FigureError, FlatMap, style, text};

/// Above as many corners the faces of an SVG become a picture: 60 000 quads, about 8 MB.
const VECTOR_CORNERS: usize = 240_000;
/// Pixels of that picture per pixel of paper, if the file stays below [`PICTURE_BYTES`]; else one.
const PICTURE_ZOOM: usize = 2;
const PICTURE_BYTES: usize = 8_000_000;
/// Mesh edges are drawn when an average face covers as many square pixels.
const FACE_WITH_EDGES: f64 = 60.0;
/// Width of the strokes in a face's own colour that close the seams which viewers of an SVG leave between neighbours.
const SEAM: f64 = 1.0;
/// Width of the strokes that keep flipped slivers visible.
const ALARM_STROKE: f64 = 2.0;
/// More boundary edges than these, as of faces that share no vertices, are not an outline: drawn, they would hide all.
const OUTLINE_EDGES: usize = 100_000;
/// Width of the map's outline.
const OUTLINE: f64 = 1.6;

/// What a scale is painted with.
#[derive(Clone, Copy)]
pub(super) struct Colours {
    /// Of t ∈ [0, 1].
    pub(super) on_scale: fn(f64) -> Colour,
    /// Of values that exceed the scale.
    pub(super) beyond: Colour,
}

impl Colours {
    const PLAIN: Colours = Colours { on_scale: error_colour, beyond: style::OVER };
    const MARKED: Colours = Colours { on_scale: grey, beyond: style::MARK };
}

/// A checked map with everything that is decided before drawing. Lengths are pixels.
pub(super) struct Page<'a> {
    map: &'a FlatMap<'a>,
    scale: Scale,
    colours: Colours,
    flipped: Vec<bool>,
    frame: Frame,
    bar: Bar,
    title: Vec<String>,
    /// Upper left corner of the plot area.
    corner: [f64; 2],
    size: [u32; 2],
}

impl<'a> Page<'a> {
    /// With a plot area whose longer side has `longest` pixels.
    pub(super) fn of(map: &'a FlatMap<'a>, longest: f64) -> Result<Page<'a>, FigureError> {
        let (low, high) = map.bounds()?;
        let frame = Frame::around(low, high, longest)?;
        let mut flipped: Vec<bool> = map.values.iter().map(|v| *v < 0.0).collect();
        map.flipped.iter().for_each(|f| flipped[*f] = true);
        let upright = map.values.iter().zip(&flipped).filter(|(_, flipped)| !**flipped);
        let upright = upright.map(|(v, _)| *v);
        let scale = match map.mark {
            Some(mark) => Scale::up_to(mark, upright),
            None => Scale::for_errors(upright),
        };
        let colours = if map.mark.is_some() { Colours::MARKED } else { Colours::PLAIN };
        let bar = Bar::new(&scale, colours, map.scale_label, flipped.iter().filter(|f| **f).count());

        let left = (style::MARGIN + frame.label_width()).ceil();
        let width = (left + frame.size[0] + bar.width() + style::MARGIN).ceil();
        let title = text::wrap(map.title, style::TITLE, (width - 2.0 * style::MARGIN) / style::WIDER_FONT, 2);
        let above = title.len() as f64 * style::TITLE_LINE + if title.is_empty() { 0.0 } else { style::GAP };
        let top = (style::MARGIN + above).ceil();
        let height = (top + frame.size[1] + Frame::label_height() + style::MARGIN).ceil();
        Ok(Page {
            map,
            scale,
            colours,
            flipped,
            frame,
            bar,
            title,
            corner: [left, top],
            size: [width as u32, height as u32],
        })
    }

    pub(super) fn to_png(&self) -> Result<Vec<u8>, FigureError> {
        encode_png(&self.sheet(1)?.pixels, 1)
    }

    /// The page in pixels, `zoom` times as large as on paper.
    pub(super) fn sheet(&self, zoom: usize) -> Result<Sheet, FigureError> {
        let mut pixels = blank_sheet(self.size[0] * zoom as u32, self.size[1] * zoom as u32)?;
        let [x, y] = self.corner.map(|c| c as i32 * zoom as i32);
        pixels.draw_pixmap(x, y, self.picture(zoom)?.as_ref(), &PixmapPaint::default(), Transform::identity(), None);
        let mut drawing = Drawing::default();
        self.surroundings(&mut drawing);
        drawing.paint(&mut pixels, zoom);
        Ok(Sheet { pixels, middle: self.corner[1] + self.frame.size[1] / 2.0 })
    }

    pub(super) fn to_svg(&self) -> Result<String, FigureError> {
        let mut drawing = Drawing::default();
        if self.map.faces.corners().len() <= VECTOR_CORNERS {
            self.faces(self.corner, |points, fill| {
                drawing.shapes.push(Shape::Polygon { points, fill, stroke: Some((fill, SEAM)) });
            });
            self.lines_and_flipped_faces(self.corner, &mut drawing);
        } else {
            let fine = encode_png(&self.picture(PICTURE_ZOOM)?, 1)?;
            let png = if fine.len() <= PICTURE_BYTES { fine } else { encode_png(&self.picture(1)?, 1)? };
            drawing.shapes.push(Shape::Picture { corner: self.corner, size: self.frame.size, png });
        }
        self.surroundings(&mut drawing);
        Ok(drawing.to_svg(self.size[0], self.size[1]))
    }

    /// The plot area in pixels, `zoom` times as large as on paper.
    fn picture(&self, zoom: usize) -> Result<Pixmap, FigureError> {
        let [width, height] = self.frame.size.map(|s| s as usize);
        let mut raster = Raster::new(width, height, zoom, (SAMPLES / zoom).max(1));
        self.faces([0.0; 2], |points, fill| raster.fill(points, fill));
        let mut sheet = raster.resolve()?;
        let mut drawing = Drawing::default();
        self.lines_and_flipped_faces([0.0; 2], &mut drawing);
        drawing.paint(&mut sheet, zoom);
        Ok(sheet)
    }

    /// Calls `draw` with corners and colour of each face that is not flipped; the plot area begins at `corner`.
    fn faces(&self, corner: [f64; 2], mut draw: impl FnMut(Vec<[f64; 2]>, Colour)) {
        for face in (0..self.map.faces.len()).filter(|f| !self.flipped[*f]) {
            draw(self.polygon(face, corner), self.colour(face));
        }
    }

    /// Mesh edges if an average face has room for them, the outline; flipped faces over all of it.
    fn lines_and_flipped_faces(&self, corner: [f64; 2], drawing: &mut Drawing) {
        let faces = 0..self.map.faces.len();
        let face_area = faces.clone().map(|f| area(&self.polygon(f, corner))).sum::<f64>() / faces.len() as f64;
        let edges = edges(self.map.faces);
        let outline = edges.iter().filter(|(_, single)| *single).count();
        let mut strokes = |only_outline: bool, colour, width| {
            let kept = edges.iter().filter(|(_, single)| *single || !only_outline);
            let segments = kept.map(|(edge, _)| edge.map(|v| self.place(v, corner))).collect();
            drawing.shapes.push(Shape::Segments { segments, colour, width, round: true });
        };
        if face_area > FACE_WITH_EDGES {
            strokes(false, style::MESH, (face_area.sqrt() * 0.05).clamp(0.6, 1.4));
        }
        if outline <= OUTLINE_EDGES {
            strokes(true, style::INK, OUTLINE);
        }
        for face in faces.filter(|f| self.flipped[*f]) {
            let stroke = Some((style::ALARM, ALARM_STROKE));
            let points = self.polygon(face, corner);
            drawing.shapes.push(Shape::Polygon { points, fill: style::ALARM, stroke });
        }
    }

    fn place(&self, vertex: u32, corner: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.frame.place(self.map.points[vertex as usize]);
        [x + corner[0], y + corner[1]]
    }

    fn polygon(&self, face: usize, corner: [f64; 2]) -> Vec<[f64; 2]> {
        self.map.faces.get(face).iter().map(|v| self.place(*v, corner)).collect()
    }

    fn colour(&self, face: usize) -> Colour {
        self.scale.position(self.map.values[face]).map_or(self.colours.beyond, self.colours.on_scale)
    }

    /// Title, frame with coordinates, colour bar, legend.
    fn surroundings(&self, drawing: &mut Drawing) {
        let [left, top] = self.corner;
        // Centred over the plot unless that would leave the sheet.
        let widest = self.title.iter().map(|line| text::width(line, style::TITLE)).fold(0.0, f64::max);
        let half = style::MARGIN + style::WIDER_FONT * widest / 2.0;
        let x = (left + self.frame.size[0] / 2.0).min(f64::from(self.size[0]) - half).max(half);
        for (i, line) in self.title.iter().enumerate() {
            let y = style::MARGIN + (i as f64 + 0.4) * style::TITLE_LINE;
            drawing.text([x, y], Anchor::Middle, style::TITLE, line.as_str());
        }
        self.frame.draw(self.corner, drawing);
        self.bar.draw([left + self.frame.size[0], top], self.frame.size[1], drawing);
    }
}

/// Area of a simple polygon, by Gauss.
fn area(points: &[[f64; 2]]) -> f64 {
    let next = points.iter().cycle().skip(1);
    points.iter().zip(next).map(|(p, q)| p[0] * q[1] - q[0] * p[1]).sum::<f64>().abs() / 2.0
}
