use super::shared::*;
use crate::common::*;
use num_complex::Complex64;
use riemap::energy::conformal::Weight;
use riemap::map::periodic::{PeriodicMap, Tiling};
use riemap::surface::edges::Edges;
use riemap::surface::oriented_mesh::OrientedMesh;
use riemap::surface::{Surface, generate::generate};

fn cases() -> Vec<(Surface, OrientedMesh, PeriodicMap)> {
    let digital = generate("digital-torus?R=6&r=2.5&x=0.3&y=0.2&z=0.1").unwrap().surface;
    let turned = flipped(&torus_surface(9, "&mesh=triangle"), [3, 50, 51]);
    let surfaces = [
        torus_surface(12, ""),
        torus_surface(11, ""),
        torus_surface(10, "&mesh=triangle&diagonal=same"),
        turned,
        digital,
    ];
    let mapped = surfaces.into_iter().map(|s| {
        let disc = closed(&s);
        let found = map(&disc, &graph_of(&disc, "barycentre"), Weight::Integral);
        (s, disc, found)
    });
    mapped.collect()
}

/// For every inner edge the jumps of texture coordinates at its two ends, from one face to the other.
fn jumps(disc: &OrientedMesh, corners: &[u32], coordinates: &[[f64; 2]]) -> Vec<[Complex64; 2]> {
    let edges = Edges::new(&disc.faces, disc.positions.len());
    let at = |c: usize| Complex64::new(coordinates[corners[c] as usize][0], coordinates[corners[c] as usize][1]);
    let next = |c: usize| {
        let range = disc.faces.corner_range(edges.face_of_corner[c] as usize);
        if c + 1 == range.end { range.start } else { c + 1 }
    };
    let both = (0..edges.len()).map(|e| {
        let [c, d] = [edges.corners(e)[0], edges.corners(e)[1]].map(|c| c as usize);
        [at(next(d)) - at(c), at(d) - at(next(c))]
    });
    both.collect()
}

#[test]
fn across_every_edge_coordinates_jump_by_a_period_or_not_at_all() {
    for (_, disc, found) in cases() {
        let unfolded = found.unfold(&disc);
        let coordinates = unfolded.coordinates(&found, Tiling::Conformal);
        let mut seams = 0;
        for [start, end] in jumps(&disc, &unfolded.corners, &coordinates) {
            assert!((start - end).norm() < 1e-12, "the same at both ends");
            // rounding of coordinates of size 3
            assert!(is_period(&found, start, 1e-12), "{start}");
            seams += usize::from(start.norm() > 1e-6);
        }
        assert!(seams > 0, "a torus has a seam");
    }
}

#[test]
fn the_faces_cover_the_torus_once_and_lie_beside_each_other() {
    for (_, disc, found) in cases() {
        let unfolded = found.unfold(&disc);
        let coordinates = unfolded.coordinates(&found, Tiling::Conformal);
        let at = |c: usize| {
            Complex64::new(coordinates[unfolded.corners[c] as usize][0], coordinates[unfolded.corners[c] as usize][1])
        };
        let area: f64 = (0..disc.faces.len())
            .map(|f| {
                let corners: Vec<Complex64> = disc.faces.corner_range(f).map(at).collect();
                (0..corners.len()).map(|k| 0.5 * (corners[k].conj() * corners[(k + 1) % corners.len()]).im).sum::<f64>()
            })
            .sum();
        assert!((area - found.tau.im).abs() < 1e-11, "{area} for {}", found.tau);

        // Faces that share two points lie side by side: all of them are connected so.
        let edges = Edges::new(&disc.faces, disc.positions.len());
        let jumps = jumps(&disc, &unfolded.corners, &coordinates);
        let mut part: Vec<usize> = (0..disc.faces.len()).collect();
        fn root(part: &mut [usize], mut f: usize) -> usize {
            while part[f] != f {
                part[f] = part[part[f]];
                f = part[f];
            }
            f
        }
        for e in (0..edges.len()).filter(|&e| jumps[e][0].norm() < 1e-9) {
            let [f, g] = [0, 1].map(|k| edges.face_of_corner[edges.corners(e)[k] as usize] as usize);
            let (f, g) = (root(&mut part, f), root(&mut part, g));
            part[f] = g;
            // Side by side is not by chance: the points are the same.
            assert_eq!(unfolded.corners[edges.corners(e)[0] as usize], {
                let d = edges.corners(e)[1] as usize;
                let range = disc.faces.corner_range(edges.face_of_corner[d] as usize);
                unfolded.corners[if d + 1 == range.end { range.start } else { d + 1 }]
            });
        }
        let first = root(&mut part, 0);
        assert!((0..disc.faces.len()).all(|f| root(&mut part, f) == first), "connected");
        // About the parallelogram of the periods: no face is further from its centre than the rim and a face.
        let far = coordinates.iter().map(|&[x, y]| {
            let [a, b] = found.lattice_coordinates(Complex64::new(x, y));
            (a - 0.5).abs().max((b - 0.5).abs())
        });
        assert!(far.fold(0.0, f64::max) < 0.75);
    }
}

#[test]
fn no_point_is_there_twice_and_those_of_a_vertex_are_apart_by_periods() {
    for (_, disc, found) in cases() {
        let unfolded = found.unfold(&disc);
        let mut points = unfolded.points.clone();
        points.sort_unstable();
        points.dedup();
        assert_eq!(points.len(), unfolded.points.len());
        assert_eq!(unfolded.corners.len(), disc.faces.corners().len());
        for (c, &point) in unfolded.corners.iter().enumerate() {
            assert_eq!(unfolded.points[point as usize].0, disc.faces.corners()[c]);
        }
        assert!(points.len() > disc.positions.len() && points.len() < 2 * disc.positions.len());
    }
}

#[test]
fn the_corners_of_the_source_get_the_points_of_their_vertices() {
    for (s, disc, found) in cases() {
        let unfolded = found.unfold(&disc);
        let corners = unfolded.source_corners(&disc, &s);
        assert_eq!(corners.len(), s.faces().corners().len());
        for (&point, &vertex) in corners.iter().zip(s.faces().corners()) {
            assert_eq!(disc.source_vertex[unfolded.points[point as usize].0 as usize], vertex);
        }
    }
}

#[test]
fn textures_with_whole_periods_have_no_seam() {
    for (_, disc, found) in cases() {
        let unfolded = found.unfold(&disc);
        let coordinates = unfolded.coordinates(&found, Tiling::Whole);
        for [start, end] in jumps(&disc, &unfolded.corners, &coordinates) {
            for jump in [start, end] {
                let [s, t] = [jump.re, jump.im].map(f64::round);
                assert!((jump - Complex64::new(s, t)).norm() < 1e-11, "{jump} is whole");
                assert_eq!((s + t).rem_euclid(2.0), 0.0, "{jump}: a checkerboard closes up");
            }
        }
    }
}
