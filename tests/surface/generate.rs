//! Generated surfaces: the meshes are what their names promise.

use std::collections::HashMap;

use proptest::prelude::*;
use riemap::surface::generate::{Form, Generated, SURFACES, SurfaceKind, Values, generate};

fn make(source: &str) -> Generated {
    generate(source).unwrap_or_else(|error| panic!("{source}: {error}"))
}

/// Whether the surface has all these parameters, and these meshes.
fn takes(row: &SurfaceKind, query: &str) -> bool {
    query.split('&').filter_map(|pair| pair.split_once('=')).all(|(name, value)| {
        row.all_parameters().find(|p| p.name == name).is_some_and(|p| match p.values {
            Values::Choice(words) => words.contains(&value),
            _ => true,
        })
    })
}

/// Every kind in every mesh it has, small, with random parts where there are any.
fn everything() -> Vec<Generated> {
    let mut names = Vec::new();
    for row in SURFACES {
        names.push(row.name.to_string());
        if row.all_parameters().all(|p| p.name != "n") {
            continue;
        }
        for n in [3, 4, 9, 20] {
            for tail in [
                "mesh=quad&jitter=0.45&seed=1",
                "mesh=quad",
                "mesh=triangle&diagonal=same",
                "mesh=triangle&diagonal=alternate&jitter=0.3&seed=2",
                "mesh=triangle&diagonal=random&jitter=0.45&seed=3",
                "mesh=delaunay&seed=4",
                "mesh=delaunay&points=random&seed=5",
            ] {
                if takes(row, tail) {
                    names.push(format!("{}?n={n}&{tail}", row.name));
                }
            }
        }
    }
    names.iter().map(|name| make(name)).collect()
}

/// The faces at every edge, as (smaller vertex, larger vertex) → directed uses (forward, backward).
fn edges(g: &Generated) -> HashMap<(u32, u32), (usize, usize)> {
    let mut edges = HashMap::new();
    for face in g.surface.faces().iter() {
        for (k, &a) in face.iter().enumerate() {
            let b = face[(k + 1) % face.len()];
            let uses: &mut (usize, usize) = edges.entry((a.min(b), a.max(b))).or_default();
            if a < b { uses.0 += 1 } else { uses.1 += 1 }
        }
    }
    edges
}

