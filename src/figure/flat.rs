use super::FigureError;
use crate::surface::Faces;

/// A planar map drawn face by face, coloured by one number per face.
///
/// Units are equal on both axes. Mesh edges are drawn if an average face is large enough on paper.
/// Flipped faces, and faces of negative value, are drawn last in [`super::ALARM`] and counted in a
/// legend.
#[derive(Clone, Copy, Debug)]
pub struct FlatMap<'a> {
    /// The map, `nv × 2`. Coordinates of vertices without a face are ignored.
    pub points: &'a [[f64; 2]],
    /// The `nf` polygons.
    pub faces: &'a Faces,
    /// The quasi-conformal distortion σ1/σ2 of each face (`nf`): 1 if conformal, +∞ if the face
    /// collapses, negative if it is flipped.
    pub values: &'a [f64],
    /// Faces mapped with reversed orientation, in any order.
    pub flipped: &'a [usize],
    /// If given, the scale ends at this value (> 1), in greys, and faces beyond it are drawn in
    /// [`super::MARK`].
    pub mark: Option<f64>,
    /// Title above the map; at most two lines, possibly empty.
    pub title: &'a str,
    /// Label of the colour bar.
    pub scale_label: &'a str,
}

impl FlatMap<'_> {
    /// Checks the data and returns the bounding box of all faces.
    pub(super) fn bounds(&self) -> Result<([f64; 2], [f64; 2]), FigureError> {
        let faces = self.faces.len();
        if faces == 0 {
            return Err(FigureError::NoFaces);
        }
        if self.values.len() != faces {
            return Err(FigureError::ValueCount { values: self.values.len(), faces });
        }
        if let Some(face) = self.values.iter().position(|v| v.is_nan()) {
            return Err(FigureError::Value { face });
        }
        if let Some(&face) = self.flipped.iter().find(|f| **f >= faces) {
            return Err(FigureError::Flipped { face, faces });
        }
        if let Some(mark) = self.mark.filter(|mark| !(*mark > 1.0 && mark.is_finite())) {
            return Err(FigureError::Mark { mark });
        }
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for (face, polygon) in self.faces.iter().enumerate() {
            for &vertex in polygon {
                let Some(&[x, y]) = self.points.get(vertex as usize) else {
                    return Err(FigureError::Vertex { face, vertex, points: self.points.len() });
                };
                if !(x.is_finite() && y.is_finite()) {
                    return Err(FigureError::Point { vertex, face, x, y });
                }
                low = [low[0].min(x), low[1].min(y)];
                high = [high[0].max(x), high[1].max(y)];
            }
        }
        // No polygon has a corner.
        if low[0] > high[0] {
            return Err(FigureError::NoFaces);
        }
        Ok((low, high))
    }
}
