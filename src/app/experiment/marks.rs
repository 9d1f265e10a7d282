use serde::Deserialize;
use serde_json::{Value, json};

use crate::distortion::{FaceMap, corner_errors, quasi_conformal_errors};
use crate::map::Mapped;

/// The choice of faces that are drawn red: `figures.mark` of an experiment.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mark {
    /// Faces whose error exceeds this number (> 1) are marked.
    pub above: f64,
    /// The error that is measured.
    #[serde(default)]
    pub by: Measure,
}

/// A quasi-conformal error σ1/σ2 per face.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Measure {
    /// That of the face's map, of a quad by its diagonals: 1 where (2) holds.
    #[default]
    Face,
    /// The largest of the triangles at a quad's corners: 1 where its shape is kept, angles and all.
    Corners,
}

/// The error of every face of a map, and which of them are marked.
#[derive(Clone, Debug, PartialEq)]
pub struct Marks {
    mark: Mark,
    /// The error of every face; negative where it is flipped.
    pub(super) errors: Vec<f64>,
}

impl Marks {
    /// Measures the faces of a map.
    pub fn of(mapped: &Mapped, maps: &[FaceMap], mark: Mark) -> Self {
        let errors = match mark.by {
            Measure::Face => quasi_conformal_errors(maps),
            Measure::Corners => {
                corner_errors(&mapped.domain.disc, mapped.domain.planes.as_ref(), &mapped.image(), maps)
            }
        };
        Marks { mark, errors }
    }

    /// The upper end of the scale.
    pub fn above(&self) -> f64 {
        self.mark.above
    }

    /// The label of the colour bar.
    pub fn label(&self) -> &'static str {
        match self.mark.by {
            Measure::Face => "quasi-conformal error σ₁/σ₂",
            Measure::Corners => "σ₁/σ₂ at the worst corner",
        }
    }

    /// The marked faces, flipped ones included.
    pub fn faces(&self) -> Vec<usize> {
        let large = |e: f64| e < 0.0 || e > self.mark.above;
        (0..self.errors.len()).filter(|&f| large(self.errors[f])).collect()
    }

    /// The entry in a record: `above`, number and share of the marked `faces`, `median` and `max`
    /// of the errors of all faces that are neither flipped nor collapsed.
    pub fn record(&self) -> Value {
        let faces = self.faces().len();
        // Rounding may have put σ1/σ2 below 1.
        let mut upright: Vec<f64> = self.errors.iter().copied().filter(|e| (0.0..f64::INFINITY).contains(e)).collect();
        upright.sort_unstable_by(f64::total_cmp);
        json!({
            "above": self.mark.above,
            "faces": faces,
            "percent": 100.0 * faces as f64 / self.errors.len().max(1) as f64,
            "median": upright.get(upright.len() / 2),
            "max": upright.last(),
        })
    }
}
