//! The positions of the parts of a plot on its sheet, and its legend.

use crate::figure::colour::Colour;
use crate::figure::drawing::{Drawing, TextAnchor};
use crate::figure::plot::axis::Ruler;
use crate::figure::plot::marker::{Marker, RADIUS};
use crate::figure::plot::series::{Panels, Reference};
use crate::figure::{style, text};

/// Width of the lines between points.
pub(super) const CURVE: f64 = 3.0;
/// Width, dash length and gap length of reference lines.
pub(super) const REFERENCE: [f64; 3] = [2.5, 12.0, 8.0];
/// Length of a tick, and distance from it to its label.
pub(super) const TICK: f64 = 8.0;
/// Colour of reference lines.
pub(super) const REFERENCE_COLOUR: Colour = Colour([110, 112, 118]);
/// Size of the plot area within its frame: of a single plot, of two in a row, of more.
const AREAS: [[f64; 2]; 3] = [[1040.0, 780.0], [760.0, 570.0], [560.0, 440.0]];
/// Distance between panels.
const BETWEEN: f64 = 30.0;
/// Height of a panel's title, including the space above it.
const PANEL_TITLE: f64 = 52.0;
/// Length of the line sample in the legend.
const SAMPLE: f64 = 56.0;
/// Distance between rows of the legend.
const ROW: f64 = 42.0;
/// Distance from the frame to the legend, and between its columns.
const DISTANCE: f64 = 36.0;

/// An entry of the legend; a series has its marker and whether there is a line through it.
#[derive(Clone, Copy)]
pub(super) enum LegendEntry<'a> {
    Series(&'a str, Marker, bool),
    Reference(&'a str),
}

/// Positions and sizes in pixels.
pub(super) struct PlotLayout<'a> {
    title: Vec<String>,
    /// Upper left corner of the first panel.
    corner: [f64; 2],
    /// Size of a panel's plot area.
    pub(super) area: [f64; 2],
    pub(super) size: [f64; 2],
    columns: usize,
    rows: usize,
    legend: Vec<LegendEntry<'a>>,
    /// Upper left corner of the first row of the legend.
    legend_corner: [f64; 2],
    legend_rows: usize,
    entry_width: f64,
}

