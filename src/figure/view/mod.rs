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

use super::drawing::{Anchor, Drawing};
use super::outline::edges;
use super::raster::{SAMPLES, Sheet, blank_sheet, encode_png};
use super::{FigureError, style, text};
use crate::surface::Faces;
use camera::Lens;
use normals::corner_normals;
use scene::Scene;
use shade::{Mark, OUTLINE, Paints, SEAM, Shader, encode};

/// A surface in space under the checkerboard that a map lays on it.
///
/// A point with texture coordinates (u, v) is light where ⌊u⌋ + ⌊v⌋ is even. Within a triangle (u, v) is affine; any
/// other polygon is a fan around its middle. Where squares are smaller than pixels they fade into their mean.
///
/// The eye is placed by [`Camera`]. By default an open surface is seen from the side that its normals point to, the other
/// side being tinted darker; a closed one from above, where most of it turns to the eye.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceView<'a> {
    /// `nv × 3`. Vertices without a face may be anything.
    pub positions: &'a [[f64; 3]],
    /// `nf` polygons.
    pub faces: &'a Faces,
    /// Texture coordinates of every corner, face after face, in squares.
    pub uv: &'a [[f64; 2]],
    /// What the light falls on.
    pub shading: Shading<'a>,
    /// Faces drawn in [`super::ALARM`], in any order.
    pub marked: &'a [usize],
    /// Faces whose squares are drawn in [`super::MARK`], light and dark, in any order.
    pub reddened: &'a [usize],
    /// Whether the edges of the mesh are drawn, if an average face has room for them.
    pub edges: bool,
    /// Edges drawn as lines, such as those of a cut, by their ends.
    pub seams: &'a [[u32; 2]],
    /// Over the picture; two lines at most, may be empty.
    pub title: &'a str,
    /// Where it is seen from.
    pub camera: Camera,
}

/// The normals by which a surface is lit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Shading<'a> {
    /// At each corner the mean of the faces there, weighted by angle; edges above 40° are kept sharp.
    #[default]
    Smooth,
    /// Those of the faces.
    Flat,
    /// Given, one per face (`nf × 3`) of any length: what estimated normals see.
    Normals(&'a [[f64; 3]]),
}

/// Around the surface.
const PADDING: f64 = 6.0;
/// Half the width of an outline, of seams; in pixels.
const OUTLINE_WIDTH: f64 = 0.9;
const SEAM_WIDTH: f64 = 1.8;
/// Half the width of mesh edges, and the pixels an average face must have to show them.
const EDGE_WIDTH: f64 = 0.6;
const FACE_WITH_EDGES: f64 = 60.0;
/// How far lines are lifted off the surface, in their half widths: steeper faces than that swallow a part.
const LIFT: f64 = 3.0;
/// Seams are lifted by the length of their longest edge, but no more than this, in radii of the surface.
const SEAM_LIFT: f64 = 0.02;

impl<'a> SurfaceView<'a> {
    /// The size of a picture for a page, in pixels.
    pub const SIZE: [u32; 2] = [1600, 1400];

    /// A view with everything else by default.
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

    /// A unit vector at every corner, face after face, by the shading; 0 where a face has none.
    pub fn corner_normals(&self) -> Vec<[f64; 3]> {
        corner_normals(self)
    }

    /// The picture as the bytes of a PNG file, at most `size` pixels large: cut to what there is to see.
    ///
    /// # Errors
    /// [`FigureError`]: what does not fit together, names no vertex, or has no place on paper.
    pub fn render(&self, size: [u32; 2]) -> Result<Vec<u8>, FigureError> {
        encode_png(&self.sheet(size.map(f64::from), 1)?.pixels, 1)
    }

    /// The figure on a sheet of at most `size`, at `zoom` pixels per unit.
    pub(super) fn sheet(&self, size: [f64; 2], zoom: usize) -> Result<Sheet, FigureError> {
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
            drawing.text([width / 2.0, y], Anchor::Middle, style::TITLE, line.as_str());
        }
        drawing.paint(&mut pixels, zoom);
        Ok(Sheet { pixels, middle: top + down / 2.0 })
    }

    /// The surface alone, in a picture of at most `room` units with `zoom` pixels each.
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
        // A line lies over the surface by its half width: relative to the distance from the eye, in pixels.
        let lift = |half_width: f64| LIFT * half_width * zoom as f64 / window.scale;
        let outline = edges(self.faces).into_iter().filter(|(_, single)| *single).map(|(edge, _)| edge);
        scene.draw(outline, OUTLINE, OUTLINE_WIDTH * unit, lift(OUTLINE_WIDTH));
        // So that those in a corner between faces are not hidden by these.
        let depth =
            |seam: &[u32; 2]| lens.length(seam.map(|v| self.positions[v as usize])).min(SEAM_LIFT) / lens.distance;
        let seam_lift = self.seams.iter().map(depth).fold(lift(SEAM_WIDTH), f64::max);
        scene.draw(self.seams.iter().copied(), SEAM, SEAM_WIDTH * unit, seam_lift);

        let face_area = scene.area() / (unit * unit * self.faces.len() as f64);
        let with_edges = self.edges && face_area > FACE_WITH_EDGES;
        let mut marks = vec![Mark::None; self.faces.len()];
        self.reddened.iter().for_each(|f| marks[*f] = Mark::Red);
        self.marked.iter().for_each(|f| marks[*f] = Mark::Alarm);
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

    /// Checks the data; the bounding box of all faces.
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

/// The part of the picture's plane that is drawn, in pixels.
struct Window {
    size: [usize; 2],
    middle: [f64; 2],
    /// Pixels per unit of the plane Z = 1.
    scale: f64,
}

impl Window {
    /// Around all faces, as large as `room` permits.
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
        // A surface that is seen as one point.
        if !(scale.is_finite() && scale < 1e12) {
            return Err(FigureError::NoSurfaceExtent { at: view.positions[view.faces.corners()[0] as usize] });
        }
        let side = |extent: f64| (extent * scale + 2.0 * PADDING).ceil() as usize * zoom;
        let middle = [0, 1].map(|k| (low[k] + high[k]) / 2.0);
        Ok(Window { size: extent.map(side), middle, scale: scale * zoom as f64 })
    }

    /// A point of the plane, in pixels, y downward.
    fn place(&self, [x, y, _]: [f64; 3]) -> [f64; 2] {
        let [width, height] = self.size.map(|s| s as f64 / 2.0);
        [width + (x - self.middle[0]) * self.scale, height - (y - self.middle[1]) * self.scale]
    }
}
