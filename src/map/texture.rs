use super::Mapped;
use crate::io::Uv;
use crate::map::periodic::Tiling;
use crate::surface::Surface;
use crate::surface::oriented_mesh::OrientedMesh;

/// Texture coordinates of a surface, read from its map.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureCoordinates {
    /// The coordinate pairs; (0, 0) for unmapped vertices and corners.
    pub coordinates: Vec<[f64; 2]>,
    /// The index of the pair of every corner of the source, face by face; `None` if every vertex has one pair.
    pub corners: Option<Vec<u32>>,
}

impl TextureCoordinates {
    /// The coordinates in the form that writers take.
    pub fn uv(&self) -> Uv<'_> {
        match &self.corners {
            None => Uv::PerVertex(&self.coordinates),
            Some(corners) => Uv::PerCorner { coordinates: &self.coordinates, corners },
        }
    }

    /// Returns the pair of every corner of `surface`, face by face.
    pub fn of_corners(&self, surface: &Surface) -> Vec<[f64; 2]> {
        let pairs = self.corners.as_deref().unwrap_or(surface.faces.corners());
        pairs.iter().map(|&k| self.coordinates[k as usize]).collect()
    }
}

impl Mapped {
    /// Returns the texture coordinates of `surface`, the source of this map: one pair for each vertex if that suffices;
    /// pairs for corners if the surface was cut, if faces were removed (their corners are at (0, 0)), or if the map has
    /// periods. `tiling` lays out maps with periods.
    pub fn texture_coordinates(&self, surface: &Surface, tiling: Tiling) -> TextureCoordinates {
        let (disc, map) = (&self.domain.disc, &self.map);
        let (mut coordinates, mut corners) = match &self.torus {
            None if !disc.is_cut() && disc.source_faces() == surface.faces.len() => {
                let mut coordinates = vec![[0.0; 2]; surface.positions.len()];
                for (&v, z) in disc.source_vertex.iter().zip(&map.z).filter(|(v, _)| **v != OrientedMesh::NEW) {
                    coordinates[v as usize] = [z.re, z.im];
                }
                return TextureCoordinates { coordinates, corners: None };
            }
            None => {
                let mesh = map.z[..disc.positions.len()].iter();
                (mesh.map(|z| [z.re, z.im]).collect::<Vec<_>>(), disc.corner_vertices(surface))
            }
            Some(torus) => {
                let unfolded = torus.unfold(disc);
                (unfolded.coordinates(torus, tiling), unfolded.source_corners(disc, surface))
            }
        };
        if corners.contains(&OrientedMesh::NEW) {
            let nowhere = coordinates.len() as u32;
            coordinates.push([0.0; 2]);
            corners.iter_mut().filter(|corner| **corner == OrientedMesh::NEW).for_each(|corner| *corner = nowhere);
        }
        TextureCoordinates { coordinates, corners: Some(corners) }
    }
}
