//! Moments of the voxels in balls around surfels, computed by runs of voxels in rows.

use crate::surface::digital::{Solid, Surfel};

/// A ball around the centre of a surfel as rows of voxels. There are six kinds, by the direction of
/// the surfel.
pub(super) struct VoxelBall {
    /// Centre of the ball minus centre of the inner voxel, times 2.
    centre: [i64; 3],
    rows: Vec<BallRow>,
}

/// The voxels `first ..= last` of the row (j, k), relative to the surfel's inner voxel.
struct BallRow {
    j: i32,
    k: i32,
    first: i32,
    last: i32,
}

/// Moments `Σ 1`, `Σ p_i`, `Σ p_i p_j` over voxel centres p relative to the surfel's centre, times
/// 2 so that they are integers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Moments {
    /// Number of voxels.
    pub count: i64,
    /// Σ p.
    pub first: [i64; 3],
    /// Σ p pᵀ in the order xx, yy, zz, yz, zx, xy.
    pub second: [i64; 6],
}

impl VoxelBall {
    /// Finds the voxels whose centres are at distance at most `radius` from the surfel's centre.
    pub(super) fn new(axis: u8, positive: bool, radius: f64) -> Self {
        let mut centre = [0; 3];
        centre[usize::from(axis)] = if positive { 1 } else { -1 };
        let reach = radius.ceil() as i32 + 1;
        let inside = |i: i32, j: i32, k: i32| {
            let doubled = [i, j, k].map(i64::from);
            let square: i64 = (0..3).map(|a| (2 * doubled[a] - centre[a]).pow(2)).sum();
            square as f64 <= 4.0 * radius * radius
        };
        let mut rows = Vec::new();
        for k in -reach..=reach {
            for j in -reach..=reach {
                let first = (-reach..=reach).find(|&i| inside(i, j, k));
                let last = (-reach..=reach).rev().find(|&i| inside(i, j, k));
                if let (Some(first), Some(last)) = (first, last) {
                    rows.push(BallRow { j, k, first, last });
                }
            }
        }
        VoxelBall { centre, rows }
    }

    /// Computes the moments of the voxels of `solid` in the ball around the centre of `surfel`.
    pub(super) fn moments(&self, solid: &Solid, surfel: &Surfel) -> Moments {
        let mut m = Moments::default();
        let [width, ..] = solid.size();
        for row in &self.rows {
            let (j, k) = (surfel.voxel[1] + row.j, surfel.voxel[2] + row.k);
            let (Ok(j), Ok(k)) = (usize::try_from(j), usize::try_from(k)) else { continue };
            let words = solid.row(j, k);
            let first = (surfel.voxel[0] + row.first).max(0) as usize;
            let end = (surfel.voxel[0] + row.last + 1).clamp(0, width as i32) as usize;
            if words.is_empty() || first >= end {
                continue;
            }
            // Twice the x coordinate of voxel 0 of the row.
            let zero = -(2 * i64::from(surfel.voxel[0]) + self.centre[0]);
            let (mut n, mut x, mut xx) = (0, 0, 0);
            let last_word = (end - 1) / 64;
            for (at, &word) in words.iter().enumerate().take(last_word + 1).skip(first / 64) {
                let mut word = word;
                if at == first / 64 {
                    word &= u64::MAX << (first % 64);
                }
                if at == last_word {
                    word &= u64::MAX >> (63 - (end - 1) % 64);
                }
                while word != 0 {
                    let start = word.trailing_zeros();
                    let length = (word >> start).trailing_ones();
                    word &= u64::MAX.checked_shl(start + length).unwrap_or(0);
                    // The l numbers with step 2 around the mean c have Σ = l c and Σ² = l (c² + (l²
                    // − 1)/3).
                    let l = i64::from(length);
                    let c = zero + 2 * (64 * at as i64 + i64::from(start)) + l - 1;
                    n += l;
                    x += l * c;
                    xx += l * c * c + l * (l * l - 1) / 3;
                }
            }
            let (y, z) = (2 * i64::from(row.j) - self.centre[1], 2 * i64::from(row.k) - self.centre[2]);
            m.count += n;
            m.first = [m.first[0] + x, m.first[1] + n * y, m.first[2] + n * z];
            let [a, b, c, d, e, f] = m.second;
            m.second = [a + xx, b + n * y * y, c + n * z * z, d + n * y * z, e + x * z, f + x * y];
        }
        m
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_are_the_sums_over_the_voxels_of_the_ball() {
        // Rows of two and a half words, filled with a pattern without symmetry.
        let mut solid = Solid::empty([150, 12, 11], [0.0; 3]);
        for k in 0..11 {
            for j in 0..12 {
                for i in (0..150).filter(|i| (i * i + 3 * j * i + 5 * k) % 7 < 4) {
                    solid.insert([i, j, k]);
                }
            }
        }
        for (axis, positive, voxel) in
            [(0, true, [63, 5, 5]), (0, false, [64, 6, 4]), (1, true, [2, 11, 0]), (2, false, [149, 1, 10])]
        {
            for radius in [0.5, 1.0, 3.3, 9.0, 80.0] {
                let mut expected = Moments::default();
                let mut centre = voxel.map(|x: i32| 2 * i64::from(x));
                centre[usize::from(axis)] += if positive { 1 } else { -1 };
                for v in solid.voxels() {
                    let p = [0, 1, 2].map(|a| 2 * i64::from(v[a]) - centre[a]);
                    if p.iter().map(|x| x * x).sum::<i64>() as f64 <= 4.0 * radius * radius {
                        let [x, y, z] = p;
                        let second = [x * x, y * y, z * z, y * z, z * x, x * y];
                        expected.count += 1;
                        expected.first = [0, 1, 2].map(|a| expected.first[a] + p[a]);
                        expected.second = [0, 1, 2, 3, 4, 5].map(|a| expected.second[a] + second[a]);
                    }
                }
                let surfel = Surfel { voxel, axis, positive };
                let found = VoxelBall::new(axis, positive, radius).moments(&solid, &surfel);
                assert_eq!(found, expected, "{surfel:?}, radius {radius}");
            }
        }
    }
}
