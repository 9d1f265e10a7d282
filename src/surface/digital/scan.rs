use super::direction::DIRECTIONS;
use super::solid::{set_bits, words_per_row};
use super::{DigitalError, Solid, Surfel};

/// All surfels of a solid in scan order of their inner voxels, with an index to find them.
pub(super) struct Scan {
    pub surfels: Vec<Surfel>,
    /// One bit for each voxel that has surfels.
    border: Vec<u64>,
    /// Number of such voxels before each word of `border`.
    rank: Vec<u32>,
    /// The first surfel of each such voxel.
    first: Vec<u32>,
    /// Directions of the surfels of each such voxel, one bit each.
    directions: Vec<u8>,
}

impl Scan {
    /// Scans the solid in two passes of 64 voxels at a time: one counts, one collects.
    pub fn new(solid: &Solid) -> Result<Self, DigitalError> {
        let size = solid.size();
        if size.iter().any(|&n| n > i32::MAX as usize) {
            return Err(DigitalError::TooLarge { size });
        }
        let (mut voxels, mut surfels) = (0_usize, 0_u64);
        each_word(solid, |_, _, exposed| {
            voxels += exposed.iter().fold(0, |any, w| any | w).count_ones() as usize;
            surfels += exposed.iter().map(|w| u64::from(w.count_ones())).sum::<u64>();
        });
        if surfels == 0 {
            return Err(DigitalError::Empty { size });
        }
        if surfels > DigitalError::MOST_SURFELS {
            return Err(DigitalError::TooManySurfels { surfels });
        }
        let mut scan = Scan {
            surfels: Vec::with_capacity(surfels as usize),
            border: Vec::with_capacity(solid.words()),
            rank: Vec::with_capacity(solid.words()),
            first: Vec::with_capacity(voxels),
            directions: Vec::with_capacity(voxels),
        };
        each_word(solid, |first_voxel, _, exposed| scan.push_word(first_voxel, exposed));
        Ok(scan)
    }

    fn push_word(&mut self, [i, j, k]: [i32; 3], exposed: [u64; 6]) {
        let any = exposed.iter().fold(0, |any, w| any | w);
        self.border.push(any);
        self.rank.push(self.first.len() as u32);
        for bit in set_bits(any) {
            self.first.push(self.surfels.len() as u32);
            let mut directions = 0;
            for direction in (0..DIRECTIONS).filter(|&d| exposed[usize::from(d)] >> bit & 1 == 1) {
                directions |= 1 << direction;
                self.surfels.push(Surfel::new([i + bit as i32, j, k], direction));
            }
            self.directions.push(directions);
        }
    }

    /// Returns the index of a surfel of `solid`; `None` outside of the box. The surfel must exist.
    pub fn find(&self, solid: &Solid, voxel: [i32; 3], direction: u8) -> Option<u32> {
        let (word, bit) = solid.place(voxel)?;
        let below = (1_u64 << bit) - 1;
        let rank = (self.rank[word] + (self.border[word] & below).count_ones()) as usize;
        let before = (self.directions[rank] & ((1 << direction) - 1)).count_ones();
        Some(self.first[rank] + before)
    }
}

/// Calls `visit` for every word with its first voxel, the word, and one word for each of the six
/// directions that marks the inner voxels whose neighbour in that direction is outside.
fn each_word(solid: &Solid, mut visit: impl FnMut([i32; 3], u64, [u64; 6])) {
    let [width, height, depth] = solid.size();
    let outside = vec![0; words_per_row(width)];
    let row = |j: Option<usize>, k: Option<usize>| match (j, k) {
        (Some(j), Some(k)) if j < height && k < depth => solid.row(j, k),
        _ => &outside[..],
    };
    for k in 0..depth {
        for j in 0..height {
            let here = solid.row(j, k);
            let beside = [
                row(j.checked_sub(1), Some(k)),
                row(Some(j + 1), Some(k)),
                row(Some(j), k.checked_sub(1)),
                row(Some(j), Some(k + 1)),
            ];
            for (w, &word) in here.iter().enumerate() {
                let before = if w > 0 { here[w - 1] >> 63 } else { 0 };
                let after = here.get(w + 1).map_or(0, |next| next << 63);
                let neighbours =
                    [word << 1 | before, word >> 1 | after, beside[0][w], beside[1][w], beside[2][w], beside[3][w]];
                visit([64 * w as i32, j as i32, k as i32], word, neighbours.map(|n| word & !n));
            }
        }
    }
}
