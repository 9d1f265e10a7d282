//! A square in every format, for the tests of reading and writing.
// each test binary uses a part of it
#![allow(dead_code)]

use riemap::io::{self, Format, MeshFile, ParseError};
use riemap::surface::Surface;

pub fn good(format: Format, content: impl AsRef<[u8]>) -> MeshFile {
    let content = content.as_ref();
    io::parse(content, format).unwrap_or_else(|e| panic!("{e}\n{}", String::from_utf8_lossy(content)))
}

pub fn bad(format: Format, content: impl AsRef<[u8]>) -> ParseError {
    io::parse(content.as_ref(), format).expect_err("a malformed file is refused")
}

/// Two triangles of the unit square.
pub fn square() -> Surface {
    let positions = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    crate::common::surface(positions, [[0, 1, 2], [0, 2, 3]])
}

pub const SQUARE_OBJ: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";
pub const SQUARE_OFF: &str = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
pub const SQUARE_PLY: &str = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
    element face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
pub const SQUARE_STL: &str = "solid a square\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\n\
    endloop\nendfacet\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\n\
    endsolid a square\n";
pub const SQUARES: [(Format, &str); 4] =
    [(Format::Obj, SQUARE_OBJ), (Format::Off, SQUARE_OFF), (Format::Ply, SQUARE_PLY), (Format::Stl, SQUARE_STL)];

pub fn without_normals(mesh: MeshFile) -> Surface {
    crate::common::surface(mesh.surface.positions().to_vec(), mesh.surface.faces().iter())
}
