use nalgebra::{DMatrix, SymmetricEigen};

use super::cg::{dot, norm};

/// Steps at most; usually 5 to 10 settle it, but one that vanishes is approached without end.
const STEPS: usize = 40;

/// An estimate from above of the smallest eigenvalue of a symmetric matrix on functions of `theta` that are 0 at the pins:
/// locally optimal preconditioned gradients (Knyazev's LOBPCG with one vector), a product a step.
pub(super) fn smallest_eigenvalue(
    apply: impl Fn(&[f64]) -> Vec<f64>,
    precondition: impl Fn(&[f64]) -> Vec<f64>,
    pins: &[usize],
    theta: &[f64],
) -> Option<f64> {
    // The Möbius group's directions are the lowest, or next to them; and all others, by noise.
    let noise: Vec<f64> = (1..=theta.len() as u64).map(noise).collect();
    let moebius = [|_| 1.0, f64::cos, f64::sin].map(|f: fn(f64) -> f64| theta.iter().map(|&t| f(t)).collect());
    let mut basis: Vec<Pair> = Vec::new();
    for mut start in moebius.into_iter().chain([noise]) {
        for &pin in pins {
            start[pin] = 0.0;
        }
        extend(&mut basis, start, &apply);
    }
    let (mut value, mut settled) = (f64::INFINITY, 0);
    for _ in 0..STEPS {
        let small = DMatrix::from_fn(basis.len(), basis.len(), |i, j| {
            0.5 * (dot(&basis[i].0, &basis[j].1) + dot(&basis[j].0, &basis[i].1))
        });
        if basis.is_empty() || small.iter().any(|entry| !entry.is_finite()) {
            return None;
        }
        let eigen = SymmetricEigen::new(small);
        let lowest = eigen.eigenvalues.imin();
        let next = eigen.eigenvalues[lowest];
        let weights: Vec<f64> = eigen.eigenvectors.column(lowest).iter().copied().collect();
        settled = if (value - next).abs() <= 1e-2 * next.abs() { settled + 1 } else { 0 };
        value = next;
        if settled == 2 || value <= 0.0 {
            break;
        }
        // The new vector, its difference from the old one's direction, and the gradient at it.
        let (new, change) = (combine(&basis, &weights), combine(&basis[1..], &weights[1..]));
        let gradient: Vec<f64> = new.1.iter().zip(&new.0).map(|(a, x)| a - value * x).collect();
        basis.clear();
        push(&mut basis, new);
        push(&mut basis, change);
        extend(&mut basis, precondition(&gradient), &apply);
    }
    Some(value)
}

/// In [−1, 1).
fn noise(k: u64) -> f64 {
    let mut x = k.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((x ^ (x >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

type Pair = (Vec<f64>, Vec<f64>);

fn combine(basis: &[Pair], weights: &[f64]) -> Pair {
    let n = basis.first().map_or(0, |(x, _)| x.len());
    let mut sum = (vec![0.0; n], vec![0.0; n]);
    for ((x, ax), w) in basis.iter().zip(weights) {
        for k in 0..n {
            sum.0[k] += w * x[k];
            sum.1[k] += w * ax[k];
        }
    }
    sum
}

fn extend(basis: &mut Vec<Pair>, x: Vec<f64>, apply: impl Fn(&[f64]) -> Vec<f64>) {
    let length = norm(&x);
    if length > 0.0 && length.is_finite() {
        let x: Vec<f64> = x.iter().map(|x| x / length).collect();
        let ax = apply(&x);
        push(basis, (x, ax));
    }
}

/// Adds a vector made orthogonal to the others, with its image, unless nothing of it is left.
fn push(basis: &mut Vec<Pair>, (mut x, mut ax): Pair) {
    let before = norm(&x);
    for (y, ay) in basis.iter() {
        let part = dot(&x, y);
        for k in 0..x.len() {
            x[k] -= part * y[k];
            ax[k] -= part * ay[k];
        }
    }
    let length = norm(&x);
    if length > 1e-10 * before && length > 0.0 {
        x.iter_mut().for_each(|x| *x /= length);
        ax.iter_mut().for_each(|a| *a /= length);
        basis.push((x, ax));
    }
}
