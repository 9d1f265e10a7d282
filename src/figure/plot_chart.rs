use plotters::chart::ChartBuilder;
use plotters::drawing::IntoDrawingArea;
use plotters::series::{DashedLineSeries, LineSeries};
use plotters::style::{Color, IntoFont, RGBColor, ShapeStyle};

use super::colour::Colour;
use super::drawing::{Anchor, Drawing};
use super::plot::medians;
use super::plot_axis::Ruler;
use super::plot_backend::{Sheet, fine, place};
use super::plot_marker::{Marker, RADIUS};
use super::raster::{blank_sheet, encode_png};
use super::{FigureError, Format, Plot, style, text};

/// The plot area within its frame.
const AREA: [f64; 2] = [1040.0, 780.0];
/// Width of the lines between points.
const CURVE: f64 = 3.0;
/// Of reference lines: width, dash, gap.
const REFERENCE: [f64; 3] = [2.5, 12.0, 8.0];
/// Length of a tick; labels stand as far behind it.
const TICK: f64 = 8.0;
/// Length of the piece of line in the legend.
const SAMPLE: f64 = 56.0;
/// From one row of the legend to the next.
const ROW: f64 = 42.0;
/// From the frame to the legend.
const DISTANCE: f64 = 36.0;
/// The grid: lines with and without a label.
const GRID: [Colour; 2] = [Colour([206, 208, 212]), Colour([234, 235, 238])];
const REFERENCE_COLOUR: Colour = Colour([110, 112, 118]);

/// Where things stand on the sheet. Pixels.
struct Layout {
    title: Vec<String>,
    corner: [f64; 2],
    size: [f64; 2],
}

pub(super) fn render(plot: &Plot, format: Format) -> Result<Vec<u8>, FigureError> {
    let points = plot.visible();
    let all: Vec<[f64; 2]> = points.iter().flatten().copied().collect();
    for reference in &plot.references {
        if reference.slope != 0.0 && !(plot.x.log && plot.y.log) {
            return Err(FigureError::Slope { label: reference.label.clone() });
        }
    }
    let x = Ruler::around(all.iter().map(|p| p[0]), plot.x.log)?;
    let ends = [all.iter().map(|p| p[0]).fold(f64::INFINITY, f64::min), all.iter().map(|p| p[0]).fold(0.0, f64::max)];
    let lines: Vec<[[f64; 2]; 2]> = plot.references.iter().map(|r| ends.map(|x| [x, r.at(&all, x)])).collect();
    let on_lines = lines.iter().flatten().map(|p| p[1]).filter(|y| y.is_finite() && (!plot.y.log || *y > 0.0));
    let y = Ruler::around(all.iter().map(|p| p[1]).chain(on_lines), plot.y.log)?;

    let mut drawing = Drawing::default();
    let layout = Layout::new(plot, &y);
    let markers = chart(plot, &points, &lines, (x, y), &layout, &mut drawing)?;
    drawing.frame(layout.corner, [layout.corner[0] + AREA[0], layout.corner[1] + AREA[1]]);
    for (marker, at) in markers {
        marker.draw(at, &mut drawing);
    }
    surroundings(plot, &layout, &mut drawing);
    let [width, height] = layout.size.map(|s| s as u32);
    match format {
        Format::Svg => Ok(drawing.to_svg(width, height).into_bytes()),
        Format::Png => {
            let mut sheet = blank_sheet(width, height)?;
            drawing.paint(&mut sheet, 1);
            encode_png(&sheet, 1)
        }
    }
}

impl Layout {
    fn new(plot: &Plot, y: &Ruler) -> Layout {
        let widest = |labels: &mut dyn Iterator<Item = &str>, size| {
            style::WIDER_FONT * labels.map(|label| text::width(label, size)).fold(0.0, f64::max)
        };
        let left =
            style::MARGIN + 1.2 * style::TEXT + style::GAP + widest(&mut y.labels(), style::SMALL_TEXT) + 2.0 * TICK;
        let names =
            plot.series.iter().map(|s| s.label.as_str()).chain(plot.references.iter().map(|r| r.label.as_str()));
        let names: Vec<&str> = names.collect();
        let legend = match names.len() {
            0 => 0.0,
            _ => DISTANCE + SAMPLE + style::GAP + widest(&mut names.into_iter(), style::SMALL_TEXT),
        };
        let width = (left + AREA[0] + legend.max(style::MARGIN) + style::MARGIN).ceil();
        let title = text::wrap(&plot.title, style::TITLE, (width - 2.0 * style::MARGIN) / style::WIDER_FONT, 2);
        let above = title.len() as f64 * style::TITLE_LINE + if title.is_empty() { 0.0 } else { style::GAP };
        let top = (style::MARGIN + above).ceil();
        let below = 2.0 * TICK + style::SMALL_TEXT + style::GAP + 1.2 * style::TEXT;
        let height = (top + AREA[1] + below + style::MARGIN).ceil();
        Layout { title, corner: [left.ceil(), top], size: [width, height] }
    }
}

