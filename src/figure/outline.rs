use crate::surface::Faces;

/// Returns every edge of the polygons once, as its vertices in increasing order and whether it
/// belongs to only one face.
pub(super) fn edges(faces: &Faces) -> Vec<([u32; 2], bool)> {
    let mut all: Vec<[u32; 2]> = Vec::with_capacity(faces.corners().len());
    for polygon in faces.iter() {
        for (i, &v) in polygon.iter().enumerate() {
            let w = polygon[(i + 1) % polygon.len()];
            all.push([v.min(w), v.max(w)]);
        }
    }
    all.sort_unstable();
    all.chunk_by(|a, b| a == b).map(|same| (same[0], same.len() == 1)).collect()
}
