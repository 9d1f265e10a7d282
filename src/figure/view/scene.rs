use std::ops::Range;

use super::camera::Lens;
use super::{SurfaceView, scan::scan};
use crate::geometry::vector::{add, scale};
use crate::sparse::Lists;

/// Number of pixel rows that are drawn at a time, so that their samples stay in the cache.
const BAND: usize = 16;
/// Marks a sample that shows nothing.
pub(super) const EMPTY: u32 = u32::MAX;
/// The first of the numbers of line styles.
pub(super) const FIRST_LINE: u32 = u32::MAX - 8;

/// A projected surface. Coordinates are samples, y downward, and nearness 1/Z.
///
/// Triangles are numbered by corners. A triangular face has the number of its first corner. Other
/// faces are fans around their centres, with one triangle for the edge that starts at each corner.
pub(super) struct Scene<'a> {
    view: &'a SurfaceView<'a>,
    /// Projected vertices, followed by the centres of all faces unless all faces are triangles.
    places: Vec<[f64; 3]>,
    face_of_corner: Vec<u32>,
    lines: Vec<SceneLine>,
}

/// A line on the surface.
#[derive(Clone, Copy)]
struct SceneLine {
    ends: [[f64; 3]; 2],
    half_width: f64,
    /// Nearness added to that of the surface.
    lift: f64,
    style: u32,
}

/// A triangle to be drawn.
pub(super) struct Triangle {
    pub(super) places: [[f64; 3]; 3],
    pub(super) face: usize,
    /// Its first two corners; the third is the last corner of a triangular face or the centre of
    /// the face.
    pub(super) corners: [usize; 2],
    pub(super) fan: bool,
}

impl<'a> Scene<'a> {
    /// Projects the surface; `to_samples` maps the picture plane to samples.
    pub(super) fn new(view: &'a SurfaceView<'a>, lens: &Lens, to_samples: impl Fn([f64; 3]) -> [f64; 3]) -> Scene<'a> {
        let place = |p: [f64; 3]| to_samples(lens.place(p));
        let used = used(view);
        let vertices = view.positions.iter().zip(used).map(|(p, used)| if used { place(*p) } else { [0.0; 3] });
        let mut places: Vec<[f64; 3]> = vertices.collect();
        if view.faces.arity() != Some(3) {
            places.extend(view.faces.iter().map(|polygon| {
                let part = 1.0 / polygon.len().max(1) as f64;
                // An empty face has no centre and no triangle.
                let middle = polygon.iter().map(|v| scale(part, view.positions[*v as usize])).reduce(add);
                middle.map_or([0.0; 3], place)
            }));
        }
        let mut face_of_corner = vec![0; view.faces.corners().len()];
        for f in 0..view.faces.len() {
            face_of_corner[view.faces.corner_range(f)].fill(f as u32);
        }
        Scene { view, places, face_of_corner, lines: Vec::new() }
    }

    /// Adds lines along edges: `half_width` samples on both sides, nearer than the surface by the
    /// fraction `lift`.
    pub(super) fn draw(&mut self, edges: impl Iterator<Item = [u32; 2]>, style: u32, half_width: f64, lift: f64) {
        let places = &self.places;
        self.lines.extend(edges.map(|edge| {
            let ends = edge.map(|v| places[v as usize]);
            SceneLine { ends, half_width, lift: lift * ends[0][2].max(ends[1][2]), style: FIRST_LINE + style }
        }));
    }

    /// Total area of all triangles, visible or not, in square samples.
    pub(super) fn area(&self) -> f64 {
        let triangles = (0..self.face_of_corner.len()).filter_map(|c| self.triangle(c));
        let double = triangles.map(|Triangle { places: [a, b, c], .. }| {
            ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs()
        });
        double.sum::<f64>() / 2.0
    }

    /// Returns the triangle with the number of a corner, if any.
    pub(super) fn triangle(&self, corner: usize) -> Option<Triangle> {
        let faces = self.view.faces;
        let face = self.face_of_corner[corner] as usize;
        let range = faces.corner_range(face);
        let place = |c: usize| self.places[faces.corners()[c] as usize];
        let next = if corner + 1 == range.end { range.start } else { corner + 1 };
        let (third, fan) = match range.len() {
            0..3 => return None,
            3 if corner != range.start => return None,
            3 => (place(corner + 2), false),
            _ => (self.places[self.view.positions.len() + face], true),
        };
        Some(Triangle { places: [place(corner), place(next), third], face, corners: [corner, next], fan })
    }

    /// Calls `show(first row, numbers)` for one band of samples after the other, with the number of
    /// the visible triangle or line at each sample.
    pub(super) fn bands(&self, [width, height]: [usize; 2], samples: usize, mut show: impl FnMut(usize, &[u32])) {
        let rows = BAND * samples;
        let bands = height.div_ceil(rows);
        let triangles = in_bands(bands, self.face_of_corner.len(), |c| {
            let corners = self.triangle(c)?.places;
            bands_of(&corners, rows, bands)
        });
        let lines = in_bands(bands, self.lines.len(), |l| bands_of(&self.lines[l].ribbon(), rows, bands));
        let mut seen = vec![EMPTY; rows * width];
        let mut nearest = vec![0.0; rows * width];
        for band in 0..bands {
            let here = band * rows..((band + 1) * rows).min(height);
            seen.fill(EMPTY);
            nearest.fill(0.0);
            let mut lay = |places: [[f64; 3]; 3], number: u32| {
                scan(places, here.clone(), width, |row, columns, near| {
                    let first = (row - here.start) * width;
                    for column in columns {
                        let nearness = near.at(column, row);
                        if nearness > nearest[first + column] {
                            nearest[first + column] = nearness;
                            seen[first + column] = number;
                        }
                    }
                });
            };
            for &c in triangles.of(band as u32) {
                if let Some(triangle) = self.triangle(c as usize) {
                    lay(triangle.places, c);
                }
            }
            for &l in lines.of(band as u32) {
                let line = &self.lines[l as usize];
                let [a, b, c, d] = line.ribbon();
                lay([a, b, c], line.style);
                lay([a, c, d], line.style);
            }
            show(here.start, &seen[..here.len() * width]);
        }
    }
}

