//! A surface in space, shaded, with a checkerboard on it.

mod camera;
mod checker;
mod normals;
mod scan;
mod scene;
mod shade;

use tiny_skia::{Pixmap, PixmapPaint, Transform};

pub use camera::Camera;
pub use checker::Checker;

use super::drawing::{Drawing, TextAnchor};
use super::outline::edges;
use super::raster::{RenderedSheet, SAMPLES, blank_sheet, encode_png};
use super::{FigureError, style, text};
use crate::surface::Faces;
use camera::Lens;
use normals::corner_normals;
use scene::Scene;
use shade::{FaceMark, OUTLINE, Paints, SEAM, Shader, encode};

/// A surface in space with the checkerboard of a map on it.
///
/// A point with texture coordinates (u, v) is light if ⌊u⌋ + ⌊v⌋ is even. Within a triangle (u, v)
/// is affine; other polygons are fans around their centres. Squares smaller than pixels fade into
/// their mean.
///
/// The eye is placed by [`Camera`]. By default an open surface is seen from the side to which its
/// normals point, its other side being darker; a closed one is seen from above, where most of its
/// area faces the eye.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceView<'a> {
    /// Positions, `nv × 3`. Those of vertices without a face are ignored.
    pub positions: &'a [[f64; 3]],
    /// The `nf` polygons.
    pub faces: &'a Faces,
    /// Texture coordinates of every corner, face after face, in units of squares.
    pub uv: &'a [[f64; 2]],
    /// The normals for shading.
    pub shading: Shading<'a>,
    /// Faces drawn in [`super::ALARM`], in any order.
    pub marked: &'a [usize],
    /// Faces whose squares are drawn in [`super::MARK`], light and dark, in any order.
    pub reddened: &'a [usize],
    /// Whether the edges of the mesh are drawn, if an average face has room for them.
    pub edges: bool,
    /// Edges drawn as lines, for example those of a cut, by their end vertices.
    pub seams: &'a [[u32; 2]],
    /// Title above the picture; at most two lines, possibly empty.
    pub title: &'a str,
    /// The position of the eye.
    pub camera: Camera,
}

/// The normals with which a surface is shaded.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Shading<'a> {
    /// At each corner the mean of the normals of the faces there, weighted by angle; edges with
    /// dihedral angles above 40° stay sharp.
    #[default]
    Smooth,
    /// The normals of the faces.
    Flat,
    /// Given normals, one per face (`nf × 3`), of any length, for example estimated ones.
    Normals(&'a [[f64; 3]]),
}

/// Space around the surface.
const PADDING: f64 = 6.0;
/// Half widths of outlines and seams, in pixels.
const OUTLINE_WIDTH: f64 = 0.9;
const SEAM_WIDTH: f64 = 1.8;
/// Half width of mesh edges, and the smallest average area of a face, in pixels, for which they are
/// drawn.
const EDGE_WIDTH: f64 = 0.6;
const FACE_WITH_EDGES: f64 = 60.0;
/// Distance by which lines are lifted off the surface, in their half widths; steeper faces hide a
/// part of them.
const LIFT: f64 = 3.0;
/// Seams are lifted by the length of their longest edge, but at most by this, in radii of the
/// surface.
const SEAM_LIFT: f64 = 0.02;

impl<'a> SurfaceView<'a> {
    /// The size of a picture for a page, in pixels.
    pub const SIZE: [u32; 2] = [1600, 1400];

