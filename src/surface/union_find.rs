/// Disjoint sets of `0 .. n` with path halving; the smallest member represents its set.
#[derive(Clone, Debug)]
pub(crate) struct UnionFind {
    parent: Vec<u32>,
}

impl UnionFind {
    /// `n` sets of one element each.
    pub fn new(n: usize) -> Self {
        UnionFind { parent: (0..n as u32).collect() }
    }

    /// The smallest member of `x`'s set.
    pub fn find(&mut self, mut x: u32) -> u32 {
        while self.parent[x as usize] != x {
            let grandparent = self.parent[self.parent[x as usize] as usize];
            self.parent[x as usize] = grandparent;
            x = grandparent;
        }
        x
    }

    /// Makes one set of those of `a` and `b`.
    pub fn unite(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.parent[a.max(b) as usize] = a.min(b);
    }

    /// A number for every element's set, counted in the order of first members, and how many sets there are.
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