impl SceneLine {
    /// The corners of the strip that the line covers; it is longer than the line by half its width,
    /// so that bends are closed.
    fn ribbon(&self) -> [[f64; 3]; 4] {
        let [[x0, y0, near0], [x1, y1, near1]] = self.ends;
        let (dx, dy) = (x1 - x0, y1 - y0);
        let length = dx.hypot(dy);
        let unit = if length > 0.0 { self.half_width / length } else { 0.0 };
        let (dx, dy) = (dx * unit, dy * unit);
        let (near0, near1) = (near0 + self.lift, near1 + self.lift);
        [
            [x0 - dx - dy, y0 - dy + dx, near0],
            [x1 + dx - dy, y1 + dy + dx, near1],
            [x1 + dx + dy, y1 + dy - dx, near1],
            [x0 - dx + dy, y0 - dy - dx, near0],
        ]
    }
}

/// Returns for each vertex whether it belongs to a face.
fn used(view: &SurfaceView) -> Vec<bool> {
    let mut used = vec![false; view.positions.len()];
    view.faces.corners().iter().for_each(|v| used[*v as usize] = true);
    used
}

/// The bands that a polygon reaches; `None` if it covers no row of samples.
fn bands_of(polygon: &[[f64; 3]], rows: usize, bands: usize) -> Option<Range<usize>> {
    let low = polygon.iter().fold(f64::INFINITY, |m, p| m.min(p[1]));
    let high = polygon.iter().fold(f64::NEG_INFINITY, |m, p| m.max(p[1]));
    // The conversion saturates: negative numbers become 0.
    let (first, end) = ((low - 0.5).ceil().max(0.0) as usize, (high - 0.5).ceil().max(0.0) as usize);
    (first < end).then(|| (first / rows).min(bands)..end.div_ceil(rows).min(bands))
}

/// Puts each of the numbers `0 .. count` into the bands of its range.
fn in_bands(bands: usize, count: usize, range: impl Fn(usize) -> Option<Range<usize>>) -> Lists {
    let range = &range;
    let pairs = (0..count).flat_map(|n| range(n).into_iter().flatten().map(move |band| (band as u32, n as u32)));
    Lists::new(bands, pairs)
}
