/// A set of voxels in a box, one bit each. Outside of the box nothing is inside.
///
/// Voxel (i, j, k) is the unit cube around the point `origin + (i, j, k)`.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    size: [usize; 3],
    origin: [f64; 3],
    bits: Vec<u64>,
}

impl Solid {
    /// No voxel in a box of `size` voxels.
    pub fn empty(size: [usize; 3], origin: [f64; 3]) -> Self {
        let words = size[0].div_ceil(64) * size[1] * size[2];
        Solid { size, origin, bits: vec![0; words] }
    }

    /// The extent of the box in voxels.
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

    /// Whether a voxel belongs to the solid; none outside of the box does.
    pub fn contains(&self, voxel: [i32; 3]) -> bool {
        match self.place(voxel) {
            Some((word, bit)) => self.bits[word] >> bit & 1 == 1,
            None => false,
        }
    }

    /// Puts a voxel in; one outside of the box is ignored.
    pub fn insert(&mut self, voxel: [i32; 3]) {
        if let Some((word, bit)) = self.place(voxel) {
            self.bits[word] |= 1 << bit;
        }
    }

    /// Number of voxels.
    pub fn len(&self) -> usize {
        self.bits.iter().map(|word| word.count_ones() as usize).sum()
    }

    /// Whether there is no voxel.
    pub fn is_empty(&self) -> bool {
        self.bits.iter().all(|&word| word == 0)
    }

    fn place(&self, [i, j, k]: [i32; 3]) -> Option<(usize, u32)> {
        let [width, height, depth] = self.size;
        let (i, j, k) = (usize::try_from(i).ok()?, usize::try_from(j).ok()?, usize::try_from(k).ok()?);
        (i < width && j < height && k < depth)
            .then(|| ((k * height + j) * width.div_ceil(64) + i / 64, (i % 64) as u32))
    }
}
