/// Coupled vertices and their position.
#[derive(Clone, Copy)]
pub(super) struct Piece {
    /// The sum of the positions of the vertices, equivalent to their mean for comparisons.
    pub at: [f64; 3],
    /// The vertices.
    pub vertices: [u32; 4],
}

impl Piece {
    /// The piece of these vertices, `places` being the positions of all.
    pub fn new(vertices: [u32; 4], places: &[[f64; 3]]) -> Self {
        let [a, b, c, d] = vertices.map(|v| places[v as usize]);
        Piece { at: [0, 1, 2].map(|axis| a[axis] + b[axis] + c[axis] + d[axis]), vertices }
    }

    /// A piece whose position is irrelevant.
    #[cfg(test)]
    pub fn nowhere(vertices: [u32; 4]) -> Self {
        Piece { at: [0.0; 3], vertices }
    }
}
