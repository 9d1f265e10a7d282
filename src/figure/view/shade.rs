use super::super::colour::Colour;
use super::super::style;
use super::SurfaceView;
use super::checker::SQUARES;
use super::scene::{EMPTY, FIRST_LINE, Scene, Triangle};
use crate::geometry::vector::{add, dot, norm, scale};

/// [`SQUARES`] of faces with large distortion: [`style::MARK`], and a lighter red.
const RED: [Colour; 2] = [Colour([255, 120, 106]), style::MARK];
/// Factor of the colour on the inner side of an open surface.
const INNER: [f64; 3] = [0.50, 0.42, 0.36];
/// Colours of the line styles.
const LINES: [Colour; 2] = [style::INK, Colour([196, 62, 24])];
pub(super) const OUTLINE: u32 = 0;
pub(super) const SEAM: u32 = 1;
/// Ambient light, and light from the eye, which is weaker toward the silhouette.
const AMBIENT: f64 = 0.17;
const HEAD: f64 = 0.30;
/// Lamps: direction (unit vector; right, upward, towards the eye) and strength.
const LAMPS: [([f64; 3], f64); 2] = [([-0.48, 0.68, 0.555], 0.54), ([0.872, 0.155, 0.464], 0.12)];
/// Wrap-around of the lamps' light, as the cosine of an angle beyond 90°.
const WRAP: f64 = 0.25;
/// Squares per pixel at which the pattern begins to fade, and at which only its mean is left.
const FADE: [f64; 2] = [0.6, 1.2];
/// Opacity of mesh edges.
const EDGE: f64 = 0.55;

/// The marking of a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FaceMark {
    None,
    /// The squares are red, light and dark.
    Red,
    /// The whole face has the colour of flipped faces, unlit.
    Alarm,
}

/// Computes the linear light (red, green, blue) at each sample.
pub(super) struct Shader<'a> {
    pub(super) view: &'a SurfaceView<'a>,
    pub(super) scene: &'a Scene<'a>,
    /// Unit normals in space, one per corner.
    pub(super) normals: &'a [[f64; 3]],
    pub(super) axes: [[f64; 3]; 3],
    /// Whether the normals point to the outer side.
    pub(super) outward: bool,
    /// The marking of each face.
    pub(super) marks: &'a [FaceMark],
    /// Distance, in samples, up to which a mesh edge is visible; 0 if edges are not drawn.
    pub(super) edges: f64,
    /// Samples per pixel along each axis.
    pub(super) samples: f64,
    pub(super) paints: Paints,
}

/// Colours as linear light.
pub(super) struct Paints {
    paper: [f64; 3],
    lines: [[f64; 3]; LINES.len()],
    squares: [[f64; 3]; 2],
    red: [[f64; 3]; 2],
    alarm: [f64; 3],
    edge: [f64; 3],
}

impl Paints {
    pub(super) fn new() -> Paints {
        Paints {
            paper: linear(style::PAPER),
            lines: LINES.map(linear),
            squares: SQUARES.map(linear),
            red: RED.map(linear),
            alarm: linear(style::ALARM),
            edge: linear(style::INK),
        }
    }
}

/// A triangle ready to be shaded.
///
/// Barycentric coordinates in the picture are affine; those in space are their products with
/// nearness, normalised. This makes the pattern correct in perspective.
struct Facet {
    /// The corner that numbers it.
    number: u32,
    places: [[f64; 3]; 3],
    /// Gradients of the barycentric coordinates.
    slopes: [[f64; 2]; 3],
    uv: [[f64; 2]; 3],
    /// Normals in the axes right, upward, towards the eye, on the visible side.
    normals: [[f64; 3]; 3],
    /// A factor of the colour.
    tint: [f64; 3],
    mark: FaceMark,
    /// Samples per unit of each barycentric coordinate if the edge opposite its corner is an edge
    /// of the mesh.
    edges: [Option<f64>; 3],
}

