//! The faces laid out in the plane, one beside the other: a fundamental domain.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use num_complex::Complex64;

use super::{PeriodicMap, Tiling};
use crate::quad_graph::Periods;
use crate::surface::edges::{Edges, next_in};
use crate::surface::oriented_mesh::OrientedMesh;
use crate::surface::{Faces, Surface};

/// A lift of every face to the plane. The lifts cover the torus once and are connected; neighbours that are not side by
/// side are apart by a period m + nτ.
#[derive(Clone, Debug, PartialEq)]
pub struct Unfolded {
    /// For every corner, face after face, its point.
    pub corners: Vec<u32>,
    /// The vertex of each point and the translation [m, n] of that vertex. Each pair is there once.
    pub points: Vec<(u32, [i32; 2])>,
}

impl PeriodicMap {
    /// Real coordinates (a, b) of `z = a + bτ`.
    pub fn lattice_coordinates(&self, z: Complex64) -> [f64; 2] {
        let b = z.im / self.tau.im;
        [z.re - b * self.tau.re, b]
    }

    /// Lays the faces out. From the one nearest to the centre of the parallelogram of 1 and τ on, the neighbour that is
    /// nearest to it is put beside those that lie already: what comes out is that parallelogram, but for the faces on its rim.
    pub fn unfold(&self, disc: &OrientedMesh) -> Unfolded {
        let lifts = self.lifts(disc);
        let vertex = disc.faces.corners();
        // The points of each vertex as a list: its last one, and the one before each.
        const NONE: u32 = u32::MAX;
        let mut last = vec![NONE; disc.positions.len()];
        let mut before: Vec<u32> = Vec::with_capacity(disc.positions.len() + disc.positions.len() / 8);
        let mut unfolded = Unfolded { corners: Vec::with_capacity(vertex.len()), points: Vec::new() };
        unfolded.points.reserve(before.capacity());
        for (f, &lift) in lifts.iter().enumerate() {
            for c in disc.faces.corner_range(f) {
                let v = vertex[c];
                let at = plus(lift, self.periods.corners[c]);
                let mut point = last[v as usize];
                while point != NONE && unfolded.points[point as usize].1 != at {
                    point = before[point as usize];
                }
                if point == NONE {
                    point = before.len() as u32;
                    before.push(last[v as usize]);
                    last[v as usize] = point;
                    unfolded.points.push((v, at));
                }
                unfolded.corners.push(point);
            }
        }
        unfolded
    }

    /// The translation of each face's first corner.
    fn lifts(&self, disc: &OrientedMesh) -> Vec<[i32; 2]> {
        let faces = &disc.faces;
        let edges = Edges::new(faces, disc.positions.len());
        let centres: Vec<[f64; 2]> = (0..faces.len()).map(|f| self.centre(disc, f)).collect();
        let distance = |f: u32, lift: [i32; 2]| {
            let from_centre = |k: usize| (centres[f as usize][k] + f64::from(lift[k]) - 0.5).abs();
            from_centre(0).max(from_centre(1)).to_bits()
        };
        let mut placed = vec![false; faces.len()];
        let mut lifts = vec![[0; 2]; faces.len()];
        let wrapped = |f: u32| centres[f as usize].map(|x| -x.floor() as i32);
        let first = (0..faces.len() as u32).map(|f| (distance(f, wrapped(f)), f, wrapped(f))).min();
        // Distances are not negative: their bits are in their order.
        let mut queue: BinaryHeap<Reverse<(u64, u32, [i32; 2])>> = first.into_iter().map(Reverse).collect();
        while let Some(Reverse((_, f, lift))) = queue.pop() {
            if std::mem::replace(&mut placed[f as usize], true) {
                continue;
            }
            lifts[f as usize] = lift;
            for c in faces.corner_range(f as usize) {
                let Some(d) = edges.opposite(c) else { continue };
                let g = edges.face_of_corner[d];
                if !placed[g as usize] {
                    let beside = self.beside(faces, lift, c, g, d);
                    queue.push(Reverse((distance(g, beside), g, beside)));
                }
            }
        }
        lifts
    }

    /// The translation of face g, whose corner d is opposite to c, that puts it beside the face of c at `lift`.
    fn beside(&self, faces: &Faces, lift: [i32; 2], c: usize, g: u32, d: usize) -> [i32; 2] {
        let here = plus(lift, self.periods.corners[c]);
        let there = self.periods.corners[next_in(faces, g as usize, d)];
        [here[0].wrapping_sub(there[0]), here[1].wrapping_sub(there[1])]
    }

    /// The mean of the corners of a face, beside its first corner, in lattice coordinates.
    fn centre(&self, disc: &OrientedMesh, f: usize) -> [f64; 2] {
        let corners = disc.faces.corner_range(f);
        let count = corners.len() as f64;
        let sum: Complex64 = corners.map(|c| self.corner(disc, c)).sum();
        self.lattice_coordinates(sum / count)
    }
}

/// Offsets of a walk through fewer than 2³² faces; wrapping only where an earlier check has failed.
fn plus(a: [i32; 2], b: [i32; 2]) -> [i32; 2] {
    [a[0].wrapping_add(b[0]), a[1].wrapping_add(b[1])]
}

impl Unfolded {
    /// For every corner of `surface`, the source of `disc`, its point: what [`Uv::PerCorner`](crate::io::Uv::PerCorner) takes.
    pub fn source_corners(&self, disc: &OrientedMesh, surface: &Surface) -> Vec<u32> {
        let corner = disc.corners_of(surface);
        // A closed surface has all faces of its source.
        corner.iter().map(|&c| self.corners.get(c as usize).copied().unwrap_or(0)).collect()
    }

    /// The points in the plane (`np × 2`), as [`Uv::PerCorner`](crate::io::Uv::PerCorner) takes them with
    /// [`Unfolded::source_corners`].
    pub fn coordinates(&self, map: &PeriodicMap, tiling: Tiling) -> Vec<[f64; 2]> {
        let omega = map.omega();
        match tiling {
            Tiling::Conformal => {
                let place = |&(v, at): &(u32, [i32; 2])| map.z[v as usize] + Periods::translation(at, omega);
                self.points.iter().map(place).map(|z| [z.re, z.im]).collect()
            }
            Tiling::Whole => {
                let texture = super::whole(map.tau);
                let place = |&(v, [m, n]): &(u32, [i32; 2])| {
                    let [a, b] = map.lattice_coordinates(map.z[v as usize]);
                    texture.place([a + f64::from(m), b + f64::from(n)])
                };
                self.points.iter().map(place).collect()
            }
        }
    }
}