    /// Makes a view with default settings.
    pub fn new(positions: &'a [[f64; 3]], faces: &'a Faces, uv: &'a [[f64; 2]]) -> SurfaceView<'a> {
        SurfaceView {
            positions,
            faces,
            uv,
            shading: Shading::default(),
            marked: &[],
            reddened: &[],
            edges: false,
            seams: &[],
            title: "",
            camera: Camera::default(),
        }
    }

    /// Returns a unit normal for every corner, face after face, by the shading; 0 if a face has
    /// none.
    pub fn corner_normals(&self) -> Vec<[f64; 3]> {
        corner_normals(self)
    }

    /// Renders the picture to the bytes of a PNG file of at most `size` pixels, cropped to its
    /// content.
    ///
    /// # Errors
    /// [`FigureError`]: inconsistent sizes, indices out of range, or coordinates that cannot be
    /// drawn.
    pub fn render(&self, size: [u32; 2]) -> Result<Vec<u8>, FigureError> {
        encode_png(&self.sheet(size.map(f64::from), 1)?.pixels, 1)
    }

    /// Renders the figure on a sheet of at most `size` units, at `zoom` pixels per unit.
    pub(super) fn sheet(&self, size: [f64; 2], zoom: usize) -> Result<RenderedSheet, FigureError> {
        let margins = 2.0 * style::MARGIN;
        let room = size[0] - margins;
        let title = text::wrap(self.title, style::TITLE, room, 2);
        let above = title.len() as f64 * style::TITLE_LINE + if title.is_empty() { 0.0 } else { style::GAP };
        let picture = self.picture([room, size[1] - margins - above], zoom)?;
        let [across, down] = [picture.width(), picture.height()].map(|pixels| f64::from(pixels) / zoom as f64);
        let widest = title.iter().map(|line| text::width(line, style::TITLE)).fold(0.0, f64::max);
        let width = (across.max(widest) + margins).ceil();
        let (left, top) = (((width - across) / 2.0).floor(), style::MARGIN + above);
        let mut pixels = blank_sheet(width as u32 * zoom as u32, (top + down + style::MARGIN) as u32 * zoom as u32)?;
        let [x, y] = [left, top].map(|c| c as i32 * zoom as i32);
        pixels.draw_pixmap(x, y, picture.as_ref(), &PixmapPaint::default(), Transform::identity(), None);
        let mut drawing = Drawing::default();
        for (i, line) in title.iter().enumerate() {
            let y = style::MARGIN + (i as f64 + 0.4) * style::TITLE_LINE;
            drawing.text([width / 2.0, y], TextAnchor::Middle, style::TITLE, line.as_str());
        }
        drawing.paint(&mut pixels, zoom);
        Ok(RenderedSheet { pixels, middle: top + down / 2.0 })
    }

    /// Renders the surface without title, in at most `room` units with `zoom` pixels each.
    pub(super) fn picture(&self, room: [f64; 2], zoom: usize) -> Result<Pixmap, FigureError> {
        let (low, high) = self.check()?;
        let lens = Lens::of(self, low, high)?;
        let window = Window::around(self, &lens, room, zoom)?;
        let [width, height] = window.size;
        let samples = SAMPLES;
        let to_samples = |p| window.place(p).map(|x| x * samples as f64);
        let mut scene = Scene::new(self, &lens, |p| {
            let [x, y] = to_samples(p);
            [x, y, p[2]]
        });
        let unit = (zoom * samples) as f64;
        // The lift is a multiple of the half width, converted from pixels to a fraction of the
        // distance.
        let lift = |half_width: f64| LIFT * half_width * zoom as f64 / window.scale;
        let outline = edges(self.faces).into_iter().filter(|(_, single)| *single).map(|(edge, _)| edge);
        scene.draw(outline, OUTLINE, OUTLINE_WIDTH * unit, lift(OUTLINE_WIDTH));
        // So that seams in a corner between faces are not hidden by these.
        let depth =
            |seam: &[u32; 2]| lens.length(seam.map(|v| self.positions[v as usize])).min(SEAM_LIFT) / lens.distance;
        let seam_lift = self.seams.iter().map(depth).fold(lift(SEAM_WIDTH), f64::max);
        scene.draw(self.seams.iter().copied(), SEAM, SEAM_WIDTH * unit, seam_lift);

        let face_area = scene.area() / (unit * unit * self.faces.len() as f64);
        let with_edges = self.edges && face_area > FACE_WITH_EDGES;
        let mut marks = vec![FaceMark::None; self.faces.len()];
        self.reddened.iter().for_each(|f| marks[*f] = FaceMark::Red);
        self.marked.iter().for_each(|f| marks[*f] = FaceMark::Alarm);
        let shader = Shader {
            view: self,
            scene: &scene,
            normals: &corner_normals(self),
            axes: lens.axes,
            outward: lens.outward,
            marks: &marks,
            edges: if with_edges { EDGE_WIDTH * unit } else { 0.0 },
            samples: samples as f64,
            paints: Paints::new(),
        };
        let mut sheet = blank_sheet(width as u32, height as u32)?;
        let columns = width * samples;
        let mut sums = Vec::new();
        scene.bands([columns, height * samples], samples, |first_row, numbers| {
            sums.clear();
            sums.resize(numbers.len() / (samples * samples), [0.0; 3]);
            shader.band(first_row, numbers, columns, &mut sums);
            let pixels = sheet.data_mut()[first_row / samples * width * 4..].chunks_exact_mut(4);
            for (pixel, sum) in pixels.zip(&sums) {
                pixel[..3].copy_from_slice(&encode(sum.map(|x| x / (samples * samples) as f64)));
            }
        });
        Ok(sheet)
    }

    /// Checks the data and returns the bounding box of all faces.
    fn check(&self) -> Result<([f64; 3], [f64; 3]), FigureError> {
        let (faces, corners) = (self.faces.len(), self.faces.corners().len());
        if corners == 0 {
            return Err(FigureError::NoFaces);
        }
        if self.uv.len() != corners {
            return Err(FigureError::TextureCount { given: self.uv.len(), corners });
        }
        if let Shading::Normals(normals) = self.shading
            && normals.len() != faces
        {
            return Err(FigureError::NormalCount { normals: normals.len(), faces });
        }
        if let Some(&face) = self.marked.iter().chain(self.reddened).find(|f| **f >= faces) {
            return Err(FigureError::Marked { face, faces });
        }
        let points = self.positions.len();
        let mut used = vec![false; points];
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for (face, polygon) in self.faces.iter().enumerate() {
            for (&vertex, corner) in polygon.iter().zip(self.faces.corner_range(face)) {
                let Some(&at) = self.positions.get(vertex as usize) else {
                    return Err(FigureError::Vertex { face, vertex, points });
                };
                if !at.iter().all(|x| x.is_finite()) {
                    return Err(FigureError::Position { vertex, face, at });
                }
                let [u, v] = self.uv[corner];
                if !(u.is_finite() && v.is_finite()) {
                    return Err(FigureError::Texture { vertex, face, u, v });
                }
                low = [0, 1, 2].map(|k| low[k].min(at[k]));
                high = [0, 1, 2].map(|k| high[k].max(at[k]));
                used[vertex as usize] = true;
            }
        }
        for (seam, ends) in self.seams.iter().enumerate() {
            if let Some(&vertex) = ends.iter().find(|v| !used.get(**v as usize).is_some_and(|used| *used)) {
                return Err(FigureError::Seam { seam, vertex });
            }
        }
        Ok((low, high))
    }
}

/// The visible part of the picture plane.
struct Window {
    size: [usize; 2],
    middle: [f64; 2],
    /// Pixels per unit of the plane Z = 1.
    scale: f64,
}

impl Window {
    /// Makes a window around all faces, as large as `room` permits.
    fn around(view: &SurfaceView, lens: &Lens, room: [f64; 2], zoom: usize) -> Result<Window, FigureError> {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for v in view.faces.corners() {
            let [x, y, _] = lens.place(view.positions[*v as usize]);
            low = [low[0].min(x), low[1].min(y)];
            high = [high[0].max(x), high[1].max(y)];
        }
        let extent = [high[0] - low[0], high[1] - low[1]];
        let room = room.map(|r| r - 2.0 * PADDING);
        let scale = (room[0] / extent[0]).min(room[1] / extent[1]);
        if !(room[0] >= 1.0 && room[1] >= 1.0) {
            return Err(FigureError::Room { width: room[0], height: room[1] });
        }
        // The surface is seen as a single point.
        if !(scale.is_finite() && scale < 1e12) {
            return Err(FigureError::NoSurfaceExtent { at: view.positions[view.faces.corners()[0] as usize] });
        }
        let side = |extent: f64| (extent * scale + 2.0 * PADDING).ceil() as usize * zoom;
        let middle = [0, 1].map(|k| (low[k] + high[k]) / 2.0);
        Ok(Window { size: extent.map(side), middle, scale: scale * zoom as f64 })
    }

    /// Transforms a point of the picture plane to pixels, y downward.
    fn place(&self, [x, y, _]: [f64; 3]) -> [f64; 2] {
        let [width, height] = self.size.map(|s| s as f64 / 2.0);
        [width + (x - self.middle[0]) * self.scale, height - (y - self.middle[1]) * self.scale]
    }
}
