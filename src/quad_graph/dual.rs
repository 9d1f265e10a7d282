//! The position of the dual vertex of a triangle. A new dual point is one implementation and one
//! row of [`DUAL_POINTS`].

/// A point of a triangle that depends only on the edge lengths (intrinsic).
pub trait DualPoint: Sync {
    /// The name, as used in options.
    fn name(&self) -> &'static str;

    /// A description of one line.
    fn description(&self) -> &'static str;

    /// Returns barycentric weights of the point, not necessarily normalised, from the lengths of
    /// the edges opposite the three vertices. It must be a symmetric function of the triangle.
    fn weights(&self, lengths: [f64; 3]) -> [f64; 3];

    /// Returns the point in coordinates in which an edge runs from 0 to 1 and the third vertex is
    /// `t + iu` with u > 0: real and imaginary part.
    fn place(&self, t: f64, u: f64) -> (f64, f64) {
        let [w0, w1, w2] = self.weights([(1.0 - t).hypot(u), t.hypot(u), 1.0]);
        let total = w0 + w1 + w2;
        ((w1 + w2 * t) / total, w2 * u / total)
    }
}

/// The table of all dual points; the first is the default.
pub static DUAL_POINTS: &[&dyn DualPoint] = &[&Barycentre, &Circumcentre, &Incentre];

/// Returns the dual point with this name.
pub fn dual_point(name: &str) -> Option<&'static dyn DualPoint> {
    DUAL_POINTS.iter().copied().find(|d| d.name() == name)
}

/// The mean of the vertices; Re ρ > 0 on every mesh.
pub struct Barycentre;

impl DualPoint for Barycentre {
    fn name(&self) -> &'static str {
        "barycentre"
    }

    fn description(&self) -> &'static str {
        "mean of the vertices; Re ρ > 0 on every mesh"
    }

    fn weights(&self, _lengths: [f64; 3]) -> [f64; 3] {
        [1.0; 3]
    }

    // The same, without the lengths.
    fn place(&self, t: f64, u: f64) -> (f64, f64) {
        ((1.0 + t) / 3.0, u / 3.0)
    }
}

/// The centre of the circumscribed circle.
///
/// From an edge with opposite angle γ it is at `½ + ½ i cot γ`, hence ρ = ½(cot α + cot β), which
/// is real, and negative if α + β > π (§2.3 of the paper, corrected by the factor ½).
pub struct Circumcentre;

impl DualPoint for Circumcentre {
    fn name(&self) -> &'static str {
        "circumcentre"
    }

    fn description(&self) -> &'static str {
        "centre of the circumscribed circle; ρ = ½(cot α + cot β), the cotan weights; Re ρ < 0 across obtuse pairs"
    }

    fn weights(&self, [a, b, c]: [f64; 3]) -> [f64; 3] {
        let (a, b, c) = (a * a, b * b, c * c);
        [a * (b + c - a), b * (c + a - b), c * (a + b - c)]
    }

    // In flat triangles the weights cancel. This formula does not, and makes Im ρ exactly 0.
    fn place(&self, t: f64, u: f64) -> (f64, f64) {
        (0.5, (u * u - t * (1.0 - t)) / (2.0 * u))
    }
}

/// The centre of the inscribed circle.
pub struct Incentre;

impl DualPoint for Incentre {
    fn name(&self) -> &'static str {
        "incentre"
    }

    fn description(&self) -> &'static str {
        "centre of the inscribed circle; Re ρ > 0 on every mesh"
    }

    fn weights(&self, lengths: [f64; 3]) -> [f64; 3] {
        lengths
    }
}

/// The position of the dual vertex of a boundary edge.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BoundaryDual {
    /// The midpoint of the edge.
    #[default]
    Midpoint,
    /// The foot of the perpendicular from the face's dual point.
    Foot,
}
