use std::ops::Range;

use tiny_skia::Pixmap;

use super::FigureError;
use super::colour::Colour;
use super::style;

/// Samples per pixel along each axis in pictures for direct viewing: 17 grey levels along an edge.
pub(super) const SAMPLES: usize = 4;

/// A picture with `samples²` colour samples per pixel, on which later shapes cover earlier ones.
///
/// Point sampling assigns each sample to exactly one of two faces that share an edge. There are no
/// seams, and the order of faces that do not overlap is irrelevant; anti-aliasing by coverage
/// cannot achieve this.
pub(super) struct Raster {
    width: usize,
    height: usize,
    samples: usize,
    /// Samples per unit of the coordinates of shapes.
    scale: f64,
    cells: Vec<[u8; 3]>,
}

impl Raster {
    /// Makes a blank picture of `width × height` units with `zoom` pixels each along both axes.
    pub(super) fn new(width: usize, height: usize, zoom: usize, samples: usize) -> Raster {
        let Colour(paper) = style::PAPER;
        let (width, height) = (width * zoom, height * zoom);
        let cells = vec![paper; width * height * samples * samples];
        Raster { width, height, samples, scale: (zoom * samples) as f64, cells }
    }

    /// Fills a polygon by the nonzero rule, so that both lobes of a crossed quad are filled.
    pub(super) fn fill(&mut self, mut points: Vec<[f64; 2]>, Colour(colour): Colour) {
        points.iter_mut().for_each(|p| *p = p.map(|c| c * self.scale));
        let columns = self.width * self.samples;
        spans(&points, columns, self.height * self.samples, |row, span| {
            self.cells[row * columns..][span].fill(colour);
        });
    }

    /// Averages the samples of each pixel.
    pub(super) fn resolve(&self) -> Result<Pixmap, FigureError> {
        let (s, columns) = (self.samples, self.width * self.samples);
        let count = (s * s) as u32;
        let mut sheet = blank_sheet(self.width as u32, self.height as u32)?;
        for (i, pixel) in sheet.data_mut().chunks_exact_mut(4).enumerate() {
            let (x, y) = (i % self.width, i / self.width);
            let mut sum = [0u32; 3];
            for row in y * s..(y + 1) * s {
                for cell in &self.cells[row * columns + x * s..][..s] {
                    for (total, part) in sum.iter_mut().zip(cell) {
                        *total += u32::from(*part);
                    }
                }
            }
            for (byte, total) in pixel.iter_mut().zip(sum) {
                *byte = ((total + count / 2) / count) as u8;
            }
        }
        Ok(sheet)
    }
}

/// A finished figure in pixels.
pub(super) struct RenderedSheet {
    pub(super) pixels: Pixmap,
    /// Distance from the upper edge to the centre of the plot area, in units of paper.
    pub(super) middle: f64,
}

/// Makes a white sheet.
pub(super) fn blank_sheet(width: u32, height: u32) -> Result<Pixmap, FigureError> {
    let mut sheet = Pixmap::new(width, height).ok_or(FigureError::Sheet { width, height })?;
    sheet.data_mut().fill(u8::MAX);
    Ok(sheet)
}

/// Calls `paint(row, columns)` for every run of unit cells whose centres lie inside a polygon
/// (nonzero rule), clipped to `width × height` cells. A centre on an edge belongs to a fixed side
/// of the edge.
pub(super) fn spans(polygon: &[[f64; 2]], width: usize, height: usize, mut paint: impl FnMut(usize, Range<usize>)) {
    let low = polygon.iter().fold(f64::INFINITY, |m, p| m.min(p[1]));
    let high = polygon.iter().fold(f64::NEG_INFINITY, |m, p| m.max(p[1]));
    let mut crossings: Vec<(f64, i32)> = Vec::with_capacity(8);
    for row in first_centre(low, height)..first_centre(high, height) {
        let y = row as f64 + 0.5;
        crossings.clear();
        for (i, p) in polygon.iter().enumerate() {
            let q = &polygon[(i + 1) % polygon.len()];
            // Computed from the lower end, so that both faces of an edge get exactly the same
            // crossing.
            let (a, b, turn) = if p[1] <= q[1] { (p, q, 1) } else { (q, p, -1) };
            if a[1] <= y && y < b[1] {
                crossings.push((a[0] + (b[0] - a[0]) * ((y - a[1]) / (b[1] - a[1])), turn));
            }
        }
        crossings.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let mut winding = 0;
        for pair in crossings.windows(2) {
            winding += pair[0].1;
            let span = first_centre(pair[0].0, width)..first_centre(pair[1].0, width);
            if winding != 0 && !span.is_empty() {
                paint(row, span);
            }
        }
    }
}

