//! Surfaces by construction, and pictures read back.

use std::f64::consts::TAU;

use riemap::figure::{Colour, SurfaceView};
use riemap::surface::Faces;

pub type Point = [f64; 3];

/// Light squares are warm, dark ones blue.
pub fn is_light(Colour([r, _, b]): Colour) -> bool {
    r > b
}

pub const PAPER: Colour = Colour([255, 255, 255]);

pub struct Pixels {
    pub width: usize,
    pub height: usize,
    pub rgb: Vec<u8>,
}

impl Pixels {
    pub fn of(bytes: &[u8]) -> Pixels {
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let mut rgb = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut rgb).unwrap();
        Pixels { width: info.width as usize, height: info.height as usize, rgb }
    }

    pub fn at(&self, x: usize, y: usize) -> Colour {
        let i = 3 * (y * self.width + x);
        Colour([self.rgb[i], self.rgb[i + 1], self.rgb[i + 2]])
    }

    /// The first and the last pixel of every row that are not paper, for rows that have any.
    pub fn rows(&self) -> Vec<(usize, usize, usize)> {
        let inked = |y: usize| move |x: &usize| self.at(*x, y) != PAPER;
        let row = |y| Some((y, (0..self.width).find(inked(y))?, (0..self.width).rfind(inked(y))?));
        (0..self.height).filter_map(row).collect()
    }
}

pub fn draw(view: &SurfaceView, size: [u32; 2]) -> Pixels {
    Pixels::of(&view.render(size).unwrap())
}

/// n × n quads over [0, 1]², lifted by `height`, with texture coordinates (x, y) · squares.
pub struct Sheet {
    pub positions: Vec<Point>,
    pub faces: Faces,
    pub uv: Vec<[f64; 2]>,
}

impl Sheet {
    pub fn new(n: u32, squares: f64, triangles: bool, height: impl Fn(f64, f64) -> f64) -> Sheet {
        let at = |i: u32| f64::from(i) / f64::from(n);
        let place = |k: u32| (at(k % (n + 1)), at(k / (n + 1)));
        let positions = (0..(n + 1) * (n + 1)).map(place).map(|(x, y)| [x, y, height(x, y)]).collect::<Vec<_>>();
        let mut faces = Faces::default();
        for f in 0..n * n {
            let v = f / n * (n + 1) + f % n;
            let quad = [v, v + 1, v + n + 2, v + n + 1];
            if triangles {
                faces.push(&[quad[0], quad[1], quad[2]]);
                faces.push(&[quad[0], quad[2], quad[3]]);
            } else {
                faces.push(&quad);
            }
        }
        let uv = faces.corners().iter().map(|v| place(*v)).map(|(x, y)| [x * squares, y * squares]).collect();
        Sheet { positions, faces, uv }
    }

    pub fn view(&self) -> SurfaceView<'_> {
        SurfaceView::new(&self.positions, &self.faces, &self.uv)
    }
}

/// Torus of revolution of n × n quads. Its map is (p i, q j) / n lattice steps; the cuts run along columns and rows `cut`.
pub fn torus(n: u32, [p, q]: [f64; 2], cut: [u32; 2]) -> Sheet {
    let angle = |k: u32| TAU * f64::from(k) / f64::from(n);
    let point = |k: u32| {
        let ((sin, cos), (height, out)) = (angle(k % n).sin_cos(), angle(k / n).sin_cos());
        [(2.0 + 0.8 * out) * cos, (2.0 + 0.8 * out) * sin, 0.8 * height]
    };
    let (mut faces, mut uv) = (Faces::default(), Vec::new());
    for (j, i) in (0..n).flat_map(|j| (0..n).map(move |i| (j, i))) {
        let corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
        faces.push(&corners.map(|[i, j]| j % n * n + i % n));
        // Steps from the cut on, so that faces behind it are a whole turn further.
        let lift = |k: u32, face: u32, cut: u32| f64::from(k) + if face < cut { f64::from(n) } else { 0.0 };
        let step = |k: f64, turn: f64| k / f64::from(n) * turn;
        uv.extend(corners.map(|[a, b]| [step(lift(a, i, cut[0]), p), step(lift(b, j, cut[1]), q)]));
    }
    Sheet { positions: (0..n * n).map(point).collect(), faces, uv }
}
