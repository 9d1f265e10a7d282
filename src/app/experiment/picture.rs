use std::path::Path;

use num_complex::Complex64;
use serde::Deserialize;

use super::Marks;
use crate::distortion::{FaceMap, face_maps, quasi_conformal_errors};
use crate::figure::{Camera, Checker, FigureError, FlatMap, Format, Pair, Shading, SurfaceView};
use crate::input::Input;
use crate::map::Mapped;
use crate::map::periodic::{Tiling, checker};
use crate::surface::Faces;
use crate::surface::generate::is_generated_name;
use crate::surface::oriented_mesh::OrientedMesh;

/// How a checkerboard is drawn on a surface; `figures.checkerboard` of an experiment.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct Checkerboard {
    /// Squares along the longer side of the map.
    pub squares: usize,
    /// The upright direction of the picture.
    pub up: Up,
    /// Direction from the surface to the eye; chosen automatically by default.
    pub towards: Option<[f64; 3]>,
    /// Longest side of each of the two pictures, in units of paper ([`Pair::SIDE`]).
    pub side: f64,
}

impl Default for Checkerboard {
    fn default() -> Checkerboard {
        Checkerboard { squares: 32, up: Up::Auto, towards: None, side: Pair::SIDE }
    }
}

/// The axis that is upright in a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Up {
    /// z for generated surfaces and volumes, y for meshes, as their formats have it.
    #[default]
    Auto,
    /// The first axis.
    X,
    /// The second axis.
    Y,
    /// The third axis.
    Z,
    /// The direction opposite to the first axis.
    #[serde(rename = "-x")]
    MinusX,
    /// The direction opposite to the second axis.
    #[serde(rename = "-y")]
    MinusY,
    /// The direction opposite to the third axis.
    #[serde(rename = "-z")]
    MinusZ,
}

impl Up {
    pub(super) fn axis(self, source: &str) -> [f64; 3] {
        // A mesh is known by its extension.
        let extension = Path::new(source).extension().map(|e| e.to_ascii_lowercase());
        let mesh = ["obj", "off", "ply", "stl", "glb"].iter().any(|e| extension.as_deref() == Some(e.as_ref()));
        match self {
            Up::Auto if mesh && !is_generated_name(source) => [0.0, 1.0, 0.0],
            Up::X => [1.0, 0.0, 0.0],
            Up::Y => [0.0, 1.0, 0.0],
            Up::Auto | Up::Z => [0.0, 0.0, 1.0],
            Up::MinusX => [-1.0, 0.0, 0.0],
            Up::MinusY => [0.0, -1.0, 0.0],
            Up::MinusZ => [0.0, 0.0, -1.0],
        }
    }
}

/// Draws the flat map with faces coloured by quasi-conformal distortion, or by the errors of
/// `marks`. A periodic map is drawn once, as a parallelogram.
///
/// # Errors
/// A map that cannot be drawn.
pub fn flat_map(mapped: &Mapped, marks: Option<&Marks>, title: &str, format: Format) -> Result<Vec<u8>, FigureError> {
    FlatParts::of(mapped, &maps(mapped), marks).figure(title).render(format)
}

/// Draws the shaded surface with the checkerboard of its map, which is conformal where the squares
/// are squares. Flipped faces are marked, cuts drawn as lines. The checkerboard of a periodic map
/// has no seam.
///
/// # Errors
/// A surface or a map that cannot be drawn.
pub fn checkerboard(input: &Input, mapped: &Mapped, look: Checkerboard, title: &str) -> Result<Vec<u8>, FigureError> {
    let parts = ViewParts::of(mapped, &maps(mapped), look.squares)?;
    SurfaceView { title, ..parts.figure(input, mapped, look) }.render(SurfaceView::SIZE)
}

/// [`flat_map`] and [`checkerboard`] side by side, over a caption.
///
/// # Errors
/// As these.
pub fn checkerboard_pair(
    input: &Input,
    mapped: &Mapped,
    look: Checkerboard,
    marks: Option<&Marks>,
    caption: &str,
) -> Result<Vec<u8>, FigureError> {
    let maps = maps(mapped);
    let (flat, view) = (FlatParts::of(mapped, &maps, marks), ViewParts::of(mapped, &maps, look.squares)?);
    let reddened = marks.map(Marks::faces).unwrap_or_default();
    let view = SurfaceView { reddened: &reddened, ..view.figure(input, mapped, look) };
    Pair { flat: &flat.figure(""), view: &view, side: look.side, caption }.render()
}

/// The data of the picture of a surface besides the positions in the source. Vertices are those of
/// the source, so that shading is continuous across cuts.
pub(super) struct ViewParts {
    pub(super) faces: Faces,
    uv: Vec<[f64; 2]>,
    flipped: Vec<usize>,
    cut: Vec<[u32; 2]>,
}