impl Shader<'_> {
    /// Adds the light of each pixel's samples to `sums`, for a band of whole pixel rows.
    pub(super) fn band(&self, first_row: usize, numbers: &[u32], width: usize, sums: &mut [[f64; 3]]) {
        let s = self.samples as usize;
        let Paints { paper, lines, .. } = self.paints;
        let mut facet: Option<Facet> = None;
        for (r, row) in numbers.chunks_exact(width).enumerate() {
            for (column, &number) in row.iter().enumerate() {
                let light = match number {
                    EMPTY => paper,
                    FIRST_LINE.. => lines[(number - FIRST_LINE) as usize],
                    _ => {
                        let known = facet.take().filter(|facet| facet.number == number);
                        let known = known.or_else(|| Some(self.facet(number, &self.scene.triangle(number as usize)?)));
                        let light = known.as_ref().map_or(paper, |f| self.light(f, column, first_row + r));
                        facet = known;
                        light
                    }
                };
                let sum = &mut sums[r / s * (width / s) + column / s];
                *sum = add(*sum, light);
            }
        }
    }

    fn facet(&self, number: u32, triangle: &Triangle) -> Facet {
        let places = triangle.places;
        let range = self.view.faces.corner_range(triangle.face);
        let [c, d] = triangle.corners;
        let (uv, mut normals) = if triangle.fan {
            let part = 1.0 / range.len() as f64;
            let middle = range.clone().map(|c| self.view.uv[c].map(|x| x * part));
            let middle = middle.fold([0.0; 2], |m, x| [m[0] + x[0], m[1] + x[1]]);
            let normal = range.map(|c| self.normals[c]).fold([0.0; 3], add);
            ([self.view.uv[c], self.view.uv[d], middle], [self.normals[c], self.normals[d], scale(part, normal)])
        } else {
            ([c, d, c + 2].map(|c| self.view.uv[c]), [c, d, c + 2].map(|c| self.normals[c]))
        };
        let [p, q, r] = places;
        let area = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
        // y points downward: a face whose normal points to the eye is clockwise on paper.
        let outer = (area < 0.0) == self.outward;
        let to_eye = if area < 0.0 { 1.0 } else { -1.0 };
        normals = normals.map(|n| scale(to_eye, self.axes.map(|axis| dot(axis, n))));
        let opposite = [[q, r], [r, p], [p, q]];
        let slopes = opposite.map(|[a, b]| [(a[1] - b[1]) / area, (b[0] - a[0]) / area]);
        let is_edge = [!triangle.fan, !triangle.fan, true];
        let edges = [0, 1, 2].map(|i| is_edge[i].then(|| 1.0 / slopes[i][0].hypot(slopes[i][1])));
        let tint = if outer { [1.0; 3] } else { INNER };
        Facet { number, places, slopes, uv, normals, tint, mark: self.marks[triangle.face], edges }
    }

    fn light(&self, facet: &Facet, column: usize, row: usize) -> [f64; 3] {
        if facet.mark == FaceMark::Alarm {
            return self.paints.alarm;
        }
        let (x, y) = (column as f64 + 0.5, row as f64 + 0.5);
        let in_picture = facet.barycentric(x, y);
        let mut weights: [f64; 3] = std::array::from_fn(|i| in_picture[i] * facet.places[i][2]);
        let total: f64 = weights.iter().sum();
        weights = weights.map(|w| w / total);
        let square = self.square(facet, weights, total);
        let [bright, dark] = if facet.mark == FaceMark::Red { self.paints.red } else { self.paints.squares };
        let colour: [f64; 3] = std::array::from_fn(|k| dark[k] + (bright[k] - dark[k]) * square);
        let normal = (0..3).fold([0.0; 3], |n, i| add(n, scale(weights[i], facet.normals[i])));
        let lit = illumination(normal);
        let colour: [f64; 3] = std::array::from_fn(|k| colour[k] * facet.tint[k] * lit);
        let on_edge = (0..3).any(|i| facet.edges[i].is_some_and(|samples| in_picture[i] * samples < self.edges));
        if !on_edge {
            return colour;
        }
        let edge = self.paints.edge;
        std::array::from_fn(|k| colour[k] + (edge[k] - colour[k]) * EDGE)
    }

    /// The share of light squares around a point of a triangle: 1 inside a light square, 0 inside a
    /// dark one.
    fn square(&self, facet: &Facet, weights: [f64; 3], total: f64) -> f64 {
        let mut product = 1.0;
        for k in 0..2 {
            let value: f64 = (0..3).map(|i| weights[i] * facet.uv[i][k]).sum();
            // ∂u = Σ ∂(bᵢ nᵢ) (uᵢ − u) / Σ bᵢ nᵢ with barycentric coordinates b and nearness n.
            let slope = |axis: usize| {
                let part = |i: usize| facet.slopes[i][axis] * facet.places[i][2] * (facet.uv[i][k] - value);
                (part(0) + part(1) + part(2)) / total
            };
            let (across, down) = (slope(0), slope(1));
            // hypot would dominate the cost; values that overflow fade to the mean anyway.
            let steep = (across * across + down * down).sqrt() * self.samples;
            let fade = (FADE[1] - steep) / (FADE[1] - FADE[0]);
            // NaN, from overflow, becomes 0.
            let fade = fade.max(0.0);
            if fade == 0.0 {
                return 0.5;
            }
            product *= fade.min(1.0) * stripe(value, across.abs() + down.abs());
        }
        0.5 + 0.5 * product
    }
}