impl<'a> PlotLayout<'a> {
    pub(super) fn new(panels: &'a Panels, series: &[&'a str], y: &[Ruler]) -> PlotLayout<'a> {
        let single = panels.plots.len() == 1;
        let columns = panels.columns.clamp(1, panels.plots.len().max(1));
        let rows = panels.plots.len().div_ceil(columns);
        let area = AREAS[if single { 0 } else { columns.clamp(2, 3) - 1 }];
        let widest = |labels: &mut dyn Iterator<Item = &str>, size| {
            style::WIDER_FONT * labels.map(|label| text::width(label, size)).fold(0.0, f64::max)
        };
        let labels = widest(&mut y.iter().flat_map(Ruler::labels), style::SMALL_TEXT);
        let left = style::MARGIN + 1.2 * style::TEXT + style::GAP + labels + 2.0 * TICK;
        let legend = entries(panels, series);
        let names = widest(&mut legend.iter().map(LegendEntry::label), style::SMALL_TEXT);
        let entry_width = DISTANCE + SAMPLE + style::GAP + names;
        let across = columns as f64 * (area[0] + BETWEEN) - BETWEEN;
        let down = rows as f64 * (area[1] + PANEL_TITLE) - PANEL_TITLE;
        // Beside a single plot the legend has at most its height; below panels it has at most their
        // width.
        let legend_columns = match single {
            true => legend.len().div_ceil((area[1] / ROW) as usize),
            false => ((across / entry_width) as usize).clamp(1, legend.len().max(1)),
        };
        let legend_rows = legend.len().div_ceil(legend_columns.max(1));
        let beside = if single { legend_columns as f64 * entry_width } else { 0.0 };
        let beside = beside.max(if single { style::MARGIN } else { 0.0 });
        let wanted = if single { across + beside } else { across.max(legend_columns as f64 * entry_width) };
        let width = (left + wanted + style::MARGIN).ceil();
        let title = text::wrap(&panels.title, style::TITLE, (width - 2.0 * style::MARGIN) / style::WIDER_FONT, 2);
        let above = title.len() as f64 * style::TITLE_LINE + if title.is_empty() { 0.0 } else { style::GAP };
        let top = (style::MARGIN + above + if single { 0.0 } else { PANEL_TITLE - style::GAP }).ceil();
        let axis = 2.0 * TICK + style::SMALL_TEXT + style::GAP + 1.2 * style::TEXT;
        let below = if single { 0.0 } else { DISTANCE / 2.0 + legend_rows as f64 * ROW };
        let height = (top + down + axis + below + style::MARGIN).ceil();
        let corner = [left.ceil(), top];
        let legend_corner = match single {
            true => [corner[0] + area[0] + DISTANCE, top],
            false => [corner[0], top + down + axis + DISTANCE / 2.0],
        };
        let size = [width, height];
        PlotLayout { title, corner, area, size, columns, rows, legend, legend_corner, legend_rows, entry_width }
    }

    /// The upper left corner of the k-th panel.
    pub(super) fn corner(&self, k: usize) -> [f64; 2] {
        let [row, column] = [k / self.columns, k % self.columns].map(|i| i as f64);
        [self.corner[0] + column * (self.area[0] + BETWEEN), self.corner[1] + row * (self.area[1] + PANEL_TITLE)]
    }

    /// Draws the titles and the labels of axes that panels share.
    pub(super) fn titles(&self, panels: &Panels, drawing: &mut Drawing) {
        let [left, top] = self.corner;
        let across = self.columns as f64 * (self.area[0] + BETWEEN) - BETWEEN;
        let widest = self.title.iter().map(|line| text::width(line, style::TITLE)).fold(0.0, f64::max);
        let half = style::MARGIN + style::WIDER_FONT * widest / 2.0;
        let x = (left + across / 2.0).min(self.size[0] - half).max(half);
        for (i, line) in self.title.iter().enumerate() {
            let y = style::MARGIN + (i as f64 + 0.4) * style::TITLE_LINE;
            drawing.text([x, y], TextAnchor::Middle, style::TITLE, line.as_str());
        }
        if panels.plots.len() == 1 {
            return;
        }
        for (k, plot) in panels.plots.iter().enumerate() {
            let [x, y] = self.corner(k);
            let line = text::wrap(&plot.title, style::TEXT, self.area[0], 1).pop().unwrap_or_default();
            drawing.text([x + self.area[0] / 2.0, y - 0.75 * style::TEXT], TextAnchor::Middle, style::TEXT, line);
        }
        let down = self.rows as f64 * (self.area[1] + PANEL_TITLE) - PANEL_TITLE;
        if let Some(plot) = panels.plots.first() {
            let below = top + down + 2.0 * TICK + style::SMALL_TEXT + style::GAP + 0.4 * style::TEXT;
            drawing.text([left + across / 2.0, below], TextAnchor::Middle, style::TEXT, plot.x.label.as_str());
            drawing.upward([style::MARGIN + 0.5 * style::TEXT, top + down / 2.0], style::TEXT, plot.y.label.as_str());
        }
    }

    pub(super) fn legend(&self, drawing: &mut Drawing) {
        for (i, entry) in self.legend.iter().enumerate() {
            // Entries run down the columns.
            let (row, column) = (i % self.legend_rows, i / self.legend_rows);
            let x = self.legend_corner[0] + column as f64 * self.entry_width;
            let y = self.legend_corner[1] + RADIUS + (row as f64 + 0.2) * ROW;
            match entry {
                LegendEntry::Series(_, marker, joined) => {
                    if *joined {
                        drawing.stroke([x, y], [x + SAMPLE, y], marker.colour, CURVE);
                    }
                    marker.draw([x + SAMPLE / 2.0, y], drawing);
                }
                LegendEntry::Reference(_) => {
                    let [width, dash, gap] = REFERENCE;
                    let mut from = x;
                    while from < x + SAMPLE {
                        drawing.stroke([from, y], [(from + dash).min(x + SAMPLE), y], REFERENCE_COLOUR, width);
                        from += dash + gap;
                    }
                }
            }
            drawing.text([x + SAMPLE + style::GAP, y], TextAnchor::Start, style::SMALL_TEXT, entry.label());
        }
    }
}

impl LegendEntry<'_> {
    fn label(&self) -> &str {
        match self {
            LegendEntry::Series(label, ..) | LegendEntry::Reference(label) => label,
        }
    }
}

/// Lists the series, then the reference lines; entries common to several panels occur once.
fn entries<'a>(panels: &'a Panels, series: &[&'a str]) -> Vec<LegendEntry<'a>> {
    let all = || panels.plots.iter().flat_map(|plot| &plot.series);
    let joined = |label: &str| all().any(|s| s.label == label && !s.cloud);
    let of_series =
        series.iter().enumerate().map(|(i, label)| LegendEntry::Series(label, Marker::of(i), joined(label)));
    let mut entries: Vec<LegendEntry> = of_series.collect();
    let mut known: Vec<&Reference> = Vec::new();
    for reference in panels.plots.iter().flat_map(|plot| &plot.references) {
        if !known.iter().any(|r| r.label == reference.label) {
            known.push(reference);
            entries.push(LegendEntry::Reference(&reference.label));
        }
    }
    entries
}
