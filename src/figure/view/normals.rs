use super::camera::area_vector;
use super::{Shading, SurfaceView};
use crate::geometry::vector::{add, dot, norm, scale, sub};
use crate::surface::Faces;

/// cos 40°: faces that meet at a larger angle form a crease and are shaded separately.
const CREASE: f64 = 0.766;

/// Returns a unit normal for every corner; 0 if a face has none.
pub(super) fn corner_normals(view: &SurfaceView) -> Vec<[f64; 3]> {
    let faces = view.faces;
    let of_face: Vec<[f64; 3]> = match view.shading {
        Shading::Normals(given) => given.iter().map(|n| unit(*n)).collect(),
        _ => {
            let place = |v: &u32| view.positions[*v as usize];
            faces.iter().map(|polygon| unit(area_vector(polygon.iter().map(place)))).collect()
        }
    };
    if view.shading == Shading::Smooth {
        return averaged(faces, view.positions, &of_face);
    }
    (0..faces.len()).flat_map(|f| std::iter::repeat_n(of_face[f], faces.corner_range(f).len())).collect()
}

/// Returns at each corner the mean normal, weighted by angle, of those faces around its vertex that
/// do not form a crease with its own face.
fn averaged(faces: &Faces, positions: &[[f64; 3]], of_face: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let vertex = faces.corners();
    // Counting sort of the corners by vertex, as (face, angle).
    let mut offset = vec![0u32; positions.len() + 1];
    vertex.iter().for_each(|v| offset[*v as usize + 1] += 1);
    for v in 0..positions.len() {
        offset[v + 1] += offset[v];
    }
    let mut cursor = offset.clone();
    let mut around = vec![(0u32, 0.0); vertex.len()];
    for f in 0..faces.len() {
        let polygon = faces.get(f);
        for (i, v) in polygon.iter().enumerate() {
            let at = |k: usize| positions[polygon[k % polygon.len()] as usize];
            let angle = angle(sub(at(i + 1), at(i)), sub(at(i + polygon.len() - 1), at(i)));
            let slot = &mut cursor[*v as usize];
            around[*slot as usize] = (f as u32, angle);
            *slot += 1;
        }
    }
    let mut normals = Vec::with_capacity(vertex.len());
    for f in 0..faces.len() {
        for v in faces.get(f) {
            let fan = &around[offset[*v as usize] as usize..offset[*v as usize + 1] as usize];
            let mut sum = [0.0; 3];
            for (g, angle) in fan {
                let normal = of_face[*g as usize];
                if *g as usize == f || dot(normal, of_face[f]) > CREASE {
                    sum = add(sum, scale(*angle, normal));
                }
            }
            normals.push(if norm(sum) > 0.0 { unit(sum) } else { of_face[f] });
        }
    }
    normals
}

fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
    let product = norm(a) * norm(b);
    if product > 0.0 { (dot(a, b) / product).clamp(-1.0, 1.0).acos() } else { 0.0 }
}

/// Normalises a vector; 0 stays 0.
fn unit(v: [f64; 3]) -> [f64; 3] {
    // Scaled first, because squares of tiny components underflow.
    let largest = v.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    if !(largest > 0.0 && largest.is_finite()) {
        return [0.0; 3];
    }
    let v = v.map(|x| x / largest);
    scale(1.0 / norm(v), v)
}
