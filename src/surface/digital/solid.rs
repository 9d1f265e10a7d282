use std::ops::Range;

/// A set of voxels in a box, stored as one bit each. Voxels outside of the box are outside of the
/// set.
///
/// Voxel (i, j, k) is the unit cube around the point `origin + (i, j, k)`. *Scan order* is the
/// lexicographic order of (k, j, i): the first coordinate varies fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    size: [usize; 3],
    origin: [f64; 3],
    /// Rows (j, k) of `words_per_row` words; bits beyond the end of a row are 0.
    bits: Vec<u64>,
}

impl Solid {
    /// Returns the empty set in a box of `size` voxels.
    ///
    /// It takes one bit of memory for each voxel, rows being padded to a multiple of 64. Check
    /// sizes that come from outside against
    /// [`DigitalError::MOST_VOXELS`](super::DigitalError::MOST_VOXELS) first.
    pub fn empty(size: [usize; 3], origin: [f64; 3]) -> Self {
        let words = words_per_row(size[0]).saturating_mul(size[1]).saturating_mul(size[2]);
        Solid { size, origin, bits: vec![0; words] }
    }

    /// Returns the set of voxels whose bits are set. Rows are whole words; bits beyond a row's end
    /// must be 0.
    pub(crate) fn from_words(size: [usize; 3], origin: [f64; 3], bits: Vec<u64>) -> Self {
        debug_assert_eq!(bits.len(), words_per_row(size[0]) * size[1] * size[2]);
        Solid { size, origin, bits }
    }

    /// Number of voxels of the box along each axis.
    pub fn size(&self) -> [usize; 3] {
        self.size
    }

    /// The centre of voxel (0, 0, 0).
    pub fn origin(&self) -> [f64; 3] {
        self.origin
    }

    /// The centre of a voxel.
    pub fn centre(&self, voxel: [i32; 3]) -> [f64; 3] {
        [0, 1, 2].map(|k| self.origin[k] + f64::from(voxel[k]))
    }

    /// Whether a voxel belongs to the set; voxels outside of the box do not.
    pub fn contains(&self, voxel: [i32; 3]) -> bool {
        match self.place(voxel) {
            Some((word, bit)) => self.bits[word] >> bit & 1 == 1,
            None => false,
        }
    }

    /// Inserts a voxel; does nothing outside of the box.
    pub fn insert(&mut self, voxel: [i32; 3]) {
        if let Some((word, bit)) = self.place(voxel) {
            self.bits[word] |= 1 << bit;
        }
    }

    /// Inserts the voxels (i, j, k) with `i` in `run`; ignores those outside of the box.
    pub fn insert_run(&mut self, run: Range<usize>, j: usize, k: usize) {
        if j >= self.size[1] || k >= self.size[2] {
            return;
        }
        let row = (k * self.size[1] + j) * words_per_row(self.size[0]);
        let (mut i, end) = (run.start, run.end.min(self.size[0]));
        while i < end {
            let (bit, count) = (i % 64, (64 - i % 64).min(end - i));
            self.bits[row + i / 64] |= (u64::MAX >> (64 - count)) << bit;
            i += count;
        }
    }

    /// Number of voxels in the set.
    pub fn len(&self) -> usize {
        self.bits.iter().map(|word| word.count_ones() as usize).sum()
    }

    /// Whether the set is empty.
    pub fn is_empty(&self) -> bool {
        self.bits.iter().all(|&word| word == 0)
    }

    /// Returns the row of voxels (·, j, k): bit `i % 64` of word `i / 64` is voxel (i, j, k). Rows
    /// outside of the box are empty slices.
    pub fn row(&self, j: usize, k: usize) -> &[u64] {
        let words = words_per_row(self.size[0]);
        if j >= self.size[1] || k >= self.size[2] {
            return &[];
        }
        let start = (k * self.size[1] + j) * words;
        &self.bits[start..start + words]
    }

    /// Iterates over the voxels of the set in scan order.
    pub fn voxels(&self) -> impl Iterator<Item = [i32; 3]> + '_ {
        let words = words_per_row(self.size[0]).max(1);
        self.bits.iter().enumerate().filter(|&(_, &word)| word != 0).flat_map(move |(at, &word)| {
            let (row, first) = (at / words, 64 * (at % words));
            let [j, k] = [row % self.size[1], row / self.size[1]];
            set_bits(word).map(move |bit| [(first + bit as usize) as i32, j as i32, k as i32])
        })
    }

    /// Returns the word and the bit of a voxel of the box.
    pub(super) fn place(&self, [i, j, k]: [i32; 3]) -> Option<(usize, u32)> {
        let [width, height, depth] = self.size;
        let (i, j, k) = (usize::try_from(i).ok()?, usize::try_from(j).ok()?, usize::try_from(k).ok()?);
        (i < width && j < height && k < depth)
            .then(|| ((k * height + j) * words_per_row(width) + i / 64, (i % 64) as u32))
    }

    /// Total number of words.
    pub(super) fn words(&self) -> usize {
        self.bits.len()
    }
}

/// Number of words for a row of `width` voxels.
pub(crate) fn words_per_row(width: usize) -> usize {
    width.div_ceil(64)
}

/// Iterates over the positions of the bits that are set, in ascending order.
pub(super) fn set_bits(mut word: u64) -> impl Iterator<Item = u32> {
    std::iter::from_fn(move || {
        let bit = word.trailing_zeros();
        word &= word.wrapping_sub(1);
        (bit < 64).then_some(bit)
    })
}
