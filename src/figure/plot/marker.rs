use std::f64::consts::{FRAC_PI_2, TAU};

use crate::figure::colour::Colour;
use crate::figure::drawing::{Drawing, VectorShape};
use crate::figure::style;

/// The colours of Okabe and Ito, distinguishable with any colour vision, without yellow, which is
/// too pale on paper.
const COLOURS: [Colour; 7] = [
    Colour([0, 114, 178]),
    Colour([213, 94, 0]),
    Colour([0, 158, 115]),
    Colour([204, 121, 167]),
    Colour([230, 159, 0]),
    Colour([86, 180, 233]),
    style::INK,
];

/// Number of corners, angle of the first one, and radius in units of [`RADIUS`]: disc, square,
/// triangle, diamond, inverted triangle, pentagon, hexagon. The radii give approximately equal
/// areas.
const SHAPES: [(usize, f64, f64); 7] = [
    (40, 0.0, 0.95),
    (4, FRAC_PI_2 / 2.0, 1.15),
    (3, -FRAC_PI_2, 1.35),
    (4, 0.0, 1.3),
    (3, FRAC_PI_2, 1.35),
    (5, -FRAC_PI_2, 1.15),
    (6, 0.0, 1.1),
];

/// Size of all markers, in pixels.
pub(super) const RADIUS: f64 = 10.0;
/// Width of their outlines, in pixels.
const OUTLINE: f64 = 2.5;

/// The marker of the points of a series.
#[derive(Clone, Copy, Debug)]
pub(super) struct Marker {
    pub(super) colour: Colour,
    shape: (usize, f64, f64),
    hollow: bool,
}

impl Marker {
    /// Returns the marker of the i-th series. The first seven differ in shape and in colour, the
    /// next seven are hollow, and later ones combine shapes with other colours.
    pub(super) fn of(i: usize) -> Marker {
        let (n, turn) = (COLOURS.len(), i / (2 * COLOURS.len()));
        Marker { colour: COLOURS[(i + turn) % n], shape: SHAPES[i % n], hollow: i / n % 2 == 1 }
    }

    pub(super) fn draw(self, [x, y]: [f64; 2], drawing: &mut Drawing) {
        let (corners, first, radius) = self.shape;
        let corner = |k: usize| {
            let (sin, cos) = (first + TAU * k as f64 / corners as f64).sin_cos();
            [x + RADIUS * radius * cos, y + RADIUS * radius * sin]
        };
        let points = (0..corners).map(corner).collect();
        let (fill, outline) = if self.hollow { (style::PAPER, self.colour) } else { (self.colour, style::PAPER) };
        // The outline of a full marker separates it from those it covers.
        let width = if self.hollow { OUTLINE } else { 1.0 };
        drawing.shapes.push(VectorShape::Polygon { points, fill, stroke: Some((outline, width)) });
    }
}

/// Largest number of points of a series that all get a marker; on longer curves markers would hide
/// the line.
const MANY: usize = 24;
/// Distance along a curve between markers, in pixels.
const SPACING: f64 = 170.0;

/// Returns the positions of the markers of the i-th series: all points, or some points of a long
/// curve including its end, staggered between series.
pub(super) fn some_of(i: usize, places: &[[f64; 2]]) -> Vec<[f64; 2]> {
    if places.len() <= MANY {
        return places.to_vec();
    }
    // The golden ratio spreads the first markers of any number of series.
    let mut left = SPACING * (0.618_034 * i as f64).fract();
    let mut chosen = Vec::new();
    for (k, at) in places.iter().enumerate() {
        if k > 0 {
            left -= (at[0] - places[k - 1][0]).hypot(at[1] - places[k - 1][1]);
        }
        if left <= 0.0 || k + 1 == places.len() {
            chosen.push(*at);
            left = SPACING;
        }
    }
    chosen
}
