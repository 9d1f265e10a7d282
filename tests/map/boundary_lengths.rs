//! Free maps with boundary lengths that are asked for.

use num_complex::Complex64;
use riemap::input::Input;
use riemap::io::{BoundaryLengths, LengthUnit, PerEdge, read_boundary_lengths};
use riemap::map::{
    Boundary, BoundaryName, FlatOptions, LengthsError, LengthsRecord, MapError, MapOptions, Mapped, OptionsError,
    map_input,
};
use riemap::solver::Silent;

fn free(lengths: Option<BoundaryLengths>) -> MapOptions {
    MapOptions { boundary: Boundary::Free { lengths, overlap: true }, ..MapOptions::default() }
}

fn map(input: &Input, options: &MapOptions) -> Mapped {
    map_input(input, options, &mut Silent).unwrap_or_else(|error| panic!("{error}"))
}

fn lengths(values: Vec<f64>) -> Option<BoundaryLengths> {
    Some(BoundaryLengths { unit: LengthUnit::Lengths, values: PerEdge::InOrder(values) })
}

fn factors(values: Vec<f64>) -> Option<BoundaryLengths> {
    Some(BoundaryLengths { unit: LengthUnit::Factors, values: PerEdge::InOrder(values) })
}

fn record(mapped: &Mapped) -> LengthsRecord {
    let domain = &mapped.domain;
    LengthsRecord::new(domain.prescribed.as_ref().unwrap(), &domain.disc, &domain.graph, &mapped.map.z)
}

fn boundary(mapped: &Mapped) -> Vec<usize> {
    mapped.domain.disc.boundary.iter().map(|&v| v as usize).collect()
}

/// The largest distance of z from w over the mesh's vertices after the best similarity, relative to the size of w.
fn distance_after_similarity(z: &[Complex64], w: &[Complex64]) -> f64 {
    let mean = |z: &[Complex64]| z.iter().sum::<Complex64>() / z.len() as f64;
    let (z0, w0) = (mean(z), mean(w));
    let (mut product, mut square) = (Complex64::ZERO, 0.0);
    for (z, w) in z.iter().zip(w) {
        product += (z - z0).conj() * (w - w0);
        square += (z - z0).norm_sqr();
    }
    let (a, mut size, mut worst) = (product / square, 0.0f64, 0.0f64);
    for (z, w) in z.iter().zip(w) {
        worst = worst.max((a * (z - z0) - (w - w0)).norm());
        size = size.max((w - w0).norm());
    }
    worst / size
}

const SURFACES: [&str; 3] = ["graph:cos+cos?n=17", "sphere?n=12&mesh=triangle", "enneper?n=12&mesh=delaunay"];

#[test]
fn factors_of_1_are_the_free_map_bit_for_bit() {
    for name in SURFACES {
        let input = Input::open(name).unwrap();
        let plain = map(&input, &free(None));
        let asked = map(&input, &free(factors(vec![1.0; boundary(&plain).len()])));
        assert_eq!(asked.map.z, plain.map.z, "{name}");
    }
}

#[test]
fn equal_factors_scale_the_map() {
    for name in SURFACES {
        let input = Input::open(name).unwrap();
        let plain = map(&input, &free(None));
        let scaled = map(&input, &free(factors(vec![3.0; boundary(&plain).len()])));
        // Both have the first boundary vertex on the circle of their perimeter.
        let size = plain.map.z.iter().map(|z| z.norm()).fold(0.0, f64::max);
        let off = plain.map.z.iter().zip(&scaled.map.z).map(|(z, w)| (3.0 * z - w).norm()).fold(0.0, f64::max);
        // Lengths are kept to 1e-9, twice.
        assert!(off < 1e-7 * size, "{name}: {off:e}");
        assert!(record(&scaled).error.max < 1e-8, "{name}");
    }
}

#[test]
fn the_lengths_of_an_exact_conformal_image_make_the_exact_map_with_order_2() {
    for name in ["sphere?n=", "enneper?n=", "plane?n="] {
        for kind in ["quad", "triangle"] {
            let errors = [8, 16, 32, 64].map(|n| {
                let input = Input::open(&format!("{name}{n}&mesh={kind}")).unwrap();
                let exact: Vec<Complex64> =
                    input.exact.as_ref().unwrap().iter().map(|&[x, y]| Complex64::new(x, y)).collect();
                let loop_ = boundary(&map(&input, &free(None)));
                let ahead = |k: usize| (exact[loop_[(k + 1) % loop_.len()]] - exact[loop_[k]]).norm();
                let asked = map(&input, &free(lengths((0..loop_.len()).map(ahead).collect())));
                assert!(record(&asked).error.max < 1e-8, "{name}{n} {kind}");
                distance_after_similarity(&asked.map.z[..exact.len()], &exact)
            });
            // Triangles, whose boundary edges are bent at their middle, begin with smaller errors and come to it later.
            let (order, least) = ((errors[2] / errors[3]).log2(), if kind == "quad" { 1.9 } else { 1.3 });
            assert!(errors[3] < 1e-3 && order > least, "{name} {kind}: {errors:?}");
        }
    }
}

#[test]
fn the_lengths_of_a_regular_polygon_make_a_circle() {
    // The circle map's own boundary lengths: the disc, of which H + L' knows nothing else.
    let input = Input::open("graph:cos+cos?n=33").unwrap();
    let circle = map(&input, &MapOptions::default());
    let loop_ = boundary(&circle);
    let on_circle: Vec<Complex64> = loop_.iter().map(|&v| circle.map.z[v]).collect();
    let chord = |k: usize| (on_circle[(k + 1) % loop_.len()] - on_circle[k]).norm();
    let asked = map(&input, &free(lengths((0..loop_.len()).map(chord).collect())));
    assert!(distance_after_similarity(&asked.map.z, &circle.map.z) < 1e-4);
    assert_eq!(asked.distortion.flipped, 0);
}