impl ViewParts {
    pub(super) fn of(mapped: &Mapped, maps: &[FaceMap], squares: usize) -> Result<ViewParts, FigureError> {
        let disc = &mapped.domain.disc;
        let faces: Faces = disc.faces.renumbered(&disc.source_vertex).iter().take(disc.source_faces()).collect();
        let uv = texture(mapped, squares)?;
        Ok(ViewParts { faces, uv, flipped: flipped(maps), cut: cut(disc) })
    }

    pub(super) fn figure<'a>(&'a self, input: &'a Input, mapped: &'a Mapped, look: Checkerboard) -> SurfaceView<'a> {
        let planes = mapped.domain.planes.as_ref();
        SurfaceView {
            shading: planes.map_or(Shading::Smooth, |planes| Shading::Normals(&planes.normals[..self.faces.len()])),
            marked: &self.flipped,
            seams: &self.cut,
            camera: Camera { towards: look.towards, ..Camera::with_up(look.up.axis(&input.source)) },
            ..SurfaceView::new(&input.surface.positions, &self.faces, &self.uv)
        }
    }
}

/// The edges of the source along which it was cut: twice on the boundary of the disc.
fn cut(disc: &OrientedMesh) -> Vec<[u32; 2]> {
    let source = |v: u32| disc.source_vertex[v as usize];
    let next = disc.boundary.iter().cycle().skip(1);
    let edge = |(v, w): (&u32, &u32)| [source(*v).min(source(*w)), source(*v).max(source(*w))];
    let mut edges: Vec<[u32; 2]> = disc.boundary.iter().zip(next).map(edge).collect();
    edges.sort_unstable();
    edges
        .chunk_by(|a, b| a == b)
        .filter(|same| same.len() == 2 && same[0][1] != OrientedMesh::NEW)
        .map(|same| same[0])
        .collect()
}

/// Texture coordinates of every corner of the faces that were not put in, in squares.
fn texture(mapped: &Mapped, squares: usize) -> Result<Vec<[f64; 2]>, FigureError> {
    let (disc, image) = (&mapped.domain.disc, mapped.image());
    let corners = (0..disc.source_faces()).flat_map(|f| disc.faces.corner_range(f));
    let pair = |z: Complex64| [z.re, z.im];
    Ok(match &mapped.torus {
        Some(torus) => {
            let board = checker(torus.tau, squares as u32);
            corners.map(|c| board.place(torus.lattice_coordinates(image.corner(disc, c)))).collect()
        }
        None => {
            let points = corners.clone().map(|c| pair(image.corner(disc, c)));
            let board = Checker::across(points, squares)?;
            corners.map(|c| board.at(pair(image.corner(disc, c)))).collect()
        }
    })
}

pub(super) fn maps(mapped: &Mapped) -> Vec<FaceMap> {
    face_maps(&mapped.domain.disc, &mapped.domain.graph, &mapped.image())
}

fn flipped(maps: &[FaceMap]) -> Vec<usize> {
    (0..maps.len()).filter(|&f| !maps[f].positive).collect()
}

/// The data of the flat picture of a map.
struct FlatParts {
    points: Vec<[f64; 2]>,
    faces: Faces,
    values: Vec<f64>,
    flipped: Vec<usize>,
    mark: Option<f64>,
    label: &'static str,
}

impl FlatParts {
    fn of(mapped: &Mapped, maps: &[FaceMap], marks: Option<&Marks>) -> FlatParts {
        let disc = &mapped.domain.disc;
        let (points, faces) = match &mapped.torus {
            None => {
                let points = mapped.map.z[..mapped.domain.graph.primal].iter().map(|z| [z.re, z.im]).collect();
                (points, disc.faces.iter().take(maps.len()).collect())
            }
            Some(torus) => {
                let unfolded = torus.unfold(disc);
                let face = |f| &unfolded.corners[disc.faces.corner_range(f)];
                (unfolded.coordinates(torus, Tiling::Conformal), (0..maps.len()).map(face).collect())
            }
        };
        let values = marks.map_or_else(|| quasi_conformal_errors(maps), |marks| marks.errors.clone());
        FlatParts {
            points,
            faces,
            values,
            flipped: flipped(maps),
            mark: marks.map(Marks::above),
            label: marks.map_or("quasi-conformal error σ₁/σ₂", Marks::label),
        }
    }

    fn figure<'a>(&'a self, title: &'a str) -> FlatMap<'a> {
        FlatMap {
            points: &self.points,
            faces: &self.faces,
            values: &self.values,
            flipped: &self.flipped,
            mark: self.mark,
            title,
            scale_label: self.label,
        }
    }
}
