//! The content of plots: series of points, axes and reference lines.

/// A plot of series of points and lines between them, with the colours of Okabe and Ito and markers
/// of different shapes.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    /// Title above the plot; at most two lines, possibly empty.
    pub title: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// The series, in the order of the legend.
    pub series: Vec<Series>,
    /// Dashed lines for comparison with slopes and levels; they follow the series in the legend.
    pub references: Vec<Reference>,
}

/// Plots of one kind in a grid. They share the legend; columns share the x axis and rows the y
/// axis.
///
/// A single one is drawn like a [`Plot`].
#[derive(Clone, Debug, PartialEq)]
pub struct Panels {
    /// Title above all panels; each also has its own title unless it is the only one.
    pub title: String,
    /// The plots, row by row, with the same axes.
    pub plots: Vec<Plot>,
    /// Number of columns.
    pub columns: usize,
}

/// An axis of a plot.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The label.
    pub label: String,
    /// Whether the axis is logarithmic; values that are not positive are then omitted.
    pub log: bool,
}

/// The points of one series. Unless they are a cloud, a line joins them in order of x through the
/// median of the points with equal x.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Label in the legend.
    pub label: String,
    /// The points (x, y); those that are not finite are omitted.
    pub points: Vec<[f64; 2]>,
    /// Whether the points are not joined by a line.
    pub cloud: bool,
}

/// The line y = c x^slope.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// Label in the legend.
    pub label: String,
    /// The exponent. Both axes must be logarithmic unless it is 0.
    pub slope: f64,
    /// A point of the line; without one it runs just below all points.
    pub through: Option<[f64; 2]>,
}

impl Plot {
    /// Returns the points that can be shown on both axes, series by series, in order of x.
    pub(super) fn visible(&self) -> Vec<Vec<[f64; 2]>> {
        let shown = |log: bool, v: f64| v.is_finite() && (!log || v > 0.0);
        let visible = |series: &Series| {
            let points = series.points.iter().filter(|p| shown(self.x.log, p[0]) && shown(self.y.log, p[1]));
            let mut points: Vec<[f64; 2]> = points.copied().collect();
            points.sort_by(|a, b| a[0].total_cmp(&b[0]));
            points
        };
        self.series.iter().map(visible).collect()
    }
}

/// Returns the vertices of the line of a series, whose points are in order of x: for each x the
/// median of its points.
pub(super) fn medians(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let median = |at: &[[f64; 2]]| {
        let mut values: Vec<f64> = at.iter().map(|p| p[1]).collect();
        values.sort_by(f64::total_cmp);
        // For an even number the lower of the two, which is one of the points.
        [at[0][0], values[(values.len() - 1) / 2]]
    };
    points.chunk_by(|a, b| a[0] == b[0]).map(median).collect()
}

impl Reference {
    /// Evaluates y = c x^slope at `x`, given the points of the plot.
    pub(super) fn at(&self, points: &[[f64; 2]], x: f64) -> f64 {
        /// Ratio of the line to the lowest point if it has no point of its own.
        const BELOW: f64 = 0.6;
        let constant = |p: &[f64; 2]| p[1] / p[0].powf(self.slope);
        let c = match &self.through {
            Some(point) => constant(point),
            None => BELOW * points.iter().map(constant).fold(f64::INFINITY, f64::min),
        };
        c * x.powf(self.slope)
    }
}

#[cfg(test)]
mod tests {
    use super::medians;

    #[test]
    fn lines_run_through_medians_and_single_points() {
        let points = [[1.0, 5.0], [1.0, 2.0], [1.0, 9.0], [2.0, 4.0], [3.0, 8.0], [3.0, 6.0]];
        assert_eq!(medians(&points), [[1.0, 5.0], [2.0, 4.0], [3.0, 6.0]]);
        assert!(medians(&[]).is_empty());
    }
}
