/// Where conjugate gradients ended.
pub(super) struct Descent {
    /// The approximate solution; a direction of descent.
    pub x: Vec<f64>,
    /// Whether the matrix showed itself not positive definite.
    pub indefinite: bool,
}

/// Solves `A x = b` by preconditioned conjugate gradients to `|r| ≤ tolerance |b|`. Where a direction of no curvature turns
/// up it stops there: with what it has, or with that direction if it has nothing.
pub(super) fn conjugate_gradients(
    apply: impl Fn(&[f64]) -> Vec<f64>,
    precondition: impl Fn(&[f64]) -> Vec<f64>,
    b: &[f64],
    tolerance: f64,
    max_iterations: usize,
) -> Descent {
    let mut x = vec![0.0; b.len()];
    let mut r = b.to_vec();
    let mut p = precondition(&r);
    let mut rho = dot(&r, &p);
    let target = tolerance * norm(b);
    for iteration in 0..max_iterations {
        let q = apply(&p);
        let curvature = dot(&p, &q);
        if curvature.is_nan() || curvature <= 0.0 {
            let x = if iteration == 0 { p } else { x };
            return Descent { x, indefinite: true };
        }
        let alpha = rho / curvature;
        for k in 0..x.len() {
            x[k] += alpha * p[k];
            r[k] -= alpha * q[k];
        }
        if norm(&r) <= target {
            break;
        }
        let s = precondition(&r);
        let next = dot(&r, &s);
        let beta = next / rho;
        rho = next;
        for (p, s) in p.iter_mut().zip(&s) {
            *p = s + beta * *p;
        }
    }
    Descent { x, indefinite: false }
}

/// a · b
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Euclidean norm.
pub(super) fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}