/// Returns the index of the first cell whose centre is not before `x`, at most `limit`.
pub(super) fn first_centre(x: f64, limit: usize) -> usize {
    // The conversion saturates: negative numbers become 0.
    ((x - 0.5).ceil() as usize).min(limit)
}

/// Encodes an opaque sheet as a PNG file with `zoom` pixels per unit of paper.
pub(super) fn encode_png(sheet: &Pixmap, zoom: u32) -> Result<Vec<u8>, FigureError> {
    let rgb: Vec<u8> = sheet.data().chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, sheet.width(), sheet.height());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
    encoder.set_pixel_dims(Some(png::PixelDimensions {
        xppu: zoom * style::PIXELS_PER_METRE,
        yppu: zoom * style::PIXELS_PER_METRE,
        unit: png::Unit::Meter,
    }));
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&rgb)?;
    writer.finish()?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(polygon: &[[f64; 2]]) -> usize {
        let mut cells = 0;
        spans(polygon, 100, 100, |_, span| cells += span.len());
        cells
    }

    #[test]
    fn neighbours_share_no_sample_and_leave_none_out() {
        // A fan of 97 triangles around an irrational point: every cell of the square belongs to
        // exactly one.
        let centre = [50.0 * 2f64.sqrt(), 100.0 / 3.0];
        let corners = [[0.0, 0.0], [100.0, 0.0], [100.0, 100.0], [0.0, 100.0]];
        let rim: Vec<[f64; 2]> = (0..97)
            .map(|i| {
                let t = f64::from(i) * 4.0 / 97.0;
                let (a, b) = (corners[t as usize], corners[(t as usize + 1) % 4]);
                [0, 1].map(|k| a[k] + (b[k] - a[k]) * t.fract())
            })
            .collect();
        let mut hits = vec![0; 100 * 100];
        let mut paint = |polygon: &[[f64; 2]]| {
            spans(polygon, 100, 100, |row, span| hits[row * 100..][span].iter_mut().for_each(|h| *h += 1));
        };
        for (i, p) in rim.iter().enumerate() {
            paint(&[centre, *p, rim[(i + 1) % 97]]);
        }
        // The chords across three corners leave three triangles uncovered.
        for corner in 1..4usize {
            let after = rim.iter().position(|p| *p == rim[(corner * 97).div_ceil(4)]).unwrap_or(0);
            paint(&[rim[after - 1], corners[corner], rim[after]]);
        }
        assert!(hits.iter().all(|h| *h == 1), "{:?}", hits.iter().filter(|h| **h != 1).count());
    }

    #[test]
    fn both_lobes_of_a_crossed_quad_and_no_more_of_a_dart_are_filled() {
        // Two triangles of area 40 × 20 / 2; a triangle of 40 × 40 / 2 minus one of 40 × 10 / 2.
        assert!(area(&[[10.0, 10.0], [50.0, 50.0], [10.0, 50.0], [50.0, 10.0]]).abs_diff(800) <= 40);
        assert!(area(&[[10.0, 10.0], [30.0, 20.0], [50.0, 10.0], [30.0, 50.0]]).abs_diff(600) <= 40);
    }

    #[test]
    fn what_lies_outside_the_sheet_is_clipped() {
        assert_eq!(area(&[[-1e9, -1e9], [1e9, -1e9], [1e9, 1e9], [-1e9, 1e9]]), 100 * 100);
        assert_eq!(area(&[[-20.0, 0.0], [-10.0, 0.0], [-10.0, 50.0]]), 0);
    }
}