impl Facet {
    /// Barycentric coordinates in the picture, not negative, of sum 1.
    fn barycentric(&self, x: f64, y: f64) -> [f64; 3] {
        // Computed relative to the third corner; rounding affects the first two coordinates.
        let (dx, dy) = (x - self.places[2][0], y - self.places[2][1]);
        let b = [0, 1].map(|i| (self.slopes[i][0] * dx + self.slopes[i][1] * dy).clamp(0.0, 1.0));
        // The triangle has no area up to rounding.
        if b.iter().any(|b| b.is_nan()) {
            return [1.0 / 3.0; 3];
        }
        [b[0], b[1], (1.0 - b[0] - b[1]).max(0.0)]
    }
}

/// The mean over `[x − w/2, x + w/2]` of the square wave of period 2 that is 1 on [0, 1) and −1 on
/// [1, 2).
fn stripe(x: f64, width: f64) -> f64 {
    // x modulo 2.
    let x = x - 2.0 * (x / 2.0).floor();
    let (low, high) = (x - width / 2.0, x + width / 2.0);
    let inside = low.floor();
    if high < inside + 1.0 || width < 1e-9 {
        return if x < 1.0 { 1.0 } else { -1.0 };
    }
    // The integral of the wave: it rises to 1 and falls again.
    let integral = |x: f64| 1.0 - (x - 2.0 * (x / 2.0).floor() - 1.0).abs();
    ((integral(high) - integral(low)) / width).clamp(-1.0, 1.0)
}

/// The light on a surface whose normal, in the axes right, upward, towards the eye, can have any
/// length.
fn illumination(normal: [f64; 3]) -> f64 {
    let length = norm(normal);
    if length == 0.0 {
        return AMBIENT + HEAD;
    }
    let normal = scale(1.0 / length, normal);
    let lamps = LAMPS.iter().map(|(direction, strength)| {
        let cosine = dot(normal, *direction);
        strength * ((cosine + WRAP) / (1.0 + WRAP)).max(0.0)
    });
    AMBIENT + HEAD * normal[2].max(0.0) + lamps.sum::<f64>()
}

/// Converts an sRGB colour to linear light.
fn linear(Colour(c): Colour) -> [f64; 3] {
    c.map(|c| {
        let c = f64::from(c) / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    })
}

/// Converts linear light to an sRGB colour; light brighter than paper is clamped.
pub(super) fn encode(light: [f64; 3]) -> [u8; 3] {
    light.map(|c| {
        let c = if c <= 0.0031308 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 };
        (c * 255.0).round() as u8
    })
}
