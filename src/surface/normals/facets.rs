use super::NormalError;
use crate::geometry::vector::{add, cross, dot, norm, scale, sub};
use crate::surface::Surface;
use crate::surface::digital::Digital;
use crate::surface::edges::Edges;

/// The faces of a consistently oriented surface, as input for normal estimators.
#[derive(Clone, Debug)]
pub struct Facets<'a> {
    /// The mean of the corners of each face (`nf × 3`).
    pub centre: Vec<[f64; 3]>,
    /// The geometric unit normal of each face (`nf × 3`), on the side from which the face is
    /// counter-clockwise; for a quad it is parallel to the cross product of the diagonals.
    pub normal: Vec<[f64; 3]>,
    /// The area of each face projected along its own normal, in squared units of the positions
    /// (`nf`).
    pub area: Vec<f64>,
    /// The unit of length for radii: the square root of the mean area of a face; 1 for voxels.
    pub spacing: f64,
    /// The voxels and surfels, if the surface is digital.
    pub digital: Option<&'a Digital>,
    /// The normals given by the file, if any.
    pub given: Option<&'a [[f64; 3]]>,
    /// Whether every edge has two faces.
    pub closed: bool,
    offsets: Vec<u32>,
    neighbours: Vec<u32>,
}

impl<'a> Facets<'a> {
    /// Collects the faces of `surface`, which must be consistently oriented; `edges` are its edges.
    ///
    /// # Errors
    /// A face without area; surfels that belong to another surface.
    pub fn new(surface: &'a Surface, edges: &Edges, digital: Option<&'a Digital>) -> Result<Self, NormalError> {
        let faces = &surface.faces;
        if let Some(digital) = digital
            && digital.surfels.len() != faces.len()
        {
            return Err(NormalError::OtherSurfels { faces: faces.len(), surfels: digital.surfels.len() });
        }
        let mut facets = Facets {
            centre: Vec::with_capacity(faces.len()),
            normal: Vec::with_capacity(faces.len()),
            area: Vec::with_capacity(faces.len()),
            spacing: 1.0,
            digital,
            given: surface.face_normals.as_deref(),
            closed: true,
            offsets: Vec::with_capacity(faces.len() + 1),
            neighbours: Vec::with_capacity(faces.corners().len()),
        };
        facets.offsets.push(0);
        for f in 0..faces.len() {
            let polygon = faces.get(f);
            let corner = |k: usize| surface.positions[polygon[k] as usize];
            let (centre, twice_area) = shape(polygon.len(), corner);
            let length = norm(twice_area);
            // An area that overflows or vanishes has no direction.
            if !(length.is_finite() && length > 0.0) {
                return Err(NormalError::NoArea { face: f });
            }
            facets.centre.push(centre);
            facets.area.push(0.5 * length);
            facets.normal.push(match digital {
                // The exact axis, without the rounding of positions.
                Some(digital) => digital.surfels[f].normal(),
                None => scale(1.0 / length, twice_area),
            });
            for c in faces.corner_range(f) {
                match edges.opposite(c) {
                    Some(other) => facets.neighbours.push(edges.face_of_corner[other]),
                    None => facets.closed = false,
                }
            }
            facets.offsets.push(facets.neighbours.len() as u32);
        }
        if digital.is_none() && !facets.is_empty() {
            facets.spacing = (facets.area.iter().sum::<f64>() / facets.len() as f64).sqrt();
        }
        Ok(facets)
    }

    /// Number of faces.
    pub fn len(&self) -> usize {
        self.normal.len()
    }

    /// Whether there is no face.
    pub fn is_empty(&self) -> bool {
        self.normal.is_empty()
    }

    /// The faces across the edges of face `f`, in the order of its edges; boundary edges have none.
    pub fn neighbours(&self, f: usize) -> &[u32] {
        &self.neighbours[self.offsets[f] as usize..self.offsets[f + 1] as usize]
    }

    /// Whether the faces are axis-parallel squares of equal size: surfels, whether or not their
    /// voxels are known.
    pub fn looks_digital(&self) -> bool {
        // Positions in a file may have few digits.
        const ROUNDING: f64 = 1e-4;
        let area = self.spacing * self.spacing;
        self.digital.is_some()
            || self
                .normal
                .iter()
                .zip(&self.area)
                .all(|(n, a)| n.iter().any(|x| x.abs() > 1.0 - ROUNDING) && (a - area).abs() < ROUNDING * area)
    }

    /// The size L of the object in units of [`Self::spacing`].
    ///
    /// A closed surface of area A around a volume V has L = 3 V / A, the radius for a ball. A
    /// surface with boundary has L = √(A/4π), the radius of the sphere of the same area. The area
    /// of a digitised surface is estimated as ⅔ of the number of surfels, which is right for the
    /// sphere.
    pub fn size(&self) -> f64 {
        let faces_area: f64 = self.area.iter().sum();
        let area = if self.looks_digital() { faces_area * 2.0 / 3.0 } else { faces_area };
        let length = if self.closed {
            let origin = self.centre.first().copied().unwrap_or_default();
            let cone = |f: usize| self.area[f] * dot(self.normal[f], sub(self.centre[f], origin));
            (0..self.len()).map(cone).sum::<f64>().abs() / area
        } else {
            (area / (4.0 * std::f64::consts::PI)).sqrt()
        };
        length / self.spacing
    }
}

/// Returns the mean of `arity` corners and twice the vector area `Σ (p_k − p_0) × (p_{k+1} − p_0)`,
/// which is `d02 × d13` for a quad.
fn shape(arity: usize, corner: impl Fn(usize) -> [f64; 3]) -> ([f64; 3], [f64; 3]) {
    let mut from_first = [0.0; 3];
    let mut twice_area = [0.0; 3];
    let (first, mut previous) = (corner(0), [0.0; 3]);
    for k in 1..arity {
        let next = sub(corner(k), first);
        twice_area = add(twice_area, cross(previous, next));
        from_first = add(from_first, next);
        previous = next;
    }
    (add(first, scale(1.0 / arity as f64, from_first)), twice_area)
}
