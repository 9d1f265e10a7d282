use tiny_skia::{Pixmap, PixmapPaint, Transform};

use super::colour::Colour;
use super::colour_bar::{ColourBar, Colours};
use super::drawing::{Drawing, TextAnchor, VectorShape};
use super::frame::Frame;
use super::outline::edges;
use super::raster::{Raster, RenderedSheet, SAMPLES, blank_sheet, encode_png};
use super::scale::Scale;
use super::{FigureError, FlatMap, Format, style, text};

/// Largest number of corners for which the faces of an SVG are vectors (60 000 quads, about 8 MB);
/// with more they become an embedded picture.
const VECTOR_CORNERS: usize = 240_000;
/// Resolution of that picture in pixels per pixel of paper; 1 if the file would exceed
/// [`PICTURE_BYTES`].
const PICTURE_ZOOM: usize = 2;
const PICTURE_BYTES: usize = 8_000_000;
/// Mesh edges are drawn if an average face covers at least this many square pixels.
const FACE_WITH_EDGES: f64 = 60.0;
/// Width of the stroke of each face in its own colour; it closes the seams that SVG viewers leave
/// between neighbouring faces.
const SEAM: f64 = 1.0;
/// Width of the strokes that keep thin flipped faces visible.
const ALARM_STROKE: f64 = 2.0;
/// Largest number of boundary edges that are drawn. If faces share no vertices, every edge is a
/// boundary edge and would hide them.
const OUTLINE_EDGES: usize = 100_000;
/// Width of the map's outline.
const OUTLINE: f64 = 1.6;

/// A checked map with its layout. Lengths are pixels.
pub(super) struct FlatPage<'a> {
    map: &'a FlatMap<'a>,
    scale: Scale,
    colours: Colours,
    flipped: Vec<bool>,
    frame: Frame,
    bar: ColourBar,
    title: Vec<String>,
    /// Upper left corner of the plot area.
    corner: [f64; 2],
    size: [u32; 2],
}

impl FlatMap<'_> {
    /// Renders the picture to the bytes of a file.
    ///
    /// # Errors
    /// Every variant of [`FigureError`] but `UnknownFormat`: inconsistent sizes, indices out of
    /// range, or coordinates that cannot be drawn.
    pub fn render(&self, format: Format) -> Result<Vec<u8>, FigureError> {
        let page = FlatPage::of(self, style::PLOT)?;
        match format {
            Format::Png => page.to_png(),
            Format::Svg => page.to_svg().map(String::into_bytes),
        }
    }
}

impl<'a> FlatPage<'a> {
    /// Lays out a page whose plot area has a longer side of `longest` pixels.
    pub(super) fn of(map: &'a FlatMap<'a>, longest: f64) -> Result<FlatPage<'a>, FigureError> {
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
        let bar = ColourBar::new(&scale, colours, map.scale_label, flipped.iter().filter(|f| **f).count());

        let left = (style::MARGIN + frame.label_width()).ceil();
        let width = (left + frame.size[0] + bar.width() + style::MARGIN).ceil();
        let title = text::wrap(map.title, style::TITLE, (width - 2.0 * style::MARGIN) / style::WIDER_FONT, 2);
        let above = title.len() as f64 * style::TITLE_LINE + if title.is_empty() { 0.0 } else { style::GAP };
        let top = (style::MARGIN + above).ceil();
        let height = (top + frame.size[1] + Frame::label_height() + style::MARGIN).ceil();
        Ok(FlatPage {
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

    /// Renders the page at `zoom` pixels per pixel of paper.
    pub(super) fn sheet(&self, zoom: usize) -> Result<RenderedSheet, FigureError> {
        let mut pixels = blank_sheet(self.size[0] * zoom as u32, self.size[1] * zoom as u32)?;
        let [x, y] = self.corner.map(|c| c as i32 * zoom as i32);
        pixels.draw_pixmap(x, y, self.picture(zoom)?.as_ref(), &PixmapPaint::default(), Transform::identity(), None);
        let mut drawing = Drawing::default();
        self.surroundings(&mut drawing);
        drawing.paint(&mut pixels, zoom);
        Ok(RenderedSheet { pixels, middle: self.corner[1] + self.frame.size[1] / 2.0 })
    }

    pub(super) fn to_svg(&self) -> Result<String, FigureError> {
        let mut drawing = Drawing::default();
        if self.map.faces.corners().len() <= VECTOR_CORNERS {
            self.faces(self.corner, |points, fill| {
                drawing.shapes.push(VectorShape::Polygon { points, fill, stroke: Some((fill, SEAM)) });
            });
            self.lines_and_flipped_faces(self.corner, &mut drawing);
        } else {
            let fine = encode_png(&self.picture(PICTURE_ZOOM)?, 1)?;
            let png = if fine.len() <= PICTURE_BYTES { fine } else { encode_png(&self.picture(1)?, 1)? };
            drawing.shapes.push(VectorShape::Picture { corner: self.corner, size: self.frame.size, png });
        }
        self.surroundings(&mut drawing);
        Ok(drawing.to_svg(self.size[0], self.size[1]))
    }

    /// Renders the plot area at `zoom` pixels per pixel of paper.
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

    /// Calls `draw` with the corners and the colour of each face that is not flipped; the plot area
    /// begins at `corner`.
    fn faces(&self, corner: [f64; 2], mut draw: impl FnMut(Vec<[f64; 2]>, Colour)) {
        for face in (0..self.map.faces.len()).filter(|f| !self.flipped[*f]) {
            draw(self.polygon(face, corner), self.colour(face));
        }
    }

    /// Draws mesh edges if an average face is large enough, then the outline, then flipped faces.
    fn lines_and_flipped_faces(&self, corner: [f64; 2], drawing: &mut Drawing) {
        let faces = 0..self.map.faces.len();
        let face_area = faces.clone().map(|f| area(&self.polygon(f, corner))).sum::<f64>() / faces.len() as f64;
        let edges = edges(self.map.faces);
        let outline = edges.iter().filter(|(_, single)| *single).count();
        let mut strokes = |only_outline: bool, colour, width| {
            let kept = edges.iter().filter(|(_, single)| *single || !only_outline);
            let segments = kept.map(|(edge, _)| edge.map(|v| self.place(v, corner))).collect();
            drawing.shapes.push(VectorShape::Segments { segments, colour, width, round: true });
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
            drawing.shapes.push(VectorShape::Polygon { points, fill: style::ALARM, stroke });
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

    /// Draws title, frame with coordinates, colour bar and legend.
    fn surroundings(&self, drawing: &mut Drawing) {
        let [left, top] = self.corner;
        // Centred over the plot unless it would leave the sheet.
        let widest = self.title.iter().map(|line| text::width(line, style::TITLE)).fold(0.0, f64::max);
        let half = style::MARGIN + style::WIDER_FONT * widest / 2.0;
        let x = (left + self.frame.size[0] / 2.0).min(f64::from(self.size[0]) - half).max(half);
        for (i, line) in self.title.iter().enumerate() {
            let y = style::MARGIN + (i as f64 + 0.4) * style::TITLE_LINE;
            drawing.text([x, y], TextAnchor::Middle, style::TITLE, line.as_str());
        }
        self.frame.draw(self.corner, drawing);
        self.bar.draw([left + self.frame.size[0], top], self.frame.size[1], drawing);
    }
}

/// The area of a simple polygon (shoelace formula).
fn area(points: &[[f64; 2]]) -> f64 {
    let next = points.iter().cycle().skip(1);
    points.iter().zip(next).map(|(p, q)| p[0] * q[1] - q[0] * p[1]).sum::<f64>().abs() / 2.0
}
