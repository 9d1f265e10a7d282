use std::fmt;

/// What was done to a surface to make it a disc, or closed.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct CutRecord {
    /// The genus of the surface that was cut; 0 where nothing was cut.
    pub genus: u64,
    /// Its boundary loops, which the cut joined.
    pub boundary_loops: usize,
    /// Number of edges that it was cut along.
    pub cut_edges: usize,
    /// Their total length, in the unit of the positions.
    pub cut_length: f64,
    /// Number of holes that were filled.
    pub holes_filled: usize,
    /// Number of faces that this took.
    pub faces_added: usize,
    /// Number of faces removed.
    pub faces_removed: usize,
    /// Vertices where the surface touched itself, and was parted.
    pub vertices_split: usize,
}

impl CutRecord {
    /// Whether nothing was done.
    pub fn is_empty(&self) -> bool {
        *self == CutRecord::default()
    }
}

impl fmt::Display for CutRecord {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let counted = |n: usize, one: &str, many: &str| format!("{n} {}", if n == 1 { one } else { many });
        let mut parts = Vec::new();
        if self.faces_removed > 0 {
            parts.push(format!("{} removed", counted(self.faces_removed, "face", "faces")));
        }
        if self.vertices_split > 0 {
            let vertices = counted(self.vertices_split, "vertex", "vertices");
            parts.push(format!("parted at {vertices} where the surface touched itself"));
        }
        if self.holes_filled > 0 {
            let holes = counted(self.holes_filled, "hole", "holes");
            parts.push(format!("{holes} filled with {}", counted(self.faces_added, "face", "faces")));
        }
        if self.cut_edges > 0 {
            let loops = match self.boundary_loops {
                0 => "no boundary".to_owned(),
                n => counted(n, "boundary loop", "boundary loops"),
            };
            let edges = counted(self.cut_edges, "edge", "edges");
            parts.push(format!("cut along {edges} of length {:.4} (genus {}, {loops})", self.cut_length, self.genus));
        }
        if parts.is_empty() { write!(out, "nothing to do") } else { write!(out, "{}", parts.join("; ")) }
    }
}
