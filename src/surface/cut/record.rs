use std::fmt;

/// A record of the steps that turned a surface into a disc or closed it.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct CutRecord {
    /// Genus of the surface that was cut; 0 if nothing was cut.
    pub genus: u64,
    /// Number of boundary loops, which the cut joined.
    pub boundary_loops: usize,
    /// Number of edges in the cut.
    pub cut_edges: usize,
    /// Total length of the cut, in the unit of the positions.
    pub cut_length: f64,
    /// Number of holes that were filled.
    pub holes_filled: usize,
    /// Number of faces that fill these holes.
    pub faces_added: usize,
    /// Number of faces that were removed.
    pub faces_removed: usize,
    /// Number of vertices that were split because the surface touched itself there.
    pub vertices_split: usize,
}

impl CutRecord {
    /// Whether the surface was left unchanged.
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
            parts.push(format!("split at {vertices} where the surface touched itself"));
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
