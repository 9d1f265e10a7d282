use crate::io::error::Defect;
use crate::surface::digital::{DigitalError, Solid, words_per_row};

/// Converts voxel values in scan order (x fastest) to bits as they arrive.
///
/// Memory thus grows with the data read, not with the size declared by a header.
pub(super) struct Filler {
    size: [usize; 3],
    threshold: f64,
    bits: Vec<u64>,
    column: usize,
    /// Number of values so far.
    pub values: u64,
    /// The largest value so far.
    pub most: f64,
}

/// A volume, with the numbers for an error message if no voxel is inside.
pub(super) struct Volume {
    pub solid: Solid,
    pub values: u64,
    /// The largest value.
    pub most: f64,
}

impl Filler {
    pub fn new(size: [usize; 3], threshold: f64) -> Self {
        Filler { size, threshold, bits: Vec::new(), column: 0, values: 0, most: f64::NEG_INFINITY }
    }

    /// Appends the value of the next voxel.
    #[inline]
    pub fn push(&mut self, value: f64) {
        let bit = self.column % 64;
        if bit == 0 {
            self.bits.push(0);
        }
        if value > self.threshold
            && let Some(word) = self.bits.last_mut()
        {
            *word |= 1 << bit;
        }
        self.most = self.most.max(value);
        self.values += 1;
        self.column += 1;
        if self.column == self.size[0] {
            self.column = 0;
        }
    }

    /// Returns the volume; missing voxels are outside.
    pub fn finish(mut self, origin: [f64; 3]) -> Volume {
        let [width, height, depth] = self.size;
        self.bits.resize(words_per_row(width) * height * depth, 0);
        let solid = Solid::from_words(self.size, origin, self.bits);
        Volume { solid, values: self.values, most: self.most }
    }
}

/// Returns the number of voxels of a box, or an error if it is too large.
pub(super) fn count(size: [usize; 3]) -> Result<u64, Defect> {
    let product = |[x, y, z]: [u64; 3]| x.checked_mul(y)?.checked_mul(z);
    let [x, y, z] = size.map(|n| n as u64);
    // Rows are padded to 64 voxels.
    let padded = x.checked_next_multiple_of(64).and_then(|x| product([x, y, z]));
    let fits = padded.is_some_and(|n| n <= DigitalError::MOST_VOXELS) && size.iter().all(|&n| n <= i32::MAX as usize);
    let large = || Defect::TooLarge { size, most: DigitalError::MOST_VOXELS };
    product([x, y, z]).filter(|_| fits).ok_or_else(large)
}
