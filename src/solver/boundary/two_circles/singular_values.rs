//! Singular values of the linearised problem of the two circles.

use std::f64::consts::SQRT_2;

use nalgebra::DMatrix;
use num_complex::Complex64;

use super::{CirclePin, Step, System};
use crate::laplacian::ConformalLaplacian;
use crate::quad_graph::QuadGraph;

/// Where the equations of the two circles are linearised, and which of them with which unknowns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linearised<'a> {
    /// The black boundary values (n).
    pub b: &'a [Complex64],
    /// The mean of the white ones.
    pub w_0: Complex64,
    /// The pinned points, each one equation.
    pub pins: &'a [CirclePin],
    /// Whether ε is an unknown.
    pub with_epsilon: bool,
}

/// The singular values (descending) of the linearised equations, in norms of the smooth limit: b and
/// the residuals of the circles count as mean squares, w_0, ε and the residuals at the pins as they are. Mean squares do not bound
/// the point values at the pins: the smallest singular values fall as √h even where the smooth problem is well posed.
///
/// Takes n products with T and a dense decomposition of order 2n: for small meshes.
pub fn singular_values(laplacian: &ConformalLaplacian, graph: &QuadGraph, linearised: Linearised<'_>) -> Vec<f64> {
    let n = laplacian.len();
    let system = System::at(laplacian, graph, linearised.pins);
    let mut work = laplacian.work();
    let mut z = vec![linearised.w_0; 2 * n];
    linearised.b.iter().enumerate().for_each(|(k, &b)| z[2 * k] = b);
    system.complete(&mut z, &mut work);

    let mean = 1.0 / (2.0 * n as f64).sqrt();
    let rows = 2 * n + linearised.pins.len();
    let mut columns: Vec<f64> = Vec::with_capacity(rows * (2 * n + 3));
    let mut add = |step: &Step, scale: f64| {
        let column = system.derivative(&z, step);
        columns.extend(column.iter().enumerate().map(|(r, x)| if r < 2 * n { scale * mean * x } else { scale * x }));
    };
    let turned = |step: &Step| Step { z: step.z.iter().map(|z| Complex64::I * z).collect(), epsilon: 0.0 };
    for k in 0..n {
        let mut step = Step { z: vec![Complex64::ZERO; 2 * n], epsilon: 0.0 };
        step.z[2 * k] = Complex64::ONE;
        system.complete(&mut step.z, &mut work);
        // A unit of the mean square over n complex numbers.
        add(&step, SQRT_2 / (2.0 * mean));
        add(&turned(&step), SQRT_2 / (2.0 * mean));
    }
    let white = Step { z: (0..2 * n).map(|v| Complex64::new((v % 2) as f64, 0.0)).collect(), epsilon: 0.0 };
    add(&white, 1.0);
    add(&turned(&white), 1.0);
    if linearised.with_epsilon {
        add(&Step { z: vec![Complex64::ZERO; 2 * n], epsilon: 1.0 }, 1.0);
    }
    let matrix = DMatrix::from_vec(rows, columns.len() / rows, columns);
    let mut values: Vec<f64> = matrix.singular_values().iter().copied().collect();
    values.sort_by(|a, b| b.total_cmp(a));
    values
}
