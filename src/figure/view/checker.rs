use super::super::FigureError;
use super::super::colour::Colour;
use super::super::raster::{blank_sheet, encode_png};
use crate::io::glb::Affine;

/// Colours of the light and dark squares of the checkerboard.
pub(super) const SQUARES: [Colour; 2] = [Colour([250, 243, 224]), Colour([74, 112, 172])];

/// Pixels along a square of [`Checker::tile`]; the blurring of borders by viewers is then below a
/// percent.
const TILE: usize = 256;

/// A checkerboard of the plane: (u, v) = (z − o) / side, and a square is light if ⌊u⌋ + ⌊v⌋ is
/// even.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Checker {
    per_unit: f64,
    origin: [f64; 2],
}

impl Checker {
    /// Makes a checkerboard with about `squares` squares along the longer side of the bounding box
    /// of `points`, beginning in its lower left corner.
    ///
    /// # Errors
    /// No squares; points that have no extent or are not finite.
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

    /// Returns a point of the plane in units of squares.
    pub fn at(&self, z: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| (z[k] - self.origin[k]) * self.per_unit)
    }

    /// Returns [`Checker::at`] as an affine map.
    pub fn affine(&self) -> Affine {
        let k = self.per_unit;
        Affine { matrix: [[k, 0.0], [0.0, k]], origin: self.origin.map(|o| -o * k) }
    }

    /// Returns the period of the pattern, two by two squares, as a PNG file.
    ///
    /// # Errors
    /// Errors of the encoder.
    pub fn tile() -> Result<Vec<u8>, FigureError> {
        let side = 2 * TILE;
        let mut tile = blank_sheet(side as u32, side as u32)?;
        for (i, pixel) in tile.data_mut().chunks_exact_mut(4).enumerate() {
            // Rows count downward, squares upward.
            let (column, row) = (i % side / TILE, 1 - i / side / TILE);
            let Colour(colour) = SQUARES[(column + row) % 2];
            pixel[..3].copy_from_slice(&colour);
        }
        encode_png(&tile, 1)
    }

    /// The map from squares to texture coordinates of [`Checker::tile`]: (u/2, 1 − v/2).
    pub const TO_TILE: Affine = Affine { matrix: [[0.5, 0.0], [0.0, -0.5]], origin: [0.0, 1.0] };
}
