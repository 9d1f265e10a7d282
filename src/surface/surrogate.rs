//! Surrogate shapes at rest for faces without area.

use super::Faces;
use crate::geometry::vector::{cross, dot, norm, scale, sub};
use crate::surface::oriented_mesh::OrientedMesh;
use crate::surface::topology::{ZERO_AREA, has_no_area};

/// The faces of a disc whose area vanishes in double precision, and the surrogate shapes at rest
/// that replace them in the computation.
///
/// - A *triangle* keeps its longest edge and the foot of its third vertex on it; the third vertex
///   is lifted off the edge by `height` times the edge's length. Its neighbours thus see nearly the
///   same edge lengths, and an edge of length zero gets `height` times the length of the longest
///   edge beside it. A triangle that is a single point becomes equilateral.
/// - A *quad* becomes a rectangle whose longer sides have the length of its longest edge and whose
///   shorter sides are `height` times that. A quad that is a single point becomes a square.
/// - No surrogate is smaller than `height` times the mean edge of the mesh.
///
/// The smaller the height, the closer is the map to that of the surface without these faces, and
/// the flatter are their images.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surrogates {
    /// Height over length of a surrogate.
    pub height: f64,
    /// Indices of the faces, ascending.
    pub faces: Vec<u32>,
    /// The corners of each surrogate, counter-clockwise in a plane; triangles use the first three.
    places: Vec<[[f64; 3]; 4]>,
}

impl Surrogates {
    /// The default height.
    ///
    /// # Rationale
    /// Flat triangles were inserted at 24 edges of `sphere?n=24&mesh=delaunay`. The other vertices
    /// of its free map, of diameter 2, are then at the following distances from their limits as the
    /// height tends to 0: 3.4e-2 with equilateral triangles (height 0.87), 1e-2 at 0.1, 4e-4 at
    /// 0.01, 4e-6 at 1e-4. The limit itself is 2e-3 from the map of the original mesh, because it
    /// is a different mesh. Heights below 0.01 therefore gain nothing and make needles.
    pub const HEIGHT: f64 = 0.01;

    /// Finds the faces without area in a mesh of triangles or of quads and makes their surrogates.
    pub fn new(positions: &[[f64; 3]], faces: &Faces, height: f64) -> Self {
        let without: Vec<u32> =
            (0..faces.len()).filter(|&f| has_no_area(positions, faces.get(f))).map(|f| f as u32).collect();
        let smallest = if without.is_empty() { 0.0 } else { height * mean_edge(positions, faces) };
        let place = |&f: &u32| {
            let corners = faces.get(f as usize).iter().map(|&v| positions[v as usize]).collect::<Vec<_>>();
            match corners[..] {
                [a, b, c] => triangle([a, b, c], height, smallest),
                [a, b, c, d] => quad([a, b, c, d], height, smallest),
                _ => [[0.0; 3]; 4],
            }
        };
        Surrogates { height, places: without.iter().map(place).collect(), faces: without }
    }

    /// Whether face `f` has a surrogate.
    pub fn has(&self, f: usize) -> bool {
        !self.faces.is_empty() && self.faces.binary_search(&(f as u32)).is_ok()
    }

    /// The weight of face f in sums in which a regular face has weight 1; small for surrogates, so
    /// that they hardly affect their neighbours.
    pub fn share(&self, f: usize) -> f64 {
        if self.has(f) { self.height } else { 1.0 }
    }

    /// Returns two edges at a corner, at least one of which has positive length; if they span no
    /// area, those of a triangle of the default height.
    pub(crate) fn opened([ahead, behind]: [[f64; 3]; 2]) -> [[f64; 3]; 2] {
        let longest = norm(ahead).max(norm(behind));
        if norm(cross(ahead, behind)) > ZERO_AREA * longest * longest {
            return [ahead, behind];
        }
        let places = triangle([[0.0; 3], ahead, behind], Self::HEIGHT, 0.0);
        [sub(places[1], places[0]), sub(places[2], places[0])]
    }

    fn of(&self, f: usize) -> Option<&[[f64; 3]; 4]> {
        if self.faces.is_empty() {
            return None;
        }
        self.faces.binary_search(&(f as u32)).ok().map(|at| &self.places[at])
    }
}

impl OrientedMesh {
    /// The vector from corner k of face f to its corner l at rest, from which energies and ρ are
    /// computed.
    pub fn spoke(&self, f: usize, k: usize, l: usize) -> [f64; 3] {
        match self.surrogates.of(f) {
            Some(places) => sub(places[l], places[k]),
            None => {
                let polygon = self.faces.get(f);
                sub(self.positions[polygon[l] as usize], self.positions[polygon[k] as usize])
            }
        }
    }

