use serde::Deserialize;
use serde_json::{Value, json};

use crate::distortion::{FaceMap, corner_errors, quasi_conformal_errors};
use crate::map::Mapped;

/// Which faces are drawn red; `figures.mark` of an experiment.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mark {
    /// Those whose error exceeds this (> 1).
    pub above: f64,
    /// What is measured.
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
    /// Negative where a face is turned over.
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

    /// Where the scale ends.
    pub fn above(&self) -> f64 {
        self.mark.above
    }

    /// Beside the colour bar.
    pub fn label(&self) -> &'static str {
        match self.mark.by {
            Measure::Face => "quasi-conformal error σ₁/σ₂",
            Measure::Corners => "σ₁/σ₂ at the worst corner",
        }
    }

    /// The marked faces: those that are turned over are among them.
    pub fn faces(&self) -> Vec<usize> {
        let large = |e: f64| e < 0.0 || e > self.mark.above;
        (0..self.errors.len()).filter(|&f| large(self.errors[f])).collect()
    }

    /// What a record says of them: `above`, number and share of the marked `faces`, `median` and `max` of the errors of all that
    /// are not turned over or collapsed.
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
