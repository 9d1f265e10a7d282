/// Disjoint sets of `0 .. n`, with path halving; the smallest member represents its set.
#[derive(Clone, Debug)]
pub(crate) struct UnionFind {
    parent: Vec<u32>,
}

impl UnionFind {
    /// Makes `n` sets of one element each.
    pub fn new(n: usize) -> Self {
        UnionFind { parent: (0..n as u32).collect() }
    }

    /// Returns the smallest member of the set of `x`.
    pub fn find(&mut self, mut x: u32) -> u32 {
        while self.parent[x as usize] != x {
            let grandparent = self.parent[self.parent[x as usize] as usize];
            self.parent[x as usize] = grandparent;
            x = grandparent;
        }
        x
    }

    /// Unites the sets of `a` and `b`.
    pub fn unite(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.parent[a.max(b) as usize] = a.min(b);
    }

    /// Numbers the sets in the order of their first members; returns the number of each element's
    /// set and the number of sets.
    pub fn labels(mut self) -> (Vec<u32>, usize) {
        let mut label = vec![0u32; self.parent.len()];
        let mut count = 0;
        for x in 0..label.len() as u32 {
            let root = self.find(x);
            label[x as usize] = if root == x {
                count += 1;
                count - 1
            } else {
                label[root as usize]
            };
        }
        (label, count as usize)
    }
}
