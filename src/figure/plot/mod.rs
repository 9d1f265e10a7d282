mod axis;
mod backend;
mod chart;
mod layout;
mod marker;

use crate::figure::{FigureError, Format};

/// A plot of series of points, lines between them, in the colours of Okabe and Ito with markers of different shapes.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    /// Over the plot; two lines at most, may be empty.
    pub title: String,
    /// What goes right.
    pub x: Axis,
    /// What goes up.
    pub y: Axis,
    /// In the order of the legend.
    pub series: Vec<Series>,
    /// Dashed lines to compare slopes and levels with; they follow the series in the legend.
    pub references: Vec<Reference>,
}

/// Plots of one kind beside each other: they share the legend, panels above each other the x axis, panels beside each other
/// the y axis. A single one is drawn as a [`Plot`] is.
#[derive(Clone, Debug, PartialEq)]
pub struct Panels {
    /// Over all of them; each has its own title too, unless it is the only one.
    pub title: String,
    /// Row by row, with the same axes.
    pub plots: Vec<Plot>,
    /// How many stand beside each other.
    pub columns: usize,
}

impl Panels {
    /// The panels as the bytes of a file.
    ///
    /// # Errors
    /// As [`Plot::render`]; a column or row without a single point.
    pub fn render(&self, format: Format) -> Result<Vec<u8>, FigureError> {
        chart::render(self, format)
    }
}

/// An axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What stands beside it.
    pub label: String,
    /// Logarithmic: values that are not positive have no place on it and are left out.
    pub log: bool,
}

/// Points that belong together; unless they are a cloud they are joined in order of x, through the median of those at one x.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name in the legend.
    pub label: String,
    /// (x, y); points that are not finite are left out.
    pub points: Vec<[f64; 2]>,
    /// Whether there is no line.
    pub cloud: bool,
}

/// The line y = c x^slope.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// Name in the legend.
    pub label: String,
    /// The exponent. Both axes must be logarithmic unless it is 0.
    pub slope: f64,
    /// A point of the line; without one it runs just below all points.
    pub through: Option<[f64; 2]>,
}

impl Plot {
    /// The plot as the bytes of a file.
    ///
    /// # Errors
    /// [`FigureError::NoPoints`] where nothing is left to draw; [`FigureError::Slope`] for a slope on an axis that is not
    /// logarithmic; [`FigureError::PlotRange`] for values that floating point cannot lay on paper.
    pub fn render(&self, format: Format) -> Result<Vec<u8>, FigureError> {
        Panels { title: self.title.clone(), plots: vec![self.clone()], columns: 1 }.render(format)
    }

    /// The points that have a place on both axes, series by series, in order of x.
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

/// Where the line of a series runs, its points in the order of x: through the median of those at one x.
pub(super) fn medians(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let median = |at: &[[f64; 2]]| {
        let mut values: Vec<f64> = at.iter().map(|p| p[1]).collect();
        values.sort_by(f64::total_cmp);
        // Of an even number the lower one: a point that is there.
        [at[0][0], values[(values.len() - 1) / 2]]
    };
    points.chunk_by(|a, b| a[0] == b[0]).map(median).collect()
}

impl Reference {
    /// y = c x^slope at `x`, given the points of the plot.
    pub(super) fn at(&self, points: &[[f64; 2]], x: f64) -> f64 {
        /// How far below the lowest point a line without a point of its own runs.
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
