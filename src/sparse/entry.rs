//! Entries of symmetric factors: real or complex numbers that multiply complex columns.

use std::ops::{Mul, MulAssign, Neg, SubAssign};

use faer::traits::ComplexField;
use num_complex::Complex64;
use pulp::bytemuck::cast_slice;

/// Number of partial sums in which products are accumulated.
pub(super) const STRANDS: usize = 8;

/// A real or complex number in a factor whose right-hand sides are complex.
///
/// Products with x are computed on real numbers in memory order, `c x = Re x · c + i Im x · c`, so
/// that parts need not be rearranged.
pub trait Entry:
    ComplexField
    + Copy
    + Mul<Output = Self>
    + MulAssign
    + SubAssign
    + Neg<Output = Self>
    + Mul<Complex64, Output = Complex64>
{
    /// Zero.
    const ZERO: Self;
    /// One.
    const ONE: Self;
    /// Number of real numbers in an entry.
    const PARTS: usize;

    /// Returns the real and imaginary parts, interleaved.
    fn parts(entries: &[Self]) -> &[f64];

    /// Returns the principal square root; NaN for negative real numbers.
    fn root(self) -> Self;

    /// Returns 1/c.
    fn inverse(self) -> Self;

    /// Returns x/c.
    fn divide(self, x: Complex64) -> Complex64;

    /// Whether it is finite and not 0.
    fn is_pivot(self) -> bool;

    /// Returns `Σ c x` for row i from the parts of `Σ c Re x` and `Σ c Im x`.
    fn sum(by_re: &[f64], by_im: &[f64], i: usize) -> Complex64;

    /// Stores entry i of x in the two arrays by which the parts of c are multiplied for `Σ c x`.
    fn put(i: usize, x: Complex64, first: &mut [f64], second: &mut [f64]);

    /// Returns `Σ c x` from the partial sums of the products of the parts of c with both arrays.
    fn total(first: [f64; STRANDS], second: [f64; STRANDS]) -> Complex64;
}

impl Entry for f64 {
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    const PARTS: usize = 1;

    fn parts(entries: &[Self]) -> &[f64] {
        entries
    }

    fn root(self) -> Self {
        self.sqrt()
    }

    fn inverse(self) -> Self {
        self.recip()
    }

    #[inline(always)]
    fn divide(self, x: Complex64) -> Complex64 {
        x / self
    }

    fn is_pivot(self) -> bool {
        self.is_finite() && self != 0.0
    }

    #[inline(always)]
    fn sum(by_re: &[f64], by_im: &[f64], i: usize) -> Complex64 {
        Complex64::new(by_re[i], by_im[i])
    }

    #[inline(always)]
    fn put(i: usize, x: Complex64, first: &mut [f64], second: &mut [f64]) {
        (first[i], second[i]) = (x.re, x.im);
    }

    #[inline(always)]
    fn total([a, b, c, d, e, f, g, h]: [f64; STRANDS], second: [f64; STRANDS]) -> Complex64 {
        let re = ((a + b) + (c + d)) + ((e + f) + (g + h));
        let [a, b, c, d, e, f, g, h] = second;
        Complex64::new(re, ((a + b) + (c + d)) + ((e + f) + (g + h)))
    }
}

impl Entry for Complex64 {
    const ZERO: Self = Complex64::ZERO;
    const ONE: Self = Complex64::ONE;
    const PARTS: usize = 2;

    fn parts(entries: &[Self]) -> &[f64] {
        cast_slice(entries)
    }

    fn root(self) -> Self {
        self.sqrt()
    }

    fn inverse(self) -> Self {
        self.inv()
    }

    #[inline(always)]
    fn divide(self, x: Complex64) -> Complex64 {
        x / self
    }

    fn is_pivot(self) -> bool {
        self.is_finite() && self != Complex64::ZERO
    }

    #[inline(always)]
    fn sum(by_re: &[f64], by_im: &[f64], i: usize) -> Complex64 {
        Complex64::new(by_re[2 * i] - by_im[2 * i + 1], by_re[2 * i + 1] + by_im[2 * i])
    }

    /// The second array holds x with real and imaginary parts exchanged.
    #[inline(always)]
    fn put(i: usize, x: Complex64, first: &mut [f64], second: &mut [f64]) {
        (first[2 * i], first[2 * i + 1]) = (x.re, x.im);
        (second[2 * i], second[2 * i + 1]) = (x.im, x.re);
    }

    /// Even partial sums of the first array are products of real parts, odd ones of imaginary
    /// parts.
    #[inline(always)]
    fn total([a, b, c, d, e, f, g, h]: [f64; STRANDS], second: [f64; STRANDS]) -> Complex64 {
        let re = ((a - b) + (c - d)) + ((e - f) + (g - h));
        let [a, b, c, d, e, f, g, h] = second;
        Complex64::new(re, ((a + b) + (c + d)) + ((e + f) + (g + h)))
    }
}
