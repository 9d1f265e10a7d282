use super::super::FigureError;

/// The plane measured in squares: (u, v) = (z − o) / side, a square being light where ⌊u⌋ + ⌊v⌋ is even.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Checker {
    per_unit: f64,
    origin: [f64; 2],
}

impl Checker {
    /// About `squares` squares along the longer side of the box around `points`, beginning in its lower left corner.
    ///
    /// # Errors
    /// No squares; points that have no extent, or are not finite.
    pub fn across(points: impl IntoIterator<Item = [f64; 2]>, squares: usize) -> Result<Checker, FigureError> {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for p in points {
            low = [0, 1].map(|k| low[k].min(p[k]));
            high = [0, 1].map(|k| high[k].max(p[k]));
        }
        let (width, height) = (high[0] - low[0], high[1] - low[1]);
        let scale = squares as f64 / width.max(height);
        if !(scale.is_finite() && scale > 0.0) {
            return Err(FigureError::Squares { squares, width, height });
        }
        Ok(Checker { per_unit: scale, origin: low })
    }

    /// A point of the plane, in squares.
    pub fn at(&self, z: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| (z[k] - self.origin[k]) * self.per_unit)
    }
}
