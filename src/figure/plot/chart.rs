use plotters::chart::ChartBuilder;
use plotters::drawing::IntoDrawingArea;
use plotters::series::{DashedLineSeries, LineSeries};
use plotters::style::{Color, IntoFont, RGBColor, ShapeStyle};

use crate::figure::colour::Colour;
use crate::figure::drawing::Drawing;
use crate::figure::plot::axis::Ruler;
use crate::figure::plot::backend::{PlotSheet, fine, place};
use crate::figure::plot::layout::{CURVE, PlotLayout, REFERENCE, REFERENCE_COLOUR, TICK};
use crate::figure::plot::marker::{Marker, some_of};
use crate::figure::plot::series::{Panels, Plot, medians};
use crate::figure::raster::{blank_sheet, encode_png};
use crate::figure::{FigureError, Format, style};

/// Colours of grid lines with and without a label.
const GRID: [Colour; 2] = [Colour([206, 208, 212]), Colour([234, 235, 238])];

/// The visible points of a series, in order of x.
struct VisiblePoints {
    /// Its index in the legend.
    place: usize,
    at: Vec<[f64; 2]>,
    cloud: bool,
}

/// The points and reference lines of a panel.
struct PanelContent {
    points: Vec<VisiblePoints>,
    lines: Vec<[[f64; 2]; 2]>,
}

