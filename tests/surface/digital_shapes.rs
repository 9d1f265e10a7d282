//! Digitised shapes: the voxels of the closed form, its topology, its exact normals.

use crate::common::{dot, sub};
use proptest::prelude::*;
use riemap::surface::digital::{Adjacency, DigitalError, Implicit, boundary, digitise, exact_normals};
use riemap::surface::generate::{GenerateError, Generated, generate};
use riemap::surface::parameters::ParameterError;
use riemap::surface::topology::Topology;

fn make(name: &str) -> Generated {
    generate(name).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn normals(g: &Generated) -> &[[f64; 3]] {
    g.digital.as_ref().and_then(|d| d.exact_normals.as_deref()).expect("exact normals")
}

fn centres(g: &Generated) -> Vec<[f64; 3]> {
    let digital = g.digital.as_ref().expect("a digital surface");
    digital.surfels.iter().map(|s| s.centre(&digital.solid)).collect()
}

/// Every lattice point of the box is inside if and only if the closed form says so.
fn is_gauss_digitisation(g: &Generated, inside: impl Fn([f64; 3]) -> bool) {
    let solid = &g.digital.as_ref().expect("a digital surface").solid;
    let size = solid.size().map(|n| n as i32);
    for v in (0..size[2]).flat_map(|k| (0..size[1]).flat_map(move |j| (0..size[0]).map(move |i| [i, j, k]))) {
        let p = solid.centre(v);
        assert_eq!(solid.contains(v), inside(p), "{}: {p:?}", g.name);
        assert!(p.iter().all(|x| x.fract() == 0.0));
        let rim = (0..3).any(|k| v[k] == 0 || v[k] == size[k] - 1);
        assert!(!(rim && inside(p)), "{}: no room around {p:?}", g.name);
    }
}

#[test]
fn voxels_are_those_whose_centres_satisfy_the_closed_form() {
    let (x, y, z) = (0.3, -0.2, 0.1);
    let at = format!("x={x}&y={y}&z={z}");
    let around = |p: [f64; 3]| sub(p, [x, y, z]);
    is_gauss_digitisation(&make(&format!("digital-torus?R=7.3&r=2.9&{at}")), |p| {
        let [x, y, z] = around(p);
        (x.hypot(y) - 7.3).powi(2) + z * z <= 2.9 * 2.9
    });
    is_gauss_digitisation(&make(&format!("digital-ball?R=6.6&{at}")), |p| {
        let q = around(p);
        dot(q, q) <= 6.6 * 6.6
    });
    is_gauss_digitisation(&make(&format!("digital-cap?R=6.6&{at}")), |p| {
        let q = around(p);
        dot(q, q) <= 6.6 * 6.6
    });
    is_gauss_digitisation(&make(&format!("digital-ellipsoid?a=7&b=6&c=5&{at}")), |p| {
        let [x, y, z] = around(p);
        (x / 7.0).powi(2) + (y / 6.0).powi(2) + (z / 5.0).powi(2) <= 1.0
    });
    is_gauss_digitisation(&make(&format!("digital-box?a=4.5&b=3&c=2&{at}")), |p| {
        let [x, y, z] = around(p);
        x.abs() <= 4.5 && y.abs() <= 3.0 && z.abs() <= 2.0
    });
    // turned by 40 degrees about (2, 1, 0): the normal of the broad side, (0, 0, 1) before
    let (sin, cos) = 40.0_f64.to_radians().sin_cos();
    let root = 5.0_f64.sqrt();
    let normal = [sin / root, -2.0 * sin / root, cos];
    is_gauss_digitisation(&make("digital-ellipsoid?a=12&b=12&c=6&tilt=40"), |p| {
        let along = dot(p, normal);
        (dot(p, p) - along * along) / 144.0 + along * along / 36.0 <= 1.0
    });
}

/// About the size of the paper's; counted with numpy.
#[test]
fn tori_have_the_surfels_that_another_program_counts() {
    for (at, count) in [("", 1560), ("&x=0.5&y=0.5&z=0.5", 1400), ("&x=0.3&y=0.2&z=0.1", 1536)] {
        let g = make(&format!("digital-torus?R=8&r=3.2{at}"));
        assert_eq!(g.surface.faces().len(), count, "{at}");
        assert_eq!(g.period, Some([0.0, 3.2 / (64.0_f64 - 3.2 * 3.2).sqrt()]));
    }
}

#[test]
fn caps_are_discs_wherever_the_centre_is() {
    for radius in [2.0, 3.0, 5.3, 8.0, 16.0, 31.4] {
        for angle in [5.0, 30.0, 60.0, 89.0, 90.0, 110.0, 150.0] {
            for at in ["", "&x=0.5&y=0.5&z=0.5", "&x=0.13&y=0.37&z=-0.21", "&z=1", "&x=0.5", "&z=0.999"] {
                let g = make(&format!("digital-cap?R={radius}&angle={angle}{at}"));
                let topology = Topology::new(&g.surface);
                assert!(topology.components.len() == 1 && topology.components[0].is_disc(), "{}", g.name);
                assert!(topology.orientation.flip.iter().all(|&flip| !flip), "{}", g.name);
                assert_eq!(g.exact.as_ref().map(Vec::len), Some(g.surface.positions().len()));
                // open: nothing lies in the plane of the rim, the lowest pointels
                let low = g.surface.positions().iter().map(|p| p[2]).fold(f64::INFINITY, f64::min);
                assert!(centres(&g).iter().all(|c| c[2] > low + 0.25), "{}", g.name);
            }
        }
    }
}

/// Largest distance of the rim from |w| = 1.
fn off_circle(radius: f64) -> f64 {
    let g = make(&format!("digital-cap?R={radius}&x=0.21&y=0.34&z=0.13"));
    let topology = Topology::new(&g.surface);
    let exact = g.exact.as_ref().expect("exact coordinates");
    let rim = (0..topology.edges.len()).filter(|&e| topology.edges.corners(e).len() == 1);
    rim.flat_map(|e| topology.edges.ends[e])
        .map(|v| {
            let [x, y] = exact[v as usize];
            (x.hypot(y) - 1.0).abs()
        })
        .fold(0.0, f64::max)
}

#[test]
fn the_rim_of_a_cap_tends_to_the_unit_circle() {
    let [coarse, fine] = [16.0, 128.0].map(off_circle);
    assert!(coarse < 0.1, "{coarse}");
    // order 1, with room for where the plane happens to be
    assert!(fine < coarse / 4.0, "{coarse} → {fine}");
}

#[test]
fn exact_coordinates_of_a_cap_are_the_stereographic_ones_of_the_sphere() {
    let g = make("digital-cap?R=20&x=0.2&z=0.4");
    let exact = g.exact.as_ref().expect("exact coordinates");
    // back onto the sphere with one scale for all: the directions from the centre
    let ratio = |p: [f64; 3], [u, v]: [f64; 2]| {
        let q = sub(p, [0.2, 0.0, 0.4]);
        let angle = (q[0].hypot(q[1])).atan2(q[2]);
        assert!((q[1].atan2(q[0]) - v.atan2(u)).abs() < 1e-12);
        u.hypot(v) / (0.5 * angle).tan()
    };
    let first = ratio(g.surface.positions()[0], exact[0]);
    for (&p, &w) in g.surface.positions().iter().zip(exact) {
        assert!((ratio(p, w) / first - 1.0).abs() < 1e-12);
    }
}

#[test]
fn exact_normals_are_those_of_the_closest_points() {
    for name in ["digital-ball?R=7&x=0.3", "digital-cap?R=7&x=0.3"] {
        let g = make(name);
        for (centre, n) in centres(&g).iter().zip(normals(&g)) {
            let q = sub(*centre, [0.3, 0.0, 0.0]);
            assert!(sub(q.map(|x| x / dot(q, q).sqrt()), *n).iter().all(|x| x.abs() < 1e-14));
        }
    }
    let g = make("digital-torus?R=9&r=3&y=0.4&tilt=35");
    let (sin, cos) = 35.0_f64.to_radians().sin_cos();
    let axis = [sin / 5.0_f64.sqrt(), -2.0 * sin / 5.0_f64.sqrt(), cos];
    for (centre, n) in centres(&g).iter().zip(normals(&g)) {
        let q = sub(*centre, [0.0, 0.4, 0.0]);
        let flat = sub(q, axis.map(|x| x * dot(q, axis)));
        let off = sub(q, flat.map(|x| 9.0 * x / dot(flat, flat).sqrt()));
        assert!(sub(off.map(|x| x / dot(off, off).sqrt()), *n).iter().all(|x| x.abs() < 1e-12));
    }
    // the sharpest ellipsoid: with the point q of the surface that has the normal n, centre − q is a multiple of n
    let g = make("digital-ellipsoid?a=24&b=9&c=6&x=0.2&y=0.4&z=0.1");
    for (centre, n) in centres(&g).iter().zip(normals(&g)) {
        let weighted = [24.0 * n[0], 9.0 * n[1], 6.0 * n[2]];
        let length = dot(weighted, weighted).sqrt();
        let q = [24.0 * weighted[0] / length + 0.2, 9.0 * weighted[1] / length + 0.4, 6.0 * weighted[2] / length + 0.1];
        let off = sub(*centre, q);
        let across = sub(off, n.map(|x| x * dot(off, *n)));
        assert!(across.iter().all(|x| x.abs() < 1e-9), "{centre:?}: {across:?}");
        assert!(dot(off, *n).abs() <= 0.5 + 1e-12);
    }
}

#[test]
fn normals_of_a_box_are_those_of_its_faces() {
    let g = make("digital-box?a=5.9&b=4.1&c=3.5&x=0.3");
    let digital = g.digital.as_ref().expect("a digital surface");
    assert!(digital.surfels.iter().zip(normals(&g)).all(|(s, n)| s.normal() == *n));
    let g = make("digital-box?a=9&b=7&c=5&tilt=33&y=0.2");
    let mut kinds: Vec<[i64; 3]> = normals(&g).iter().map(|n| n.map(|x| (1e9 * x).round() as i64)).collect();
    kinds.sort_unstable();
    kinds.dedup();
    assert_eq!(kinds.len(), 6, "{kinds:?}");
    let digital = g.digital.as_ref().expect("a digital surface");
    assert!(digital.surfels.iter().zip(normals(&g)).all(|(s, n)| dot(s.normal(), *n) > 0.0));
}

#[test]
fn shapes_too_thin_for_voxels_are_refused_by_parameter() {
    for (name, parameter) in [
        ("digital-torus?R=4&r=3.5", "r"),
        // pearls on a string, and nothing at all
        ("digital-torus?R=10&r=0.6&x=0.3", "r"),
        ("digital-torus?R=10&r=0.1&x=0.3&z=0.5", "r"),
        ("digital-ellipsoid?a=100&b=50&c=10", "c"),
    ] {
        match generate(name) {
            Err(GenerateError::Parameters(ParameterError::OutOfRange { parameter: found, circumstance, .. })) => {
                assert!(found == parameter && !circumstance.is_empty(), "{name}: {found}{circumstance}");
            }
            other => panic!("{name}: {:?}", other.map(|g| g.name)),
        }
    }
}

/// x⁴ + y⁴ + z⁴ ≤ r⁴, which says nothing of distances.
struct Rounded(f64);

impl Implicit for Rounded {
    fn value(&self, p: [f64; 3]) -> f64 {
        p.iter().map(|x| x.powi(4)).sum::<f64>() - self.0.powi(4)
    }

    fn gradient(&self, p: [f64; 3]) -> [f64; 3] {
        p.map(|x| 4.0 * x.powi(3))
    }
}

#[test]
fn any_implicit_shape_can_be_digitised() {
    let shape = Rounded(9.4);
    let solid = digitise(&shape, [[-10.2; 3], [10.7; 3]]).expect("a solid");
    assert_eq!((solid.size(), solid.origin()), ([21; 3], [-10.0; 3]));
    assert!(solid.voxels().all(|v| shape.value(solid.centre(v)) <= 0.0));
    let (_, digital) = boundary(solid, Adjacency::Six, 0).expect("a boundary");
    for (surfel, n) in digital.surfels.iter().zip(exact_normals(&shape, &digital)) {
        assert!((dot(n, n) - 1.0).abs() < 1e-14 && dot(n, surfel.normal()) > -0.2, "{surfel:?} {n:?}");
    }
    let bounds = |low: f64, high: f64| digitise(&shape, [[-1.0, low, -1.0], [1.0, high, 1.0]]).map(|s| s.size());
    assert_eq!(bounds(0.2, 0.8), Ok([3, 0, 3]));
    assert_eq!(bounds(1.0, 0.0), Err(DigitalError::Bounds { axis: 1, bounds: [1.0, 0.0] }));
    assert!(matches!(bounds(f64::NAN, 0.0), Err(DigitalError::Bounds { axis: 1, .. })));
    assert!(matches!(bounds(0.0, f64::INFINITY), Err(DigitalError::Bounds { axis: 1, .. })));
    assert!(matches!(bounds(0.0, 1e12), Err(DigitalError::TooLarge { .. })));
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 64, ..ProptestConfig::default() })]

    #[test]
    fn digital_tori_have_genus_1_and_balls_genus_0_wherever_they_are(
        at in [-1.0_f64..1.0, -1.0_f64..1.0, -1.0_f64..1.0],
        tilt in -180.0_f64..180.0,
        big in 6.0_f64..14.0,
        share in 0.35_f64..0.7,
    ) {
        let at = format!("x={}&y={}&z={}", at[0], at[1], at[2]);
        for (name, euler) in [
            (format!("digital-torus?R={big}&r={}&tilt={tilt}&{at}", share * big), 0),
            (format!("digital-ball?R={big}&{at}"), 2),
            (format!("digital-ellipsoid?a={}&b={big}&c={big}&tilt={tilt}&{at}", 1.4 * big), 2),
            (format!("digital-box?a={big}&b=5&c={}&tilt={tilt}&{at}", share * big), 2),
        ] {
            let g = make(&name);
            let topology = Topology::new(&g.surface);
            prop_assert!(topology.components.len() == 1 && topology.components[0].manifold, "{}", name);
            prop_assert_eq!(topology.components[0].euler(), euler, "{}", name);
            prop_assert!(normals(&g).iter().all(|n| (dot(*n, *n) - 1.0).abs() < 1e-12), "{}", name);
        }
    }
}
