use super::norm::{dot, norm};

/// Solves `A x = b` to `|b − A x| ≤ tolerance |b|` by GMRES without restart, at most `longest` products. Returns x, the
/// relative residual, and the number of products.
pub(super) fn gmres(
    mut apply: impl FnMut(&[f64]) -> Vec<f64>,
    b: &[f64],
    tolerance: f64,
    longest: usize,
) -> (Vec<f64>, f64, usize) {
    let size = norm(b);
    let mut basis: Vec<Vec<f64>> = vec![b.iter().map(|b| b / size).collect()];
    // Columns of the triangular factor, the rotations that made it, and the rotated right-hand side.
    let (mut columns, mut rotations): (Vec<Vec<f64>>, Vec<(f64, f64)>) = (Vec::new(), Vec::new());
    let mut right = vec![size];
    for step in 0..longest {
        let mut w = apply(&basis[step]);
        let mut column = Vec::with_capacity(step + 2);
        for v in &basis {
            let part = dot(&w, v);
            w.iter_mut().zip(v).for_each(|(w, v)| *w -= part * v);
            column.push(part);
        }
        let rest = norm(&w);
        for (k, &(c, s)) in rotations.iter().enumerate() {
            (column[k], column[k + 1]) = (c * column[k] + s * column[k + 1], c * column[k + 1] - s * column[k]);
        }
        let diagonal = column[step].hypot(rest);
        if !(diagonal > 0.0 && diagonal.is_finite()) {
            break;
        }
        let (c, s) = (column[step] / diagonal, rest / diagonal);
        column[step] = diagonal;
        rotations.push((c, s));
        columns.push(column);
        right.push(-s * right[step]);
        right[step] *= c;
        if right[step + 1].abs() <= tolerance * size || rest == 0.0 {
            break;
        }
        basis.push(w.iter().map(|w| w / rest).collect());
    }
    let steps = columns.len();
    let mut y = right[..steps].to_vec();
    for k in (0..steps).rev() {
        y[k] /= columns[k][k];
        for j in 0..k {
            y[j] -= columns[k][j] * y[k];
        }
    }
    let mut x = vec![0.0; b.len()];
    for (v, y) in basis.iter().zip(&y) {
        x.iter_mut().zip(v).for_each(|(x, v)| *x += y * v);
    }
    (x, right[steps].abs() / size, steps)
}