pub(super) fn render(panels: &Panels, format: Format) -> Result<Vec<u8>, FigureError> {
    let mut series: Vec<&str> = Vec::new();
    for label in panels.plots.iter().flat_map(|plot| plot.series.iter().map(|s| s.label.as_str())) {
        if !series.contains(&label) {
            series.push(label);
        }
    }
    let contents: Vec<PanelContent> =
        panels.plots.iter().map(|plot| PanelContent::of(plot, &series)).collect::<Result<_, _>>()?;
    let columns = panels.columns.clamp(1, panels.plots.len().max(1));
    // The panels of a column share the x axis, those of a row the y axis.
    let in_column = |c: usize| panels.plots.iter().zip(&contents).skip(c).step_by(columns);
    let x: Vec<Ruler> = (0..columns.min(contents.len()))
        .map(|c| {
            let values = in_column(c).flat_map(|(_, content)| content.values(0));
            Ruler::around(values, in_column(c).any(|(plot, _)| plot.x.log))
        })
        .collect::<Result<_, _>>()?;
    let y: Vec<Ruler> = panels
        .plots
        .chunks(columns)
        .zip(contents.chunks(columns))
        .map(|(plots, contents)| {
            let log = plots.iter().any(|plot| plot.y.log);
            let values = contents.iter().flat_map(|c| c.values(1).chain(c.on_lines(log)));
            Ruler::around(values, log)
        })
        .collect::<Result<_, _>>()?;
    if contents.is_empty() {
        return Err(FigureError::NoPoints);
    }

    let mut drawing = Drawing::default();
    let layout = PlotLayout::new(panels, &series, &y);
    for (k, (plot, content)) in panels.plots.iter().zip(&contents).enumerate() {
        let (row, column) = (k / columns, k % columns);
        let inner = PanelPlace {
            corner: layout.corner(k),
            has_x_labels: k + columns >= contents.len(),
            has_y_labels: column == 0,
            is_single: contents.len() == 1,
        };
        let markers = chart(plot, content, (x[column].clone(), y[row].clone()), &layout, &inner, &mut drawing)?;
        let [left, top] = inner.corner;
        drawing.frame(inner.corner, [left + layout.area[0], top + layout.area[1]]);
        for (marker, at) in markers {
            marker.draw(at, &mut drawing);
        }
    }
    layout.titles(panels, &mut drawing);
    layout.legend(&mut drawing);
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

impl PanelContent {
    fn of(plot: &Plot, series: &[&str]) -> Result<PanelContent, FigureError> {
        for reference in &plot.references {
            if reference.slope != 0.0 && !(plot.x.log && plot.y.log) {
                return Err(FigureError::Slope { label: reference.label.clone() });
            }
        }
        let place = |label: &str| series.iter().position(|s| *s == label).unwrap_or_default();
        let visible = plot.series.iter().zip(plot.visible());
        let points = visible.map(|(s, at)| VisiblePoints { place: place(&s.label), at, cloud: s.cloud }).collect();
        let mut content = PanelContent { points, lines: Vec::new() };
        let all: Vec<[f64; 2]> = content.points.iter().flat_map(|points| &points.at).copied().collect();
        let ends =
            [all.iter().map(|p| p[0]).fold(f64::INFINITY, f64::min), all.iter().map(|p| p[0]).fold(0.0, f64::max)];
        content.lines = plot.references.iter().map(|r| ends.map(|x| [x, r.at(&all, x)])).collect();
        Ok(content)
    }

    fn values(&self, axis: usize) -> impl Iterator<Item = f64> + Clone {
        self.points.iter().flat_map(move |points| points.at.iter().map(move |p| p[axis]))
    }

    fn on_lines(&self, log: bool) -> impl Iterator<Item = f64> + Clone {
        self.lines.iter().flatten().map(|p| p[1]).filter(move |y| y.is_finite() && (!log || *y > 0.0))
    }
}

fn stroke(Colour([r, g, b]): Colour, width: f64) -> ShapeStyle {
    RGBColor(r, g, b).stroke_width(fine(width).unsigned_abs())
}

/// The position of a panel and its labels.
struct PanelPlace {
    corner: [f64; 2],
    has_x_labels: bool,
    has_y_labels: bool,
    is_single: bool,
}

/// Draws the parts for which plotters is used: grid, axes, lines. Returns the markers with their
/// positions.
fn chart(
    plot: &Plot,
    content: &PanelContent,
    (x, y): (Ruler, Ruler),
    layout: &PlotLayout,
    panel: &PanelPlace,
    drawing: &mut Drawing,
) -> Result<Vec<(Marker, [f64; 2])>, FigureError> {
    let (corner, area, size) = (panel.corner, layout.area, layout.size);
    let root = PlotSheet { drawing, size }.into_drawing_area();
    // Labels of axes shared by panels are drawn elsewhere.
    let below = size[1] - style::MARGIN - corner[1] - area[1];
    let below = if panel.is_single { below } else { 2.0 * TICK + style::SMALL_TEXT + style::GAP };
    let below = if panel.has_x_labels { below } else { 0.0 };
    let left = if panel.has_y_labels { corner[0] - style::MARGIN } else { 0.0 };
    let mut chart = ChartBuilder::on(&root)
        .margin_left(fine(corner[0] - left))
        .margin_top(fine(corner[1]))
        .margin_right(fine(size[0] - corner[0] - area[0]))
        .margin_bottom(fine(size[1] - corner[1] - area[1] - below))
        .y_label_area_size(fine(left))
        .x_label_area_size(fine(below))
        .build_cartesian_2d(x, y)?;
    let Colour([r, g, b]) = style::INK;
    let font = |size: f64| ("Inter", size * crate::figure::plot::backend::FINE).into_font().color(&RGBColor(r, g, b));
    let mut mesh = chart.configure_mesh();
    mesh.axis_style(stroke(style::INK, style::LINE))
        .bold_line_style(stroke(GRID[0], 1.5))
        .light_line_style(stroke(GRID[1], 1.2))
        .label_style(font(style::SMALL_TEXT))
        .axis_desc_style(font(style::TEXT))
        .set_all_tick_mark_size(fine(TICK));
    if panel.is_single {
        mesh.x_desc(plot.x.label.as_str()).y_desc(plot.y.label.as_str());
    }
    mesh.draw()?;
    let [width, dash, gap] = REFERENCE;
    for line in &content.lines {
        let ends = line.map(|[x, y]| (x, y));
        let style = stroke(REFERENCE_COLOUR, width);
        chart.draw_series(DashedLineSeries::new(ends, fine(dash).unsigned_abs(), fine(gap).unsigned_abs(), style))?;
    }
    for VisiblePoints { place, at, .. } in content.points.iter().filter(|points| !points.cloud) {
        let curve = stroke(Marker::of(*place).colour, CURVE);
        chart.draw_series(LineSeries::new(medians(at).into_iter().map(|p| (p[0], p[1])), curve))?;
    }
    let area = chart.plotting_area();
    let mut markers = Vec::new();
    for VisiblePoints { place: i, at, cloud } in &content.points {
        let places: Vec<[f64; 2]> = at.iter().map(|p| place(area.map_coordinate(&(p[0], p[1])))).collect();
        let is_curve = !cloud && medians(at).len() == at.len();
        let places = if is_curve { some_of(*i, &places) } else { places };
        markers.extend(places.into_iter().map(|at| (Marker::of(*i), at)));
    }
    Ok(markers)
}
