//! Plots of series of points on linear or logarithmic axes.

mod axis;
mod backend;
mod chart;
mod layout;
mod marker;
mod series;

use crate::figure::{FigureError, Format};
pub use series::{Axis, Panels, Plot, Reference, Series};

impl Panels {
    /// Renders the panels to the bytes of a file.
    ///
    /// # Errors
    /// As for [`Plot::render`]; a column or row without any point.
    pub fn render(&self, format: Format) -> Result<Vec<u8>, FigureError> {
        chart::render(self, format)
    }
}

impl Plot {
    /// Renders the plot to the bytes of a file.
    ///
    /// # Errors
    /// [`FigureError::NoPoints`] if no point can be shown; [`FigureError::Slope`] for a slope
    /// without logarithmic axes; [`FigureError::PlotRange`] for a range that cannot be scaled in
    /// floating point.
    pub fn render(&self, format: Format) -> Result<Vec<u8>, FigureError> {
        Panels { title: self.title.clone(), plots: vec![self.clone()], columns: 1 }.render(format)
    }
}
