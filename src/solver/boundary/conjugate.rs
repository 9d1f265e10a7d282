//! Boundary values of discrete holomorphic maps: the kernel of M = S + iK.

use num_complex::Complex64;

use super::Reduction;
use super::operator::C;

/// `Hil x = y` with `y_{v+1} − y_{v−1} = (S x)_v / c`, of mean 0 on each colour: for real x the boundary values of the
/// conjugate function. Linear over the complex numbers; one product with S.
pub(super) fn hil(reduction: &Reduction, x: &[Complex64]) -> Vec<Complex64> {
    let n = x.len();
    let mut flux = reduction.s(x);
    // What flows out through each colour is 0 but for rounding.
    remove_means(&mut flux);
    let mut y = vec![Complex64::ZERO; n];
    for v in 1..n - 1 {
        y[v + 1] = y[v - 1] + flux[v] / C;
    }
    // y_1 − y_{n−1} = flux_0 / c: position 0 has the other colour's chain, which begins at 1.
    remove_means(&mut y);
    y
}

/// `Π z = ½ (z + i Hil z)`, the means of both colours kept: the projection onto ker M, in which H = 0.
pub(super) fn project(reduction: &Reduction, z: &[Complex64]) -> Vec<Complex64> {
    let mut centred = z.to_vec();
    let means = remove_means(&mut centred);
    let conjugate = hil(reduction, &centred);
    let both = centred.iter().zip(&conjugate).enumerate();
    both.map(|(v, (z, y))| means[v % 2] + 0.5 * (z + Complex64::I * y)).collect()
}

/// Takes the mean of each colour away, and returns both.
fn remove_means(z: &mut [Complex64]) -> [Complex64; 2] {
    let half = 0.5 * z.len() as f64;
    let means = [0, 1].map(|colour| z.iter().skip(colour).step_by(2).sum::<Complex64>() / half);
    for (v, z) in z.iter_mut().enumerate() {
        *z -= means[v % 2];
    }
    means
}
