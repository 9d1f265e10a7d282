//! From boundary edges to the mismatch of white against black, and its adjoint.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

use super::{BoundaryError, Layout};
use crate::laplacian::{ConformalLaplacian, Work};

/// The complex-linear map from the edges e (n, every loop closed) to `(w_k − (b_k + κ_k e_k)) / √(l_k Σ l)`, the translations of
/// holes and w_0 being such as no flux leaves a hole and the mismatch is least.
///
/// Where a hole lies is no unknown: w is single-valued around it, `Σ_loop T b = 0`, and that is as many equations as there are
/// translations.
pub(super) struct Mismatch<'a> {
    laplacian: &'a ConformalLaplacian,
    layout: &'a Layout,
    work: Work,
    /// 1/√(l_k Σ l), and the sum of its squares.
    weight: Vec<f64>,
    weights: f64,
    /// For every hole `T 1`, the flux of the function that is 1 on its loop and 0 on the others (n).
    pub hole_flux: Vec<Vec<Complex64>>,
    /// The flux through hole c of the function that is 1 on hole d, its inverse.
    inverse: DMatrix<Complex64>,
    flux: Vec<Complex64>,
}

impl<'a> Mismatch<'a> {
    /// # Errors
    /// Holes between which nothing flows.
    pub fn new(laplacian: &'a ConformalLaplacian, layout: &'a Layout) -> Result<Self, BoundaryError> {
        let n = laplacian.len();
        let whole: f64 = layout.length.iter().sum();
        let weight: Vec<f64> = layout.length.iter().map(|l| 1.0 / (l * whole).sqrt()).collect();
        let mut work = laplacian.work();
        let holes = laplacian.loops().get(1..).unwrap_or_default();
        let of_hole = |range: &Range<usize>| {
            let mut one = vec![Complex64::ZERO; n];
            one[range.clone()].fill(Complex64::ONE);
            let mut flux = vec![Complex64::ZERO; n];
            laplacian.flux(&one, &mut flux, &mut work);
            flux
        };
        let hole_flux: Vec<Vec<Complex64>> = holes.iter().map(of_hole).collect();
        let capacity = capacity(holes, &hole_flux);
        let inverse = if holes.is_empty() { Some(capacity) } else { capacity.try_inverse() };
        let inverse = inverse.ok_or(BoundaryError::Unsuitable { reason: "the holes have no flux" })?;
        let weights = weight.iter().map(|w| w * w).sum();
        let flux = vec![Complex64::ZERO; n];
        Ok(Mismatch { laplacian, layout, work, weight, weights, hole_flux, inverse, flux })
    }

