/// The random number generator SplitMix64 (Steele, Lea, Flood, OOPSLA 2014): the same seed gives
/// the same numbers on every machine.
pub(super) struct Random(u64);

impl Random {
    pub(super) fn new(seed: u64) -> Self {
        Random(seed)
    }

    pub(super) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Returns a uniform random number in [−1, 1).
    pub(super) fn symmetric(&mut self) -> f64 {
        const HALF: f64 = (1_u64 << 52) as f64;
        (self.bits() >> 11) as f64 / HALF - 1.0
    }

    /// Returns a uniform random point of [−1, 1)².
    pub(super) fn square(&mut self) -> [f64; 2] {
        [self.symmetric(), self.symmetric()]
    }

    /// Returns a uniform random point of the square of half side `reach` around `middle`.
    pub(super) fn square_around(&mut self, middle: [f64; 2], reach: f64) -> [f64; 2] {
        let [x, y] = self.square();
        [middle[0] + reach * x, middle[1] + reach * y]
    }
}

#[cfg(test)]
mod tests {
    use super::Random;

    #[test]
    fn numbers_are_those_of_the_published_splitmix64() {
        let mut random = Random::new(0);
        assert_eq!([random.bits(), random.bits()], [0xe220_a839_7b1d_cdaf, 0x6e78_9e6a_a1b9_65f4]);
    }
}
