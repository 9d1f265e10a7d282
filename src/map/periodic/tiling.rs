//! Textures that repeat on the unit square, brought onto a torus without a seam.

use num_complex::Complex64;

use crate::io::glb::Affine;

/// Which texture coordinates a periodic map is written with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Tiling {
    /// The map itself, periods 1 and τ. A texture that repeats on the unit square has a seam along the loop of period τ,
    /// unless τ = i n.
    #[default]
    Conformal,
    /// The map followed by the real linear one that makes both periods whole numbers: see [`whole`].
    Whole,
}

/// A real linear map of the plane that takes 1 and τ to whole numbers n1 and n2, nearly a similarity.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Texture {
    /// N = [[Re n1, Re n2], [Im n1, Im n2]]: the point a + bτ has the texture coordinates N (a, b)ᵀ.
    pub matrix: [[i64; 2]; 2],
    /// σ1/σ2 − 1 of that linear map; 0 for a similarity.
    pub shear: f64,
}

impl Texture {
    /// N (a, b)ᵀ
    pub fn place(&self, [a, b]: [f64; 2]) -> [f64; 2] {
        self.matrix.map(|[p, q]| p as f64 * a + q as f64 * b)
    }

    /// z = a + bτ ↦ N (a, b)ᵀ, on the coordinates of the plane.
    pub fn affine(&self, tau: Complex64) -> Affine {
        // (a, b) = (Re z − Re τ / Im τ · Im z, Im z / Im τ)
        let matrix = self.matrix.map(|[p, q]| [p as f64, (q as f64 - p as f64 * tau.re) / tau.im]);
        Affine { matrix, origin: [0.0; 2] }
    }

    /// The colour of the checkerboard of unit squares at a + bτ: whether the integer parts of N (a, b)ᵀ have an odd sum.
    /// With even sums of the columns, as [`whole`] and [`checker`] make them, it has the periods 1 and τ.
    pub fn is_dark(&self, at: [f64; 2]) -> bool {
        let [s, t] = self.place(at);
        (s.floor() + t.floor()).rem_euclid(2.0) == 1.0
    }

    /// How often the unit square is on the torus, det N.
    pub fn squares(&self) -> f64 {
        let [[a, b], [c, d]] = self.matrix.map(|row| row.map(|x| x as f64));
        a * d - b * c
    }

    /// The periods n1 and, of those with an even sum of parts, the nearest to τ n1.
    ///
    /// `z ↦ αz + βz̄` takes 1 to n1 and τ to n2 where `α = (n2 − τ̄ n1) / (2i Im τ)`, `β = n1 − α`.
    fn new(tau: Complex64, n1: [i64; 2]) -> Self {
        let first = Complex64::new(n1[0] as f64, n1[1] as f64);
        let n2 = nearest_even(tau * first);
        let second = Complex64::new(n2[0] as f64, n2[1] as f64);
        let alpha = (second - tau.conj() * first) / Complex64::new(0.0, 2.0 * tau.im);
        let (alpha, beta) = (alpha.norm(), (first - alpha).norm());
        let shear = if alpha > beta { 2.0 * beta / (alpha - beta) } else { f64::INFINITY };
        Texture { matrix: [[n1[0], n2[0]], [n1[1], n2[1]]], shear }
    }
}

/// The point with integer coordinates of even sum that is nearest to z.
fn nearest_even(z: Complex64) -> [i64; 2] {
    let mut point = [z.re.round(), z.im.round()];
    let off = [z.re - point[0], z.im - point[1]];
    if (point[0] + point[1]).rem_euclid(2.0) == 1.0 {
        let k = usize::from(off[1].abs() > off[0].abs());
        point[k] += if off[k] < 0.0 { -1.0 } else { 1.0 };
    }
    point.map(|x| x as i64)
}

/// The most shear of [`whole`].
pub const ACCEPTED_SHEAR: f64 = 0.05;

/// n1 up to this length: n2 is within 1 of τ n1, hence the shear within about 1/(|n1| Im τ), and Im τ ≥ √¾.
const FARTHEST: i64 = 28;

/// The linear map nearest to a similarity that makes both periods whole, so that any texture that repeats on the unit square is
/// continuous on the torus: of those with a shear of at most 5 % the one with the fewest squares. The real and the imaginary part
/// of each period have an even sum, so that a checkerboard of unit squares closes up as well. τ is reduced.
pub fn whole(tau: Complex64) -> Texture {
    let good = candidates(FARTHEST).map(|n1| Texture::new(tau, n1)).filter(|t| t.shear <= ACCEPTED_SHEAR);
    let fewest = good.min_by(|a, b| a.squares().total_cmp(&b.squares()).then(a.shear.total_cmp(&b.shear)));
    fewest.unwrap_or_else(|| Texture::new(tau, [FARTHEST, FARTHEST]))
}

/// The same with about `squares` squares along the period 1, for a checkerboard of nearly square squares. Squares along the periods
/// are preferred to turned ones where the shear does not speak against it. τ is reduced.
pub fn checker(tau: Complex64, squares: u32) -> Texture {
    let wanted = f64::from(squares.clamp(2, 1 << 10));
    let cost = |t: &Texture| {
        let [re, im] = [t.matrix[0][0], t.matrix[1][0]];
        let size = (re as f64).hypot(im as f64) / wanted;
        t.shear + 0.1 * size.ln().abs() + if im == 0 { 0.0 } else { 0.03 }
    };
    let near = candidates((1.3 * wanted).ceil() as i64).map(|n1| Texture::new(tau, n1));
    near.min_by(|a, b| cost(a).total_cmp(&cost(b))).unwrap_or_else(|| Texture::new(tau, [2, 0]))
}

/// Integers p + iq with an even sum, one of each four that turn into each other by i, to a distance.
fn candidates(farthest: i64) -> impl Iterator<Item = [i64; 2]> {
    let all = (1..=farthest).flat_map(move |p| (0..=farthest).map(move |q| [p, q]));
    all.filter(|[p, q]| (p + q) % 2 == 0)
}
