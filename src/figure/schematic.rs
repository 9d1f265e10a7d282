use super::colour::Colour;
use super::drawing::{Drawing, TextAnchor, VectorShape};
use super::raster::{blank_sheet, encode_png};
use super::{FigureError, Format, style, text};

/// An explanatory drawing: panels of points, lines and labels in the plane, with a caption.
#[derive(Clone, Debug, Default)]
pub struct Diagram {
    /// The panels, row by row.
    pub panels: Vec<Panel>,
    /// Number of panels in a row, at least 1; a row has the width of a page.
    pub columns: usize,
    /// Text below the panels; broken at line breaks and where it is too long.
    pub caption: String,
}

/// A part of a [`Diagram`] with its own coordinates: x right, y upward, the same unit on both axes.
#[derive(Clone, Debug, Default)]
pub struct Panel {
    /// Title above the panel, on one line.
    pub title: String,
    /// The items; later ones cover earlier ones.
    pub items: Vec<Item>,
}

/// An item of a diagram. Positions are in the panel's units, widths and sizes in units of paper
/// (1/254 inch).
#[derive(Clone, Debug)]
pub enum Item {
    /// A filled polygon, with an optional outline.
    Area {
        /// Its corners.
        points: Vec<[f64; 2]>,
        /// Its colour.
        fill: Colour,
        /// Colour and width of the outline.
        outline: Option<(Colour, f64)>,
    },
    /// A line through points.
    Line {
        /// Its points, at least two.
        points: Vec<[f64; 2]>,
        /// Its colour.
        colour: Colour,
        /// Its width.
        width: f64,
        /// The line style.
        style: LineStyle,
    },
    /// A mark at a point.
    Dot {
        /// The point.
        at: [f64; 2],
        /// Shape of the mark.
        form: Form,
        /// Its colour; the outline is white.
        colour: Colour,
        /// Half of its height.
        size: f64,
    },
    /// A text beside a point.
    Label {
        /// The point.
        at: [f64; 2],
        /// Offset from the point to the centre of the text, in units of paper, y upward.
        shift: [f64; 2],
        /// The text.
        text: String,
        /// Whether the label has an opaque background.
        covering: bool,
    },
}

/// The style of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineStyle {
    /// A solid line.
    Solid,
    /// A dashed line.
    Dashed,
    /// A solid line with an arrow head at its last point.
    Arrow,
}

/// The shape of a mark, which distinguishes marks without colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// A disc.
    Disc,
    /// A square.
    Square,
    /// An upright triangle.
    Triangle,
}

/// Width of the page.
const WIDTH: f64 = 1600.0;
/// Width of the space between panels and around them.
const GUTTER: f64 = 44.0;
/// Space around the items of a panel, for labels at its edge.
const PADDING: f64 = 40.0;
/// Largest height of a panel: if there is one column, and if there are several.
const TALLEST: [f64; 2] = [900.0, 660.0];
/// Pixels per unit of paper.
const ZOOM: usize = 2;
/// Lengths of dashes and gaps.
const DASH: [f64; 2] = [12.0, 9.0];
/// Length and half width of an arrow head, relative to the line's width, and the smallest length.
const HEAD: [f64; 3] = [5.0, 2.0, 16.0];

impl Diagram {
    /// Renders the picture to the bytes of a file.
    ///
    /// # Errors
    /// There are no panels, a panel has no extent, or positions are not finite.
    pub fn render(&self, format: Format) -> Result<Vec<u8>, FigureError> {
        let (drawing, height) = self.lay_out()?;
        let [width, height] = [WIDTH as u32, height.ceil() as u32];
        match format {
            Format::Svg => Ok(drawing.to_svg(width, height).into_bytes()),
            Format::Png => {
                let zoom = ZOOM as u32;
                let mut sheet = blank_sheet(width * zoom, height * zoom)?;
                drawing.paint(&mut sheet, ZOOM);
                encode_png(&sheet, zoom)
            }
        }
    }

