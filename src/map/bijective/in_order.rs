//! Reordering of boundary points along the circle.

use num_complex::Complex64;

use super::patch::Patch;

/// Sorts the boundary points of the mesh along the circle. Points that are out of order are spread over the arc that
/// they occupy, in proportion to their rest lengths. Returns false if that is not possible.
pub(super) fn put_in_order(patch: &Patch, z: &mut [Complex64]) -> bool {
    let (edges, lengths) = (&patch.mesh_edges, &patch.mesh_lengths);
    // From one pinned vertex to the next.
    let n = edges.len();
    let Some(first) = (0..n).find(|&k| patch.held[edges[k][0] as usize]) else { return n == 0 };
    let mut k = first;
    while k < first + n {
        let mut run = vec![edges[k % n][0]];
        let mut arc = vec![0.0];
        loop {
            let (edge, length) = (edges[k % n], lengths[k % n]);
            k += 1;
            run.push(edge[1]);
            arc.push(arc[arc.len() - 1] + length);
            if patch.held[edge[1] as usize] || k == first + n {
                break;
            }
        }
        if !order_run(&run, &arc, z) {
            return false;
        }
    }
    true
}

/// Sorts the inner points of a run along the circle between its ends; returns false if the ends are out of order.
fn order_run(run: &[u32], arc: &[f64], z: &mut [Complex64]) -> bool {
    let m = run.len();
    let mut angle = vec![z[run[0] as usize].arg()];
    for pair in run.windows(2) {
        let ahead = z[pair[1] as usize] * z[pair[0] as usize].conj();
        angle.push(angle[angle.len() - 1] + ahead.arg());
    }
    if angle[m - 1] <= angle[0] {
        return m == 1;
    }
    let mut from_end = angle.clone();
    for k in (0..m - 1).rev() {
        from_end[k] = from_end[k].min(from_end[k + 1]);
    }
    let (mut first, mut highest) = (0, f64::NEG_INFINITY);
    let mut last_of_before = None;
    for k in 0..m {
        highest = highest.max(angle[k]);
        if k + 1 < m && highest >= from_end[k + 1] {
            continue;
        }
        if k > first {
            // The block first ..= k, between its neighbours or the ends of the run.
            let low = if first == 0 { 0 } else { first - 1 };
            let high = if k == m - 1 { m - 1 } else { k + 1 };
            let (from, to) = (last_of_before.unwrap_or(angle[0]), angle[high]);
            for i in (low + 1)..high {
                let t = (arc[i] - arc[low]) / (arc[high] - arc[low]);
                angle[i] = from + t * (to - from);
                z[run[i] as usize] = Complex64::cis(angle[i]);
            }
        }
        last_of_before = Some(angle[k]);
        (first, highest) = (k + 1, f64::NEG_INFINITY);
    }
    true
}
