use super::Mapped;
use crate::io::Uv;
use crate::map::periodic::Tiling;
use crate::surface::Surface;
use crate::surface::oriented_mesh::OrientedMesh;

/// A map as texture coordinates of the surface that it was made from.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureCoordinates {
    /// The pairs; 0 0 for what was not mapped.
    pub coordinates: Vec<[f64; 2]>,
    /// For every corner of the source, face after face, its pair; `None` where every vertex has one pair.
    pub corners: Option<Vec<u32>>,
}

impl TextureCoordinates {
    /// As writers take them.
    pub fn uv(&self) -> Uv<'_> {
        match &self.corners {
            None => Uv::PerVertex(&self.coordinates),
            Some(corners) => Uv::PerCorner { coordinates: &self.coordinates, corners },
        }
    }

    /// For every corner of `surface`, face after face, its pair.
    pub fn of_corners(&self, surface: &Surface) -> Vec<[f64; 2]> {
        let pairs = self.corners.as_deref().unwrap_or(surface.faces.corners());
        pairs.iter().map(|&k| self.coordinates[k as usize]).collect()
    }
}

impl Mapped {
    /// The texture coordinates of `surface`, from which this was made: one pair per vertex where that is enough, pairs of
    /// corners where the surface was cut, faces were left out (all their corners are at 0 0), or the map has periods. `tiling` is for the latter.
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