    /// The length at rest of the edge of these corners: the maximum over its faces.
    pub fn edge_length(&self, corners: &[u32], face_of_corner: &[u32]) -> f64 {
        let length = |&c: &u32| {
            let f = face_of_corner[c as usize] as usize;
            let range = self.faces.corner_range(f);
            let k = c as usize - range.start;
            norm(self.spoke(f, k, (k + 1) % range.len()))
        };
        corners.iter().map(length).fold(0.0, f64::max)
    }
}

/// Mean length of the edges of positive length, inner edges counting twice.
fn mean_edge(positions: &[[f64; 3]], faces: &Faces) -> f64 {
    let (mut sum, mut count) = (0.0, 0usize);
    for polygon in faces.iter() {
        for k in 0..polygon.len() {
            let length = distance(positions[polygon[k] as usize], positions[polygon[(k + 1) % polygon.len()] as usize]);
            (sum, count) = (sum + length, count + usize::from(length > 0.0));
        }
    }
    if count > 0 { sum / count as f64 } else { 1.0 }
}

/// b − a| without underflow.
fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    let d = sub(b, a);
    let unit = d.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    if unit > 0.0 { unit * norm(d.map(|x| x / unit)) } else { 0.0 }
}

fn triangle(corners: [[f64; 3]; 3], height: f64, smallest: f64) -> [[f64; 3]; 4] {
    let length = |k: usize| distance(corners[k], corners[(k + 1) % 3]);
    // Of edges of equal length the first.
    let first = (1..3).fold(0, |best, k| if length(k) > length(best) { k } else { best });
    let longest = length(first);
    let size = longest.max(smallest);
    let (along, up) = match longest > 0.0 {
        false => (0.5, 0.75f64.sqrt()),
        true => {
            let [edge, third] = [1, 2].map(|k| sub(corners[(first + k) % 3], corners[first]).map(|x| x / longest));
            (dot(edge, third).clamp(0.0, 1.0), norm(cross(edge, third)).max(height))
        }
    };
    let mut places = [[0.0; 3]; 4];
    places[(first + 1) % 3] = [size, 0.0, 0.0];
    places[(first + 2) % 3] = scale(size, [along, up, 0.0]);
    places
}

fn quad(corners: [[f64; 3]; 4], height: f64, smallest: f64) -> [[f64; 3]; 4] {
    let length = [0, 1, 2, 3].map(|k| distance(corners[k], corners[(k + 1) % 4]));
    let longest = length.iter().copied().fold(0.0, f64::max);
    let size = longest.max(smallest);
    let [x, y] = match () {
        () if longest == 0.0 => [size, size],
        () if length[0] + length[2] >= length[1] + length[3] => [size, height * size],
        () => [height * size, size],
    };
    [[0.0, 0.0, 0.0], [x, 0.0, 0.0], [x, y, 0.0], [0.0, y, 0.0]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vertex_is_lifted_off_the_longest_edge_where_it_is() {
        let [a, b, c, _] = triangle([[0.0; 3], [0.0, 3.0, 0.0], [0.0, 4.0, 0.0]], 0.1, 0.0);
        // The longest edge joins the third corner to the first.
        assert_eq!((c, a), ([0.0; 3], [4.0, 0.0, 0.0]));
        assert!(norm(sub(b, [1.0, 0.4, 0.0])) < 1e-15);
        // Counter-clockwise.
        assert!(cross(sub(b, a), sub(c, a))[2] > 0.0);
    }

    #[test]
    fn what_is_one_point_is_regular() {
        let [a, b, c, _] = triangle([[7.0; 3]; 3], 0.1, 0.5);
        for (x, y) in [(a, b), (b, c), (c, a)] {
            assert!((distance(x, y) - 0.5).abs() < 1e-15);
        }
        assert_eq!(quad([[7.0; 3]; 4], 0.1, 0.5)[2], [0.5, 0.5, 0.0]);
    }

    #[test]
    fn shapes_have_area_however_small_the_faces_are() {
        for size in [1e-200, 1e-320] {
            let [a, b, c, _] = triangle([[0.0; 3], [size, 0.0, 0.0], [0.0, size, 0.0]], 0.01, 1e-2);
            let twice_area = norm(cross(sub(b, a), sub(c, a)));
            // Half a square has a shape of its own at any size. Denormal numbers have few digits.
            assert!((twice_area / 1e-4 - 0.5).abs() < 0.01, "{size:e}: {twice_area:e}");
        }
    }
}
