use super::levenberg_marquardt::add_damping;
use crate::energy::Curvature;
use crate::problem::nonlinear::{HessianAssembly, Objective};

/// Returns the smallest singular value σ of the Jacobian J of all residuals (multiplied by the
/// square roots of their coefficients) at y; `None` if no factor can be computed.
///
/// The method is inverse iteration on `JᵀJ`, half of the Gauss–Newton Hessian, with σ = |Jx|
/// computed from J. The result is always an upper bound.
///
/// # Rationale
/// The matrix `JᵀJ` hides values below 1e-8 of the largest entry of J. Its null vector is accurate
/// to rounding divided by the square of the *next* singular value, so that a single small σ is
/// known to about 1e-12 of the largest.
pub fn smallest_singular_value(objective: &Objective, y: &[f64]) -> Option<f64> {
    if y.is_empty() {
        return None;
    }
    let assembly = HessianAssembly::new(objective);
    let columns = assembly.columns();
    let mut values = assembly.values(y, Curvature::GaussNewton);
    for value in &mut values {
        *value *= 0.5;
    }
    let mut shifted = values.clone();
    let analysis = assembly.analysis().ok()?;
    // A shift of a few rounding errors makes a singular matrix definite; the Rayleigh quotient is
    // that of the matrix without the shift.
    let factor = [0.0, 1e-15, 1e-14, 1e-13, 1e-12].into_iter().find_map(|shift| {
        shifted.clone_from(&values);
        add_damping(columns, &mut shifted, shift);
        analysis.factorise(&shifted, None).ok()
    })?;
    // 1e-14 of the largest entry of J; smaller values only fluctuate.
    let rounding = 1e-28 * values.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    // A fixed start without symmetries.
    let mut x: Vec<f64> = (0..y.len()).map(|k| ((k as f64 + 1.0) * 0.7548776662466927).fract() - 0.5).collect();
    let mut quotient = f64::INFINITY;
    for _ in 0..60 {
        normalise(&mut x);
        factor.solve_in_place(&mut x);
        normalise(&mut x);
        let product = || columns.multiply(&values, &x).iter().zip(&x).map(|(a, b)| a * b).sum::<f64>().max(0.0);
        let next = objective.stretch(y, &x).unwrap_or_else(product);
        let settled = (quotient - next).abs() <= 1e-6 * next || next <= rounding;
        quotient = quotient.min(next);
        if settled {
            break;
        }
    }
    quotient.is_finite().then(|| quotient.sqrt())
}

fn normalise(x: &mut [f64]) {
    let length = super::executor::norm(x);
    x.iter_mut().for_each(|x| *x /= length);
}