#[test]
fn levenberg_marquardt_keeps_the_same_lengths() {
    // On quad meshes: of triangle meshes the energy L' keeps the half edges.
    for name in ["graph:cos+cos?n=17", "sphere?n=12"] {
        let input = Input::open(name).unwrap();
        let count = boundary(&map(&input, &free(None))).len();
        let wavy: Vec<f64> = (0..count).map(|k| 1.0 + 0.2 * (6.0 * k as f64 / count as f64).sin()).collect();
        let [reduced, other] = ["reduced", "levenberg-marquardt"]
            .map(|solver| map(&input, &MapOptions { solver: solver.into(), ..free(factors(wavy.clone())) }));
        assert!(record(&reduced).error.max < 1e-8 && record(&other).error.max < 1e-4, "{name}");
        let distance = distance_after_similarity(&other.map.z, &reduced.map.z);
        assert!(distance < 1e-3, "{name}: {distance:e}");
    }
}

#[test]
fn edges_may_be_named_in_any_order() {
    let input = Input::open("graph:cos+cos?n=9").unwrap();
    let loop_ = boundary(&map(&input, &free(None)));
    let value = |k: usize| 0.5 + 0.01 * k as f64;
    let by_order = map(&input, &free(lengths((0..loop_.len()).map(value).collect())));
    let mut named: Vec<([u32; 2], f64)> =
        (0..loop_.len()).map(|k| ([loop_[(k + 1) % loop_.len()] as u32, loop_[k] as u32], value(k))).collect();
    named.reverse();
    let by_ends = BoundaryLengths { unit: LengthUnit::Lengths, values: PerEdge::ByEnds(named.clone()) };
    assert_eq!(map(&input, &free(Some(by_ends))).map.z, by_order.map.z);
    named.pop();
    let refused = |values: PerEdge| {
        let asked = Some(BoundaryLengths { unit: LengthUnit::Lengths, values });
        match map_input(&input, &free(asked), &mut Silent) {
            Err(MapError::Lengths(error)) => error,
            other => panic!("{:?}", other.map(|mapped| mapped.map.provenance.to_string())),
        }
    };
    let [v, w] = [loop_[0] as u32, loop_[1] as u32];
    assert_eq!(refused(PerEdge::ByEnds(named.clone())), LengthsError::Missing { v, w, edges: loop_.len() });
    named.push(([v, 40], 1.0));
    assert_eq!(refused(PerEdge::ByEnds(named)), LengthsError::NoSuchEdge { v, w: 40 });
    assert_eq!(refused(PerEdge::InOrder(vec![1.0; 5])), LengthsError::Count { found: 5, edges: loop_.len() });
    let mut long = vec![1.0; loop_.len()];
    long[3] = loop_.len() as f64;
    assert!(matches!(refused(PerEdge::InOrder(long)), LengthsError::Open { .. }));
}

#[test]
fn maps_that_keep_no_lengths_refuse_them() {
    let input = Input::open("graph:cos+cos?n=9").unwrap();
    let lengths = || factors(vec![1.0; 32]);
    for boundary in [BoundaryName::Circle, BoundaryName::Fixed, BoundaryName::Periodic] {
        let flat = FlatOptions { boundary: Some(boundary), boundary_lengths: lengths(), ..FlatOptions::default() };
        let refusal = MapOptions::try_from(flat).unwrap_err();
        assert!(matches!(refusal, OptionsError::OtherBoundary { key: "boundary-lengths", .. }), "{refusal}");
    }
    let options = MapOptions { energy: Some("H + L".parse().unwrap()), ..free(lengths()) };
    let error = map_input(&input, &options, &mut Silent).map(|mapped| mapped.map.provenance.to_string());
    assert!(matches!(error, Err(MapError::Lengths(LengthsError::NotKept { .. }))), "{error:?}");
}

#[test]
fn files_of_lengths_are_read_and_bad_ones_refused_by_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("lengths.txt");
    let read = |text: &str| {
        std::fs::write(&path, text).unwrap();
        read_boundary_lengths(&path).map_err(|error| error.to_string())
    };
    assert_eq!(read("# asked for\nfactors\n1 # first\n\n2.5\n"), Ok(factors(vec![1.0, 2.5]).unwrap()));
    assert_eq!(read("lengths\r\n1\r\n"), Ok(lengths(vec![1.0]).unwrap()));
    let named =
        BoundaryLengths { unit: LengthUnit::Lengths, values: PerEdge::ByEnds(vec![([3, 4], 0.5), ([0, 3], 2.0)]) };
    assert_eq!(read("3 4 0.5\n0 3 2"), Ok(named));
    for (text, told) in [
        ("1\n0\n", "line 2"),
        ("1\n-2\n", "line 2"),
        ("nan\n", "line 1"),
        ("1\n\n0 1 2\n", "line 3"),
        ("0 1 2\n3\n", "line 2"),
        ("1 2\n", "line 1"),
        ("lengths\nfactors\n1\n", "line 2"),
        ("0 1 1\n1 0 2\n", "line 2: edge 1 0 is already given in line 1"),
        ("-1 1 1\n", "line 1"),
    ] {
        let message = read(text).unwrap_err();
        assert!(message.contains(told) && message.contains("lengths.txt"), "{text:?}: {message}");
    }
    assert!(read_boundary_lengths(&folder.path().join("none.txt")).unwrap_err().to_string().contains("none.txt"));
}