fn twice_area([a, b, c]: [[f64; 2]; 3]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Share of interior edges with ½ (cot α + cot β) < 0, and of triangles with an obtuse angle.
fn negative_and_obtuse(g: &Generated) -> (f64, f64) {
    let mut weights: HashMap<(u32, u32), (f64, usize)> = HashMap::new();
    let mut obtuse = 0;
    for face in g.surface.faces().iter() {
        let cotangents = [0, 1, 2].map(|k| {
            let [apex, a, b] = [0, 1, 2].map(|i| g.surface.positions()[face[(k + i) % 3] as usize]);
            let (p, q) = (minus(a, apex), minus(b, apex));
            let normal = cross(p, q);
            dot(p, q) / dot(normal, normal).sqrt()
        });
        obtuse += usize::from(cotangents.iter().any(|&c| c < 0.0));
        for (k, cotangent) in cotangents.iter().enumerate() {
            let (a, b) = (face[(k + 1) % 3], face[(k + 2) % 3]);
            let weight = weights.entry((a.min(b), a.max(b))).or_default();
            *weight = (weight.0 + 0.5 * cotangent, weight.1 + 1);
        }
    }
    let interior: Vec<f64> = weights.values().filter(|w| w.1 == 2).map(|w| w.0).collect();
    let negative = interior.iter().filter(|&&w| w < 0.0).count();
    (negative as f64 / interior.len() as f64, obtuse as f64 / g.surface.faces().len() as f64)
}

#[test]
fn grids_have_the_vertices_and_faces_that_their_names_say() {
    let counts = |name: &str| (make(name).surface.positions().len(), make(name).surface.faces().len());
    assert_eq!(counts("graph:cos+cos?n=33"), (33 * 33, 32 * 32));
    assert_eq!(counts("graph:cos+cos?n=33&mesh=triangle"), (33 * 33, 2 * 32 * 32));
    assert_eq!(counts("sphere?n=32"), (33 * 33, 32 * 32));
    assert_eq!(counts("enneper?n=16&mesh=triangle"), (17 * 17, 2 * 16 * 16));
    assert_eq!(counts("torus?n=16"), (16 * 16, 16 * 16));
    assert_eq!(counts("torus?n=16&mesh=triangle"), (16 * 16, 2 * 16 * 16));
    assert_eq!(counts("graph:flat?n=20&mesh=delaunay").0, 20 * 20);
    for points in ["jittered", "random"] {
        let disc = counts(&format!("plane?n=40&mesh=delaunay&points={points}")).0 as f64;
        assert!((disc / (41.0 * 41.0) - 1.0).abs() < 0.03, "{points}: {disc} vertices instead of about 1681");
    }
}

#[test]
fn every_surface_is_an_oriented_manifold_disc_sphere_or_torus() {
    for g in everything() {
        let (nv, nf) = (g.surface.positions().len(), g.surface.faces().len());
        let edges = edges(&g);
        let mut used = vec![false; nv];
        g.surface.faces().corners().iter().for_each(|&v| used[v as usize] = true);
        assert!(used.iter().all(|&u| u), "{}: unreferenced vertex", g.name);
        assert!(edges.values().all(|&(a, b)| a <= 1 && b <= 1), "{}: edge used twice one way", g.name);
        let boundary: Vec<_> = edges.iter().filter(|(_, uses)| uses.0 + uses.1 == 1).map(|(&e, _)| e).collect();
        let euler = nv as i64 - edges.len() as i64 + nf as i64;
        let expected = match g.name.split('?').next() {
            Some("torus" | "digital-torus") => 0,
            Some("digital-ball" | "digital-ellipsoid" | "digital-box") => 2,
            _ => 1,
        };
        assert_eq!(euler, expected, "{}: Euler number", g.name);
        assert_eq!(g.period.is_some(), euler == 0, "{}: period", g.name);
        assert_eq!(boundary.is_empty(), euler != 1, "{}: boundary", g.name);
        // one loop: every boundary vertex has two boundary edges, and with Euler number 1 the surface is a disc
        let mut degree = HashMap::new();
        boundary.iter().for_each(|&(a, b)| [a, b].iter().for_each(|&v| *degree.entry(v).or_insert(0) += 1));
        assert!(degree.values().all(|&d| d == 2), "{}: pinched boundary", g.name);
    }
}

#[test]
fn every_face_is_positive_and_convex_in_the_exact_coordinates() {
    let mut seen = 0;
    for g in everything() {
        let Some(exact) = &g.exact else { continue };
        seen += 1;
        assert_eq!(exact.len(), g.surface.positions().len());
        for (f, face) in g.surface.faces().iter().enumerate() {
            for k in 0..face.len() {
                let area = twice_area([0, 1, 2].map(|i| exact[face[(k + i) % face.len()] as usize]));
                assert!(area > 0.0, "{}: face {f} has a corner of area {area}", g.name);
            }
        }
    }
    assert!(seen > 100);
}

#[test]
fn exact_coordinates_fill_the_disc_and_put_the_boundary_on_its_circle() {
    for g in everything() {
        let Some(exact) = &g.exact else { continue };
        let edges = edges(&g);
        let mut on_boundary = vec![false; exact.len()];
        for (&(a, b), uses) in &edges {
            if uses.0 + uses.1 == 1 {
                on_boundary[a as usize] = true;
                on_boundary[b as usize] = true;
            }
        }
        for (v, w) in exact.iter().enumerate() {
            let radius = w[0].hypot(w[1]);
            if g.digital.is_some() {
                // the rim is a staircase on the circle: off by a voxel, whose image is below 1/10 at the default size
                assert!(if on_boundary[v] { (radius - 1.0).abs() < 0.1 } else { radius < 1.1 }, "{}: {radius}", g.name);
            } else if on_boundary[v] {
                // one or two roundings of numbers near 1
                assert!((radius - 1.0).abs() < 4.0 * f64::EPSILON, "{}: vertex {v} at radius {radius}", g.name);
            } else {
                assert!(radius < 1.0, "{}: interior vertex {v} at radius {radius}", g.name);
            }
        }
    }
}

#[test]
fn no_face_is_degenerate_in_space() {
    for g in everything() {
        for (f, face) in g.surface.faces().iter().enumerate() {
            let p: Vec<[f64; 3]> = face.iter().map(|&v| g.surface.positions()[v as usize]).collect();
            assert!(p.iter().flatten().all(|x| x.is_finite()), "{}: face {f}", g.name);
            // quads by their diagonals, as ρ sees them
            let (a, b) = if p.len() == 4 {
                (minus(p[2], p[0]), minus(p[3], p[1]))
            } else {
                (minus(p[1], p[0]), minus(p[2], p[0]))
            };
            let normal = cross(a, b);
            let sine = (dot(normal, normal) / (dot(a, a) * dot(b, b))).sqrt();
            assert!(sine > 1e-7, "{}: face {f} has sine {sine}", g.name);
        }
    }
}

#[test]
fn discrete_faces_become_conformal_under_refinement() {
    // largest deviation from a similarity, of the triangles' edges over their exact images: order 1 for split grids
    let deviation = |g: &Generated| {
        let exact = g.exact.as_ref().unwrap();
        let mut worst: f64 = 0.0;
        for face in g.surface.faces().iter() {
            let scale = [0, 1, 2].map(|k| {
                let (a, b) = (face[k] as usize, face[(k + 1) % 3] as usize);
                let d = minus(g.surface.positions()[b], g.surface.positions()[a]);
                dot(d, d).sqrt() / (exact[b][0] - exact[a][0]).hypot(exact[b][1] - exact[a][1])
            });
            let (low, high) = scale.iter().fold((f64::MAX, 0.0_f64), |(l, h), &s| (l.min(s), h.max(s)));
            worst = worst.max(high / low - 1.0);
        }
        worst
    };
    for row in SURFACES.iter().filter(|row| matches!(row.form, Form::Disc(_))) {
        for mesh in ["triangle", "delaunay"] {
            let [coarse, fine] = [48, 192].map(|n| deviation(&make(&format!("{}?n={n}&mesh={mesh}", row.name))));
            assert!(fine < 0.1, "{} {mesh}: {fine}", row.name);
            // a quarter, with room for the random meshes' worst triangle
            assert!(fine < 0.45 * coarse, "{} {mesh}: {coarse} → {fine}", row.name);
        }
    }
}

#[test]
fn graphs_have_the_paper_s_positions() {
    use std::f64::consts::PI;
    let g = make("graph:cos+cos?n=5");
    for j in 0..5 {
        for i in 0..5 {
            let (s, t) = (-PI + PI / 2.0 * i as f64, -PI + PI / 2.0 * j as f64);
            let [x, y, z] = g.surface.positions()[5 * j + i];
            assert!((x - s).abs() + (y - t).abs() + (z - s.cos() - t.cos()).abs() < 1e-14);
        }
    }
    assert!(make("graph:flat").surface.positions().iter().all(|p| p[2] == 0.0));
    let steep = make("graph:cos+cos?n=5&amplitude=3");
    assert!((steep.surface.positions()[12][2] - 6.0).abs() < 1e-14);
}

#[test]
fn the_torus_looks_outward_and_states_its_period() {
    let g = make("torus?R=2&r=0.8&n=16");
    let [re, im] = g.period.unwrap();
    assert!(re == 0.0 && (im - 0.436_435_8).abs() < 1e-7);
    // signed volume of the polyhedron, positive when faces look outward; tends to 2π² R r²
    let volume = |g: &Generated| -> f64 {
        let p = |v: u32| g.surface.positions()[v as usize];
        g.surface.faces().iter().map(|f| dot(p(f[0]), cross(p(f[1]), p(f[2]))) / 6.0).sum()
    };
    let exact = 2.0 * std::f64::consts::PI.powi(2) * 2.0 * 0.64;
    let found = volume(&make("torus?R=2&r=0.8&n=200&mesh=triangle"));
    assert!((found / exact - 1.0).abs() < 1e-3, "{found} {exact}");
}

#[test]
fn delaunay_circumcircles_are_empty() {
    for name in
        ["graph:flat?n=14&mesh=delaunay", "plane?n=13&mesh=delaunay", "plane?n=13&mesh=delaunay&points=random&seed=8"]
    {
        let g = make(name);
        let points: Vec<[f64; 2]> =
            g.exact.clone().unwrap_or_else(|| g.surface.positions().iter().map(|p| [p[0], p[1]]).collect());
        for face in g.surface.faces().iter() {
            let [a, b, c] = [0, 1, 2].map(|k| points[face[k] as usize]);
            for (v, p) in points.iter().enumerate() {
                let lift = |q: [f64; 2]| {
                    let (x, y) = (q[0] - p[0], q[1] - p[1]);
                    [x, y, x * x + y * y]
                };
                let inside = dot(lift(a), cross(lift(b), lift(c)));
                // rounding of cocircular boundary points
                assert!(inside < 1e-13, "{name}: vertex {v} lies within the circumcircle of {face:?} by {inside}");
            }
        }
    }
}

#[test]
fn the_same_name_gives_the_same_surface_and_another_seed_another_one() {
    for tail in
        ["mesh=quad&jitter=0.2", "mesh=triangle&diagonal=random", "mesh=delaunay", "mesh=delaunay&points=random"]
    {
        for kind in ["sphere", "graph:gauss"] {
            let of = |seed: u64| make(&format!("{kind}?n=12&{tail}&seed={seed}"));
            assert_eq!(of(1), of(1));
            assert_ne!(of(1).surface, of(2).surface, "{kind} {tail}");
        }
    }
}

#[test]
fn canonical_names_spell_everything_out_and_generate_the_same_surface() {
    assert_eq!(make("sphere?n=7").name, "sphere?n=7&scale=1&mesh=quad&jitter=0&seed=0");
    assert_eq!(make("graph:flat?mesh=delaunay").name, "graph:flat?n=33&mesh=delaunay&points=jittered&seed=0");
    assert_eq!(make("torus").name, "torus?R=2&r=0.8&n=64&mesh=quad&seed=0");
    for g in everything() {
        assert_eq!(make(&g.name), g);
    }
}

#[test]
fn jitter_moves_interior_vertices_only_and_by_no_more_than_asked() {
    use std::f64::consts::PI;
    let (plain, moved) = (make("graph:flat?n=21"), make("graph:flat?n=21&jitter=0.45&seed=3"));
    let cell = PI / 10.0;
    let mut far = 0;
    for (v, (p, q)) in plain.surface.positions().iter().zip(moved.surface.positions()).enumerate() {
        let edge = [v % 21, v / 21].iter().any(|&i| i == 0 || i == 20);
        let most = (p[0] - q[0]).abs().max((p[1] - q[1]).abs()) / cell;
        assert!(if edge { most == 0.0 } else { most <= 0.45 + 1e-12 }, "vertex {v} moved by {most} cells");
        far += usize::from(most > 0.2);
    }
    assert!(far > 150, "only {far} of 361 moved far: too many moves were cut short");
}

#[test]
fn hard_shapes_are_what_they_say() {
    let squares = |name: &str| make(name).surface.faces().len();
    // 6 teeth of 6, a back of 11; 2 × 2 squares each
    assert_eq!(squares("comb?teeth=6&length=6&n=2"), 4 * (6 * 6 + 11));
    assert_eq!(squares("comb?teeth=6&length=6&n=2&mesh=triangle"), 8 * (6 * 6 + 11));
    // one square to begin with, then two legs each of 2, 4, 6 … squares
    assert_eq!(squares("spiral?rounds=3&n=1"), 1 + 2 * (2 + 4 + 6 + 8 + 10 + 12));
    // rows of 2, 4 … 2 · size and back
    assert_eq!(squares("staircase?size=8&n=1"), 2 * 8 * 9);
    // half a sphere of radius 1 and a tube of length 4: 2π (1 + 4)
    let area = |g: &Generated| -> f64 {
        let p = |v: u32| g.surface.positions()[v as usize];
        let twice = |f: &[u32]| {
            let normal = cross(minus(p(f[1]), p(f[0])), minus(p(f[2]), p(f[0])));
            dot(normal, normal).sqrt()
        };
        g.surface.faces().iter().map(|f| 0.5 * twice(f)).sum()
    };
    let [found, exact] = [area(&make("capsule?n=200&mesh=triangle&length=4")), 10.0 * std::f64::consts::PI];
    assert!((found / exact - 1.0).abs() < 1e-3, "{found} {exact}");
    // a plain of area 4 whose spikes and vertices go up and down
    assert!(area(&make("spikes?mesh=triangle&n=200")) > 6.0);
    let rough = make("rough?n=33&height=0.5&mesh=triangle");
    let heights: Vec<f64> = rough.surface.positions().iter().map(|p| p[2]).collect();
    let (low, high) = heights.iter().fold((f64::MAX, f64::MIN), |(l, h), &z| (l.min(z), h.max(z)));
    assert!(low < -0.49 && high > 0.49 && low >= -0.5 && high <= 0.5, "{low} {high}");
    assert!(negative_and_obtuse(&rough).1 > 0.5);
}

#[test]
fn steep_graphs_have_a_third_of_negative_cotan_weights() {
    // a triangle has at most one obtuse angle: a third of the edges is the most there can be
    for (name, vertices, least) in [
        ("graph:saddle?n=142&mesh=triangle&diagonal=same&jitter=0.1&amplitude=10", 20_164, 0.32),
        ("graph:cos+cos?n=142&mesh=triangle&diagonal=same&jitter=0.3&amplitude=10", 20_164, 0.30),
        ("graph:saddle?n=142&mesh=delaunay&amplitude=10&seed=7", 20_164, 0.28),
    ] {
        let g = make(name);
        assert_eq!(g.surface.positions().len(), vertices);
        let (negative, obtuse) = negative_and_obtuse(&g);
        assert!(negative > least && obtuse > 0.95, "{name}: {negative} negative, {obtuse} obtuse");
    }
}

#[test]
fn jittered_delaunay_meshes_of_the_disc_have_well_shaped_triangles() {
    let g = make("plane?c=0&n=60&mesh=delaunay");
    let (negative, obtuse) = negative_and_obtuse(&g);
    // Delaunay in the plane: cot α + cot β ≥ 0 on interior edges, up to rounding
    assert!(negative == 0.0 && obtuse < 0.35, "{negative} negative, {obtuse} obtuse");
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn meshes_of_any_seed_are_valid(seed: u64, n in 2_usize..12, mesh in 0_usize..3) {
        let tail = ["mesh=triangle&diagonal=random&jitter=0.45", "mesh=delaunay", "mesh=delaunay&points=random"][mesh];
        let g = make(&format!("sphere?n={n}&{tail}&seed={seed}"));
        let exact = g.exact.as_ref().unwrap();
        let euler = exact.len() as i64 - edges(&g).len() as i64 + g.surface.faces().len() as i64;
        prop_assert_eq!(euler, 1);
        for face in g.surface.faces().iter() {
            prop_assert!(twice_area([0, 1, 2].map(|k| exact[face[k] as usize])) > 0.0);
        }
    }
}