fn stroke(Colour([r, g, b]): Colour, width: f64) -> ShapeStyle {
    RGBColor(r, g, b).stroke_width(fine(width).unsigned_abs())
}

/// What plotters draws: grid, axes, lines. Returns the markers with their places.
fn chart(
    plot: &Plot,
    points: &[Vec<[f64; 2]>],
    lines: &[[[f64; 2]; 2]],
    (x, y): (Ruler, Ruler),
    layout: &Layout,
    drawing: &mut Drawing,
) -> Result<Vec<(Marker, [f64; 2])>, FigureError> {
    let Layout { corner, size, .. } = layout;
    let root = Sheet { drawing, size: *size }.into_drawing_area();
    let below = size[1] - style::MARGIN - corner[1] - AREA[1];
    let mut chart = ChartBuilder::on(&root)
        .margin_left(fine(style::MARGIN))
        .margin_top(fine(corner[1]))
        .margin_right(fine(size[0] - corner[0] - AREA[0]))
        .margin_bottom(fine(style::MARGIN))
        .y_label_area_size(fine(corner[0] - style::MARGIN))
        .x_label_area_size(fine(below))
        .build_cartesian_2d(x, y)?;
    let Colour([r, g, b]) = style::INK;
    let font = |size: f64| ("Inter", size * super::plot_backend::FINE).into_font().color(&RGBColor(r, g, b));
    chart
        .configure_mesh()
        .axis_style(stroke(style::INK, style::LINE))
        .bold_line_style(stroke(GRID[0], 1.5))
        .light_line_style(stroke(GRID[1], 1.2))
        .label_style(font(style::SMALL_TEXT))
        .axis_desc_style(font(style::TEXT))
        .set_all_tick_mark_size(fine(TICK))
        .x_desc(plot.x.label.as_str())
        .y_desc(plot.y.label.as_str())
        .draw()?;
    let [width, dash, gap] = REFERENCE;
    for line in lines {
        let ends = line.map(|[x, y]| (x, y));
        let style = stroke(REFERENCE_COLOUR, width);
        chart.draw_series(DashedLineSeries::new(ends, fine(dash).unsigned_abs(), fine(gap).unsigned_abs(), style))?;
    }
    for (i, series) in points.iter().enumerate().filter(|(i, _)| !plot.series[*i].cloud) {
        let curve = stroke(Marker::of(i).colour, CURVE);
        chart.draw_series(LineSeries::new(medians(series).into_iter().map(|p| (p[0], p[1])), curve))?;
    }
    let area = chart.plotting_area();
    let mark = |i: usize, p: &[f64; 2]| (Marker::of(i), place(area.map_coordinate(&(p[0], p[1]))));
    Ok(points.iter().enumerate().flat_map(|(i, series)| series.iter().map(move |p| mark(i, p))).collect())
}

/// Title and legend.
fn surroundings(plot: &Plot, layout: &Layout, drawing: &mut Drawing) {
    let [left, top] = layout.corner;
    let widest = layout.title.iter().map(|line| text::width(line, style::TITLE)).fold(0.0, f64::max);
    let half = style::MARGIN + style::WIDER_FONT * widest / 2.0;
    let x = (left + AREA[0] / 2.0).min(layout.size[0] - half).max(half);
    for (i, line) in layout.title.iter().enumerate() {
        let y = style::MARGIN + (i as f64 + 0.4) * style::TITLE_LINE;
        drawing.text([x, y], Anchor::Middle, style::TITLE, line.as_str());
    }
    let x = left + AREA[0] + DISTANCE;
    let row = |i: usize| top + RADIUS + (i as f64 + 0.2) * ROW;
    for (i, series) in plot.series.iter().enumerate() {
        let marker = Marker::of(i);
        if !series.cloud {
            drawing.stroke([x, row(i)], [x + SAMPLE, row(i)], marker.colour, CURVE);
        }
        marker.draw([x + SAMPLE / 2.0, row(i)], drawing);
        drawing.text([x + SAMPLE + style::GAP, row(i)], Anchor::Start, style::SMALL_TEXT, series.label.as_str());
    }
    for (i, reference) in plot.references.iter().enumerate() {
        let y = row(plot.series.len() + i);
        let [width, dash, gap] = REFERENCE;
        let mut from = x;
        while from < x + SAMPLE {
            drawing.stroke([from, y], [(from + dash).min(x + SAMPLE), y], REFERENCE_COLOUR, width);
            from += dash + gap;
        }
        drawing.text([x + SAMPLE + style::GAP, y], Anchor::Start, style::SMALL_TEXT, reference.label.as_str());
    }
}
