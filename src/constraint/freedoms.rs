use num_complex::Complex64;

use super::{Fixed, Line};

/// `x = Z y + x0` over the reals: of a free vertex both coordinates are unknowns, of one on a line the place along it, of
/// a held one none.
#[derive(Clone, Debug, PartialEq)]
pub struct Freedoms {
    /// Where the unknowns of each vertex begin in y (`nv + 1`).
    pub offset: Vec<u32>,
    /// The vertices on lines, ascending.
    lines: Vec<(u32, Line)>,
    /// Held values; 0 elsewhere (`nv`).
    z0: Vec<Complex64>,
}

impl Freedoms {
    /// The freedoms that `fixed` leaves to a map of `vertices` vertices.
    pub fn new(vertices: usize, fixed: &Fixed) -> Self {
        let mut offset = Vec::with_capacity(vertices + 1);
        let mut z0 = vec![Complex64::ZERO; vertices];
        let mut lines = Vec::new();
        let mut next = 0;
        for v in 0..vertices as u32 {
            offset.push(next);
            match (fixed.place(v), fixed.line(v)) {
                (Some(place), _) => z0[v as usize] = place,
                (None, Some(line)) => {
                    lines.push((v, line));
                    next += 1;
                }
                (None, None) => next += 2,
            }
        }
        offset.push(next);
        Freedoms { offset, lines, z0 }
    }

    /// Number of real unknowns.
    pub fn unknowns(&self) -> usize {
        self.offset[self.offset.len() - 1] as usize
    }

    /// Number of unknowns of vertex `v`: 0, 1 or 2.
    pub fn width(&self, v: usize) -> usize {
        (self.offset[v + 1] - self.offset[v]) as usize
    }

    /// The direction of vertex `v`, which is on a line.
    pub fn direction(&self, v: u32) -> Complex64 {
        match self.lines.binary_search_by_key(&v, |(w, _)| *w) {
            Ok(k) => self.lines[k].1.direction,
            Err(_) => Complex64::ONE,
        }
    }

    /// z = Z y + x0.
    pub fn expand(&self, y: &[f64]) -> Vec<Complex64> {
        let mut z = self.z0.clone();
        self.write(y, &mut z);
        for &(v, line) in &self.lines {
            z[v as usize] += line.point;
        }
        z
    }

    /// Z y, the change of z that a change of y makes.
    pub fn expand_direction(&self, y: &[f64]) -> Vec<Complex64> {
        let mut z = vec![Complex64::ZERO; self.z0.len()];
        self.write(y, &mut z);
        z
    }

    fn write(&self, y: &[f64], z: &mut [Complex64]) {
        for (v, z) in z.iter_mut().enumerate() {
            let at = self.offset[v] as usize;
            if self.width(v) == 2 {
                *z = Complex64::new(y[at], y[at + 1]);
            }
        }
        for &(v, line) in &self.lines {
            z[v as usize] = y[self.offset[v as usize] as usize] * line.direction;
        }
    }

    /// The y nearest to a map z.
    pub fn restrict(&self, z: &[Complex64]) -> Vec<f64> {
        let mut from_point = z.to_vec();
        for &(v, line) in &self.lines {
            from_point[v as usize] -= line.point;
        }
        self.restrict_gradient(&from_point)
    }

    /// Zᵀ g, the gradient for y from that for x, ∂/∂Re z + i ∂/∂Im z.
    pub fn restrict_gradient(&self, g: &[Complex64]) -> Vec<f64> {
        let mut y = vec![0.0; self.unknowns()];
        for (v, g) in g.iter().enumerate() {
            let at = self.offset[v] as usize;
            match self.width(v) {
                2 => (y[at], y[at + 1]) = (g.re, g.im),
                1 => y[at] = (self.direction(v as u32).conj() * g).re,
                _ => {}
            }
        }
        y
    }
}