    /// Lays out everything on paper; returns the drawing and its height.
    fn lay_out(&self) -> Result<(Drawing, f64), FigureError> {
        if self.panels.is_empty() {
            return Err(FigureError::NoPanels);
        }
        let mut drawing = Drawing::default();
        let columns = self.columns.clamp(1, self.panels.len());
        let width = (WIDTH - GUTTER * (columns as f64 + 1.0)) / columns as f64;
        let mut top = style::MARGIN;
        for row in self.panels.chunks(columns) {
            let tallest = TALLEST[usize::from(columns > 1)];
            let frames: Vec<PanelFrame> =
                row.iter().map(|panel| PanelFrame::of(panel, [width, tallest])).collect::<Result<_, _>>()?;
            let titled = row.iter().any(|panel| !panel.title.is_empty());
            let below = top + if titled { style::TITLE_LINE } else { 0.0 };
            let height = frames.iter().map(|frame| frame.height).fold(0.0, f64::max);
            for (i, (panel, frame)) in row.iter().zip(&frames).enumerate() {
                let left = GUTTER + i as f64 * (width + GUTTER);
                let middle = [left + width / 2.0, top + 0.4 * style::TITLE_LINE];
                drawing.text(middle, TextAnchor::Middle, style::TEXT, panel.title.as_str());
                let centre = [left + width / 2.0, below + height / 2.0];
                panel.items.iter().for_each(|item| draw(item, |p| frame.place(p, centre), &mut drawing));
            }
            top = below + height + GUTTER / 2.0;
        }
        let room = (WIDTH - 2.0 * style::MARGIN) / style::WIDER_FONT;
        for line in self.caption.lines().flat_map(|line| text::wrap(line, style::TEXT, room, usize::MAX)) {
            drawing.text([WIDTH / 2.0, top + 0.5 * style::CAPTION_LINE], TextAnchor::Middle, style::TEXT, line);
            top += style::CAPTION_LINE;
        }
        Ok((drawing, top + style::MARGIN))
    }
}

/// The transformation from a panel's plane to paper.
struct PanelFrame {
    middle: [f64; 2],
    scale: f64,
    height: f64,
}

impl PanelFrame {
    fn of(panel: &Panel, size: [f64; 2]) -> Result<PanelFrame, FigureError> {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        let places = panel.items.iter().flat_map(|item| match item {
            Item::Area { points, .. } | Item::Line { points, .. } => points.as_slice(),
            Item::Dot { at, .. } | Item::Label { at, .. } => std::slice::from_ref(at),
        });
        for &[x, y] in places {
            if !(x.is_finite() && y.is_finite()) {
                return Err(FigureError::PanelPoint { title: panel.title.clone(), x, y });
            }
            low = [low[0].min(x), low[1].min(y)];
            high = [high[0].max(x), high[1].max(y)];
        }
        let extent = [high[0] - low[0], high[1] - low[1]];
        let room = size.map(|side| side - 2.0 * PADDING);
        let scale = (room[0] / extent[0]).min(room[1] / extent[1]);
        // The panel has no items, or all of them are at one position.
        if !(scale.is_finite() && scale > 0.0) {
            return Err(FigureError::PanelExtent { title: panel.title.clone() });
        }
        let middle = [0, 1].map(|k| low[k] / 2.0 + high[k] / 2.0);
        Ok(PanelFrame { middle, scale, height: extent[1] * scale + 2.0 * PADDING })
    }

    fn place(&self, [x, y]: [f64; 2], centre: [f64; 2]) -> [f64; 2] {
        [centre[0] + (x - self.middle[0]) * self.scale, centre[1] - (y - self.middle[1]) * self.scale]
    }
}

fn draw(item: &Item, place: impl Fn([f64; 2]) -> [f64; 2], drawing: &mut Drawing) {
    match item {
        Item::Area { points, fill, outline } => {
            let points = points.iter().map(|p| place(*p)).collect();
            drawing.shapes.push(VectorShape::Polygon { points, fill: *fill, stroke: *outline });
        }
        Item::Line { points, colour, width, style } => {
            let mut points: Vec<[f64; 2]> = points.iter().map(|p| place(*p)).collect();
            if *style == LineStyle::Arrow {
                arrow_head(&mut points, *colour, *width, drawing);
            }
            let segments = match style {
                LineStyle::Dashed => dashes(&points),
                _ => points.windows(2).map(|pair| [pair[0], pair[1]]).collect(),
            };
            let round = *style != LineStyle::Arrow;
            drawing.shapes.push(VectorShape::Segments { segments, colour: *colour, width: *width, round });
        }
        Item::Dot { at, form, colour, size } => {
            let [x, y] = place(*at);
            let corners: Vec<[f64; 2]> = match form {
                Form::Disc => {
                    (0..32).map(|i| f64::from(i) * std::f64::consts::TAU / 32.0).map(|t| [t.cos(), t.sin()]).collect()
                }
                Form::Square => vec![[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]],
                Form::Triangle => vec![[-1.1, 0.75], [0.0, -1.2], [1.1, 0.75]],
            };
            let points = corners.iter().map(|[dx, dy]| [x + size * dx, y + size * dy]).collect();
            drawing.shapes.push(VectorShape::Polygon { points, fill: *colour, stroke: Some((style::PAPER, 2.0)) });
        }
        Item::Label { at, shift, text, covering } => {
            let [x, y] = place(*at);
            let middle = [x + shift[0], y - shift[1]];
            if *covering {
                let half = [text::width(text, style::TEXT) / 2.0 + 4.0, 0.5 * style::TEXT];
                let [low, high] = [-1.0, 1.0].map(|side| [0, 1].map(|k| middle[k] + side * half[k]));
                drawing.rectangle(low, high, style::PAPER);
            }
            drawing.text(middle, TextAnchor::Middle, style::TEXT, text.as_str());
        }
    }
}