    fn holes(&self) -> &'a [Range<usize>] {
        self.laplacian.loops().get(1..).unwrap_or_default()
    }

    /// The black values: every loop from 0, holes moved to where no flux leaves them.
    fn places(&self, edges: &[Complex64]) -> Vec<Complex64> {
        let mut b = vec![Complex64::ZERO; edges.len()];
        for range in self.laplacian.loops() {
            for k in range.start + 1..range.end {
                b[k] = b[k - 1] + edges[k - 1];
            }
        }
        let flux = self.hole_flux.iter().map(|f| f.iter().zip(&b).map(|(f, b)| f * b).sum());
        let shift = &self.inverse * DVector::from_iterator(self.hole_flux.len(), flux);
        for (range, shift) in self.holes().iter().zip(shift.iter()) {
            b[range.clone()].iter_mut().for_each(|b| *b -= shift);
        }
        b
    }

    /// The adjoint of `places`, added to `edges`.
    fn add_places_adjoint(&self, mut b: Vec<Complex64>, edges: &mut [Complex64]) {
        let sums = self.holes().iter().map(|range| b[range.clone()].iter().sum());
        let shift = self.inverse.adjoint() * DVector::from_iterator(self.hole_flux.len(), sums);
        for (flux, shift) in self.hole_flux.iter().zip(shift.iter()) {
            b.iter_mut().zip(flux).for_each(|(b, f)| *b -= f.conj() * shift);
        }
        for range in self.laplacian.loops() {
            let mut sum = Complex64::ZERO;
            for k in range.clone().rev() {
                edges[k] += sum;
                sum += b[k];
            }
        }
    }

    /// The white values of black ones, the first of the first loop being 0.
    fn white(&mut self, b: &[Complex64]) -> Vec<Complex64> {
        self.laplacian.flux(b, &mut self.flux, &mut self.work);
        let mut w = vec![Complex64::ZERO; b.len()];
        for (c, range) in self.laplacian.loops().iter().enumerate() {
            if c > 0 {
                w[range.start] = self.laplacian.shifts()[c - 1].iter().zip(b).map(|(c, b)| c * b).sum();
            }
            for k in range.start + 1..range.end {
                w[k] = w[k - 1] + Complex64::I * self.flux[k];
            }
        }
        w
    }

    /// The weighted mismatch (n).
    pub fn of(&mut self, edges: &[Complex64]) -> Vec<Complex64> {
        let b = self.places(edges);
        let mut r = self.white(&b);
        for (k, r) in r.iter_mut().enumerate() {
            *r = (*r - b[k] - self.layout.kappa[k] * edges[k]) * self.weight[k];
        }
        self.remove_mean(&mut r);
        r
    }

    /// The adjoint of [`Mismatch::of`] (n).
    pub fn adjoint(&mut self, r: &[Complex64]) -> Vec<Complex64> {
        let n = r.len();
        let mut d = r.to_vec();
        self.remove_mean(&mut d);
        d.iter_mut().zip(&self.weight).for_each(|(d, w)| *d *= w);
        let mut edges: Vec<Complex64> = d.iter().zip(&self.layout.kappa).map(|(d, k)| -k.conj() * d).collect();
        let mut b: Vec<Complex64> = d.iter().map(|d| -d).collect();
        // Conjugated, for T is symmetric.
        let mut from_flux = vec![Complex64::ZERO; n];
        for (c, range) in self.laplacian.loops().iter().enumerate() {
            let mut sum = Complex64::ZERO;
            for k in range.clone().rev() {
                sum += d[k];
                if k > range.start {
                    from_flux[k] = (-Complex64::I * sum).conj();
                }
            }
            if c > 0 {
                let shift = &self.laplacian.shifts()[c - 1];
                b.iter_mut().zip(shift).for_each(|(b, c)| *b += c.conj() * sum);
            }
        }
        self.laplacian.flux(&from_flux, &mut self.flux, &mut self.work);
        b.iter_mut().zip(&self.flux).for_each(|(b, f)| *b += f.conj());
        self.add_places_adjoint(b, &mut edges);
        edges
    }

    /// What w_0 makes of a mismatch.
    fn remove_mean(&self, r: &mut [Complex64]) {
        let mean = r.iter().zip(&self.weight).map(|(r, w)| r * w).sum::<Complex64>() / self.weights;
        r.iter_mut().zip(&self.weight).for_each(|(r, w)| *r -= mean * w);
    }

    /// The black boundary values, and the mean of the white ones over the first loop.
    pub fn boundary(&mut self, edges: &[Complex64]) -> (Vec<Complex64>, Complex64) {
        let b = self.places(edges);
        let w = self.white(&b);
        let off = (0..b.len()).map(|k| (b[k] + self.layout.kappa[k] * edges[k] - w[k]) * self.weight[k].powi(2));
        let shift = off.sum::<Complex64>() / self.weights;
        let first = &w[self.laplacian.loops()[0].clone()];
        (b, first.iter().sum::<Complex64>() / first.len() as f64 + shift)
    }

    /// The edges with the loop of every hole turned and scaled as the mismatch asks for, given the shapes of the loops. The rotation
    /// and scale z_c of hole c: the least squares of the mismatch, which is linear in them.
    pub fn turn_holes(&mut self, edges: &[Complex64]) -> Vec<Complex64> {
        let holes = self.holes();
        let mut only = edges.to_vec();
        holes.iter().for_each(|range| only[range.clone()].fill(Complex64::ZERO));
        let rest = self.of(&only);
        let columns: Vec<Vec<Complex64>> = holes
            .iter()
            .map(|range| {
                let mut one = vec![Complex64::ZERO; edges.len()];
                one[range.clone()].copy_from_slice(&edges[range.clone()]);
                self.of(&one)
            })
            .collect();
        let dot = |a: &[Complex64], b: &[Complex64]| a.iter().zip(b).map(|(a, b)| a.conj() * b).sum::<Complex64>();
        let m = holes.len();
        let normal = DMatrix::from_fn(m, m, |i, j| dot(&columns[i], &columns[j]));
        let right = DVector::from_fn(m, |i, _| -dot(&columns[i], &rest));
        normal.lu().solve(&right).map_or_else(Vec::new, |z| z.iter().copied().collect())
    }
}

/// The flux through hole c of the function that is 1 on hole d.
fn capacity(holes: &[Range<usize>], flux: &[Vec<Complex64>]) -> DMatrix<Complex64> {
    DMatrix::from_fn(holes.len(), holes.len(), |c, d| flux[d][holes[c].clone()].iter().sum())
}
