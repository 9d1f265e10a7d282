//! The six directions of the voxel grid.
//!
//! Direction `2 axis + 1` points along an axis and `2 axis` in the opposite direction.

/// Number of directions.
pub(super) const DIRECTIONS: u8 = 6;

/// Returns the neighbour of a voxel in a direction.
pub(super) fn step(mut voxel: [i32; 3], direction: u8) -> [i32; 3] {
    voxel[usize::from(direction / 2)] += if direction % 2 == 1 { 1 } else { -1 };
    voxel
}

/// Returns the opposite direction.
pub(super) const fn opposite(direction: u8) -> u8 {
    direction ^ 1
}

/// Directions of the edges of a surfel, by its outward direction: edge `k`, from corner `k` to
/// corner `k + 1`, lies on side `SIDES[direction][k]` of the surfel. Corners are counter-clockwise
/// seen from outside.
pub(super) const SIDES: [[u8; 4]; 6] = sides();

/// The inverse of [`SIDES`]: `EDGE_ON[direction][side]` is the edge on that side, or 4 if there is
/// none.
pub(super) const EDGE_ON: [[u8; 6]; 6] = edges();

const fn sides() -> [[u8; 4]; 6] {
    let mut sides = [[0; 4]; 6];
    let mut direction = 0;
    while direction < 6 {
        let axis = direction / 2;
        // (axis, b, c) is a cyclic permutation of (x, y, z): b turns to c counter-clockwise seen
        // along −axis.
        let (b, c) = ((axis + 1) % 3 * 2, (axis + 2) % 3 * 2);
        let (b, c) = (b as u8, c as u8);
        sides[direction] = if direction % 2 == 1 { [c, b + 1, c + 1, b] } else { [b, c + 1, b + 1, c] };
        direction += 1;
    }
    sides
}

const fn edges() -> [[u8; 6]; 6] {
    let mut edges = [[4; 6]; 6];
    let mut direction = 0;
    while direction < 6 {
        let mut edge = 0;
        while edge < 4 {
            edges[direction][SIDES[direction][edge] as usize] = edge as u8;
            edge += 1;
        }
        direction += 1;
    }
    edges
}

/// Returns corner `k` of a surfel relative to the centre of its inner voxel, in units of a voxel's
/// side.
///
/// The corner lies on the edges `k − 1` and `k`.
pub(super) fn corner(direction: u8, k: usize) -> [f64; 3] {
    let mut offset = [0.0; 3];
    let sides = SIDES[usize::from(direction)];
    for side in [direction, sides[k], sides[(k + 3) % 4]] {
        offset[usize::from(side / 2)] = if side % 2 == 1 { 0.5 } else { -0.5 };
    }
    offset
}

#[cfg(test)]
mod tests {
    use super::{EDGE_ON, SIDES, corner};
    use crate::geometry::vector::{cross, dot, sub};

    #[test]
    fn corners_of_every_surfel_are_counter_clockwise_seen_from_outside() {
        for direction in 0..6 {
            let p = [0, 1, 2, 3].map(|k| corner(direction, k));
            let mut outward = [0.0; 3];
            outward[usize::from(direction / 2)] = if direction % 2 == 1 { 1.0 } else { -1.0 };
            for k in 0..4 {
                let normal = cross(sub(p[(k + 1) % 4], p[k]), sub(p[(k + 2) % 4], p[(k + 1) % 4]));
                assert_eq!(dot(normal, outward), 1.0);
                assert_eq!(dot(p[k], outward), 0.5);
            }
        }
    }

    #[test]
    fn edges_lie_on_the_sides_that_the_table_says() {
        for direction in 0..6 {
            for (edge, side) in SIDES[direction as usize].into_iter().enumerate() {
                assert_eq!(EDGE_ON[direction as usize][usize::from(side)], edge as u8);
                let sign = if side % 2 == 1 { 0.5 } else { -0.5 };
                for end in [edge, (edge + 1) % 4] {
                    assert_eq!(corner(direction, end)[usize::from(side / 2)], sign);
                }
            }
        }
    }
}