/// Draws a head at the last point and shortens the line so that it ends inside the head.
fn arrow_head(points: &mut [[f64; 2]], colour: Colour, width: f64, drawing: &mut Drawing) {
    let [.., before, tip] = points else { return };
    let (dx, dy) = (tip[0] - before[0], tip[1] - before[1]);
    let whole = dx.hypot(dy);
    if whole == 0.0 {
        return;
    }
    let length = (HEAD[0] * width).max(HEAD[2]).min(whole);
    let half = length * HEAD[1] / HEAD[0];
    let (ux, uy) = (dx / whole, dy / whole);
    let foot = [tip[0] - length * ux, tip[1] - length * uy];
    let corners = vec![*tip, [foot[0] - half * uy, foot[1] + half * ux], [foot[0] + half * uy, foot[1] - half * ux]];
    drawing.shapes.push(VectorShape::Polygon { points: corners, fill: colour, stroke: None });
    *tip = [tip[0] - 0.9 * length * ux, tip[1] - 0.9 * length * uy];
}

/// Returns the dashes of a dashed line.
fn dashes(points: &[[f64; 2]]) -> Vec<[[f64; 2]; 2]> {
    let period = DASH[0] + DASH[1];
    let (mut pieces, mut done) = (Vec::new(), 0.0);
    for pair in points.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let at = |s: f64| [0, 1].map(|k| a[k] + (b[k] - a[k]) * (s / length).clamp(0.0, 1.0));
        // Dashes begin at multiples of the period along the whole line.
        let first = (done / period).floor() as usize;
        let last = ((done + length) / period).ceil() as usize;
        for i in first..last {
            let begin = (i as f64 * period - done).max(0.0);
            let end = (i as f64 * period + DASH[0] - done).min(length);
            if begin < end {
                pieces.push([at(begin), at(end)]);
            }
        }
        done += length;
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dashes_cover_their_share_of_a_line_and_lie_on_it() {
        let points = [[0.0, 0.0], [300.0, 0.0], [300.0, 120.0]];
        let pieces = dashes(&points);
        let length: f64 = pieces.iter().map(|[a, b]| (b[0] - a[0]).hypot(b[1] - a[1])).sum();
        // Exactly 20 periods of length 21.
        assert!((length - 20.0 * DASH[0]).abs() < 1e-9, "{length}");
        assert!(pieces.iter().flatten().all(|[x, y]| (*y == 0.0 && *x <= 300.0) || *x == 300.0));
    }

    #[test]
    fn what_has_no_place_on_paper_is_refused() {
        let panel = |points: Vec<[f64; 2]>| Panel {
            title: "A".to_owned(),
            items: vec![Item::Line { points, colour: style::INK, width: 2.0, style: LineStyle::Solid }],
        };
        let render = |panels| Diagram { panels, columns: 2, caption: String::new() }.render(Format::Svg);
        assert!(matches!(render(vec![]), Err(FigureError::NoPanels)));
        assert!(matches!(render(vec![panel(vec![[1.0, 1.0]; 2])]), Err(FigureError::PanelExtent { .. })));
        assert!(matches!(render(vec![panel(vec![[1.0, f64::NAN]; 2])]), Err(FigureError::PanelPoint { .. })));
        assert!(render(vec![panel(vec![[1.0, 1.0], [2.0, 1.0]])]).is_ok());
    }
}
