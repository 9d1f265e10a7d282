//! A valid map on every disc: hard shapes by construction, random discs of terrible triangles, public meshes.

#![allow(clippy::unwrap_used)]

mod common;

use std::f64::consts::TAU;

use common::*;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use riemap::backend::{Iteration, Observer, Phase, Silent, Status};
use riemap::input::Input;
use riemap::map::{Boundary, MapOptions, Mapped, Outcome, Valid, run};
use riemap::surface::Surface;

/// A quarter of a turn around a tube of this many sides, `rings` times; the first ring is the boundary.
fn tube(sides: u32, rings: u32, height: f64) -> (Vec<[f64; 3]>, Vec<[u32; 4]>) {
    let ring = |k: u32| {
        (0..sides).map(move |i| {
            let angle = TAU * f64::from(i) / f64::from(sides);
            [angle.cos(), angle.sin(), height * f64::from(k)]
        })
    };
    let faces = (0..rings).flat_map(|k| {
        (0..sides).map(move |i| {
            [k * sides + i, k * sides + (i + 1) % sides, (k + 1) * sides + (i + 1) % sides, (k + 1) * sides + i]
        })
    });
    ((0..=rings).flat_map(ring).collect(), faces.collect())
}

/// A long tube with one end closed by a fan: conformal maps shrink the end by e^{−2π length/girth}.
fn capsule(length: u32) -> Surface {
    let sides = 12;
    let (mut positions, quads) = tube(sides, length, 0.5);
    let tip = positions.len() as u32;
    positions.push([0.0, 0.0, 0.5 * f64::from(length) + 0.3]);
    let walls = quads.iter().flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]);
    let fan = (0..sides).map(|i| [length * sides + i, length * sides + (i + 1) % sides, tip]);
    surface(positions, walls.chain(fan).map(|f| f.to_vec()))
}

/// A square with spikes drawn out of it, `height` times as high as a cell is wide.
fn spikes(n: u32, height: f64) -> Surface {
    let mut grid = triangulated(&quad_grid(n, n, Sides::Free));
    for v in 0..(n + 1) * (n + 1) {
        let (i, j) = (v % (n + 1), v / (n + 1));
        let spike = if i % 4 == 2 && j % 4 == 2 { height } else { 0.0 };
        grid.positions[v as usize] = [f64::from(i), f64::from(j), spike];
    }
    grid
}

/// Teeth of a comb: strips `length` cells long and one wide on a common back, `teeth` of them.
fn comb(teeth: u32, length: u32) -> Surface {
    let grid = quad_grid(2 * teeth - 1, length + 1, Sides::Free);
    let across = 2 * teeth;
    let mut s = grid;
    for (v, p) in s.positions.iter_mut().enumerate() {
        *p = [f64::from(v as u32 % across), f64::from(v as u32 / across), 0.0];
    }
    let kept = filtered(&s, |f| (f as u32) / (2 * teeth - 1) == 0 || ((f as u32) % (2 * teeth - 1)).is_multiple_of(2));
    triangulated(&kept)
}

/// A strip `n` cells long that is wound up in the plane, one cell wide.
fn spiral(n: u32) -> Surface {
    let mut s = quad_grid(n, 1, Sides::Free);
    for (v, p) in s.positions.iter_mut().enumerate() {
        let (i, j) = (v as u32 % (n + 1), v as u32 / (n + 1));
        let angle = 0.15 * f64::from(i);
        let radius = 5.0 + 0.3 * angle - 0.8 * f64::from(j);
        *p = [radius * angle.cos(), radius * angle.sin(), 0.0];
    }
    // The inner side has the larger j here: seen from above the faces turn right.
    let all = 0..s.faces.len();
    triangulated(&flipped(&s, all))
}

/// The cells of a grid over a disc, its boundary a staircase.
fn staircase(n: u32, bump: f64) -> Surface {
    let grid = quad_grid(n, n, Sides::Free);
    let place = |v: u32| [f64::from(v % (n + 1)), f64::from(v / (n + 1))].map(|x| 2.0 * x / f64::from(n) - 1.0);
    let positions = (0..(n + 1) * (n + 1)).map(|v| {
        let [x, y] = place(v);
        [x, y, bump * (2.0 * x * x + x * y)]
    });
    let inside = |face: &[u32]| {
        let [x, y] = face.iter().fold([0.0; 2], |m, &v| [m[0] + 0.25 * place(v)[0], m[1] + 0.25 * place(v)[1]]);
        x * x + y * y < 1.0
    };
    surface(positions.collect(), grid.faces.iter().filter(|face| inside(face)))
}

/// A flat grid of triangles whose vertices are anywhere within their cells, and heights to match.
fn rough(n: u32, random: &mut Random) -> Surface {
    let mut s = triangulated(&quad_grid(n, n, Sides::Free));
    for (v, p) in s.positions.iter_mut().enumerate() {
        let (i, j) = (v as u32 % (n + 1), v as u32 / (n + 1));
        *p = [f64::from(i) + 0.49 * random.real(), f64::from(j) + 0.49 * random.real(), 2.0 * random.real()];
    }
    s
}

fn mapped(s: Surface, options: &MapOptions, what: &str) -> Mapped {
    run(&Input::of(what.to_owned(), s), options, &mut Silent).unwrap_or_else(|error| panic!("{what}: {error}"))
}

fn shows(what: &str, mapped: &Mapped) {
    println!(
        "{what}: {} {} after {}, folded before {:?}, σ1/σ2 {:?}",
        mapped.map.backend,
        mapped.map.outcome.name(),
        mapped.map.iterations,
        mapped.map.plain_folded,
        mapped.distortion.quasi_conformal.map(|e| e.mean)
    );
}

/// Circle maps are one-to-one, free ones near every point.
fn assert_valid(s: &Surface, what: &str) {
    let circle = mapped(s.clone(), &MapOptions::default(), what);
    shows(&format!("{what}, circle"), &circle);
    assert!(circle.validity.is_one_to_one(), "{what}: {:?}", circle.validity);
    assert_eq!(circle.distortion.boundary_out_of_order, Some(0), "{what}");
    let free = mapped(s.clone(), &MapOptions { boundary: Boundary::Free, ..MapOptions::default() }, what);
    shows(&format!("{what}, free"), &free);
    assert!(free.validity.is_locally_one_to_one(), "{what}: {:?}", free.validity);
}

#[test]
fn hard_shapes_have_valid_maps_circle_and_free() {
    let shapes = [
        ("capsule", capsule(24)),
        ("spikes", spikes(16, 20.0)),
        ("comb", comb(8, 12)),
        ("spiral strip", spiral(120)),
        ("staircase", staircase(24, 0.3)),
        ("triangulated staircase", triangulated(&staircase(24, 0.3))),
        ("rough", rough(20, &mut Random(3))),
    ];
    let mut replaced = 0;
    for (what, s) in &shapes {
        assert_valid(s, what);
        replaced += usize::from(mapped(s.clone(), &MapOptions::default(), what).map.repaired);
    }
    assert!(replaced >= 3, "hard shapes that are not hard: {replaced} replaced");
}

#[test]
fn a_plain_map_that_is_valid_is_kept_bit_for_bit() {
    for name in ["sphere?n=12&mesh=delaunay", "graph:cos+cos?n=12&mesh=quad", "enneper?n=9&mesh=triangle"] {
        for boundary in [Boundary::Circle, Boundary::Free] {
            let of = |valid| {
                let options = MapOptions { boundary, valid, ..MapOptions::default() };
                run(&Input::open(name).unwrap(), &options, &mut Silent).unwrap().map
            };
            let (plain, kept) = (of(Valid::Off), of(Valid::Auto));
            assert_eq!((plain.z, plain.backend), (kept.z, kept.backend), "{name} {boundary:?}");
            assert!(!kept.repaired && kept.plain_folded.is_none());
        }
    }
}

fn shear(mapped: &Mapped) -> f64 {
    mapped.distortion.quasi_conformal.unwrap().mean
}

/// The harmonic map of cotan weights, the boundary on the circle by arc length, may fold; faces that do are left out of its mean.
#[test]
fn what_takes_the_place_of_a_map_that_folds_has_no_more_shear_than_the_harmonic_map() {
    let shapes =
        [("spikes", spikes(16, 20.0)), ("capsule", capsule(24)), ("spiral strip", spiral(120)), ("comb", comb(8, 12))];
    for (what, s) in shapes {
        let s = if s.faces.arity() == Some(4) { triangulated(&s) } else { s };
        let harmonic =
            MapOptions { boundary: Boundary::Fixed, weights: Some("cotan".to_owned()), ..MapOptions::default() };
        let least = MapOptions { valid: Valid::BestQc, ..MapOptions::default() };
        let [harmonic, ours, least] =
            [harmonic, MapOptions::default(), least].map(|options| mapped(s.clone(), &options, what));
        println!("{what}: {} harmonic, {} ours, {} least", shear(&harmonic), shear(&ours), shear(&least));
        // All vertices of the comb are on the boundary, where double precision leaves them no way to go: there the two are one map.
        let most = (1.0 + 1e-12) * shear(&harmonic);
        assert!(shear(&least) <= most, "{what}");
        assert!(!ours.map.repaired || shear(&ours) <= most, "{what}");
        if ours.map.repaired {
            assert_eq!(ours.map.z, least.map.z, "{what}");
        }
    }
}

#[test]
fn best_qc_takes_the_better_of_the_plain_map_and_the_valid_one() {
    let of = |name: &str, boundary, valid| {
        run(&Input::open(name).unwrap(), &MapOptions { boundary, valid, ..MapOptions::default() }, &mut Silent).unwrap()
    };
    for boundary in [Boundary::Circle, Boundary::Free] {
        // A mesh with obtuse triangles, where barycentres cost shear; a smooth grid of quads, which the plain map fits.
        let obtuse = "capsule?n=17&length=4&mesh=triangle";
        let [plain, least] = [Valid::Auto, Valid::BestQc].map(|valid| of(obtuse, boundary, valid));
        assert!(shear(&least) < 0.99 * shear(&plain), "{boundary:?}: {} {}", shear(&plain), shear(&least));
        // Nothing was amiss.
        assert!(!plain.map.repaired && !least.map.repaired && least.validity.is_one_to_one());
        let [plain, least] = [Valid::Auto, Valid::BestQc].map(|valid| of("enneper?n=12&mesh=quad", boundary, valid));
        assert_eq!((plain.map.z, plain.map.backend), (least.map.z, least.map.backend), "{boundary:?}");
    }
}

/// A flat ring of `turns` turns, slit open and lifted like a ramp: flattened without stretch it lies on itself.
fn ramp(turns: f64, n: u32) -> Surface {
    let mut s = quad_grid(n, 3, Sides::Free);
    for (v, p) in s.positions.iter_mut().enumerate() {
        let (i, j) = (v as u32 % (n + 1), v as u32 / (n + 1));
        let (angle, radius) = (turns * TAU * f64::from(i) / f64::from(n), 1.5 - f64::from(j) / 6.0);
        *p = [radius * angle.cos(), radius * angle.sin(), 0.05 * angle];
    }
    s
}

#[test]
fn free_maps_that_overlap_are_replaced_by_maps_that_do_not_where_that_is_asked_for() {
    let free = |s: &Surface, valid| {
        mapped(s.clone(), &MapOptions { boundary: Boundary::Free, valid, ..MapOptions::default() }, "free")
    };
    let shapes = [
        ("ramp of quads", ramp(1.3, 60)),
        ("ramp of triangles", triangulated(&ramp(1.3, 60))),
        ("ramp, two turns", triangulated(&ramp(2.0, 90))),
        ("spikes", spikes(16, 20.0)),
    ];
    let mut kept = 0;
    for (what, s) in &shapes {
        let (may, must_not) = (free(s, Valid::Auto), free(s, Valid::OneToOne));
        shows(what, &must_not);
        assert!(must_not.validity.is_one_to_one(), "{what}: {:?}", must_not.validity);
        // What is one-to-one already stays.
        let same = may.map.z == must_not.map.z;
        assert_eq!(same, may.validity.is_one_to_one(), "{what}");
        assert_eq!(must_not.map.repaired, !same || may.map.repaired, "{what}");
        kept += usize::from(same);
    }
    assert!(kept < shapes.len() - 1, "shapes that do not overlap: {kept}");
}

#[test]
fn circle_maps_that_must_not_overlap_are_the_default_ones() {
    let s = rough(12, &mut Random(5));
    let circle = |valid| mapped(s.clone(), &MapOptions { valid, ..MapOptions::default() }, "rough").map.z;
    assert_eq!(circle(Valid::Auto), circle(Valid::OneToOne));
}

/// Asks for a stop after this many iterations in all.
struct Stopper(usize);

impl Observer for Stopper {
    fn phase(&mut self, _phase: Phase) {}

    fn iteration(&mut self, _iteration: &Iteration) {
        self.0 = self.0.saturating_sub(1);
    }

    fn stop_requested(&self) -> bool {
        self.0 == 0
    }
}

#[test]
fn a_map_that_is_interrupted_or_cut_short_is_valid_at_any_time() {
    let s = rough(14, &mut Random(7));
    for boundary in [Boundary::Circle, Boundary::Free] {
        for n in [0, 1, 2, 5, 9, 14, 20, 30] {
            let options = MapOptions { boundary, ..MapOptions::default() };
            let stopped = run(&Input::of("rough".to_owned(), s.clone()), &options, &mut Stopper(n)).unwrap();
            assert!(stopped.validity.is_locally_one_to_one(), "{boundary:?} stopped after {n}");
            let limited_options = MapOptions { max_iterations: Some(n), ..options };
            let limited = mapped(s.clone(), &limited_options, "rough");
            assert!(limited.validity.is_locally_one_to_one(), "{boundary:?} limited to {n}");
            assert!(limited.map.iterations <= n, "{} of {n}", limited.map.iterations);
            let apart = MapOptions { valid: Valid::OneToOne, ..limited_options.clone() };
            assert!(mapped(s.clone(), &apart, "rough").validity.is_one_to_one(), "{boundary:?} limited to {n}");
            if n < 5 {
                assert_eq!(limited.map.outcome, Outcome::Minimised(Status::MaxIterations));
            }
        }
    }
}

#[test]
fn the_smallest_discs_are_mapped() {
    let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.1], [1.2, 1.0, 0.0], [0.0, 0.7, 0.0]];
    let one = surface(corners[..3].to_vec(), [[0, 1, 2]]);
    let two = surface(corners.clone(), [[0, 1, 2], [0, 2, 3]]);
    let quad = surface(corners, [[0, 1, 2, 3]]);
    for (what, s) in [("one triangle", one), ("two triangles", two), ("one quad", quad)] {
        assert_valid(&s, what);
    }
}

/// A grid or a disc grown face by face, its vertices anywhere, at sizes over six decades: triangles of every badness.
fn terrible(seed: u64, size: usize, grown: bool) -> Surface {
    let mut random = Random(seed);
    let mut s = match grown {
        true => grown_disc(3, size, &mut random),
        false => triangulated(&quad_grid(2 + (size as u32) % 13, 2 + (size as u32) / 13, Sides::Free)),
    };
    for p in &mut s.positions {
        let scale = 10f64.powf(3.0 * random.real());
        *p = random.vector().map(|x| scale * x);
    }
    s
}

proptest! {
    #![proptest_config(ProptestConfig {
        failure_persistence: None,
        cases: 24,
        rng_seed: RngSeed::Fixed(7),
        ..ProptestConfig::default()
    })]

    #[test]
    fn random_discs_of_terrible_triangles_never_fold(seed in any::<u64>(), size in 4usize..400, grown in any::<bool>()) {
        let (s, what) = (terrible(seed, size, grown), format!("seed {seed}, size {size}, grown {grown}"));
        let circle = mapped(s.clone(), &MapOptions { max_iterations: Some(60), ..MapOptions::default() }, &what);
        prop_assert!(circle.validity.is_one_to_one(), "{what}: {:?}", circle.validity);
        let options = MapOptions { boundary: Boundary::Free, max_iterations: Some(60), ..MapOptions::default() };
        let free = mapped(s, &options, &what);
        prop_assert!(free.validity.is_locally_one_to_one(), "{what}: {:?}", free.validity);
    }
}

#[test]
fn a_random_disc_of_ten_thousand_faces_does_not_fold() {
    assert_valid(&rough(70, &mut Random(11)), "rough, 9800 faces");
}

#[test]
fn every_public_disc_has_a_valid_map() {
    let Some(folder) = data_folder() else {
        println!("skipped: no public meshes in $RIEMAP_DATA, ../shared/data or data");
        return;
    };
    for file in ["bff-face.obj", "bunny_cut.obj", "camelhead.off", "cat_head.obj", "maze.obj", "three_peaks.off"] {
        let path = folder.join("tri").join(file);
        for boundary in [Boundary::Circle, Boundary::Free] {
            // As far as it comes: long parts converge slowly, and are valid on the way.
            let options = MapOptions { boundary, max_iterations: Some(100), ..MapOptions::default() };
            let mapped = run(&Input::open(path.to_str().unwrap()).unwrap(), &options, &mut Silent).unwrap();
            shows(&format!("{file} {boundary:?}"), &mapped);
            assert!(mapped.validity.is_locally_one_to_one(), "{file} {boundary:?}");
            assert!(boundary == Boundary::Free || mapped.validity.is_one_to_one(), "{file}");
        }
    }
    let quads = folder.join("quad").join("inspired_mesh_quads_Smooth.off");
    let s = riemap::io::read(&quads).unwrap().surface;
    assert_valid(&s, "inspired_mesh_quads_Smooth.off");
}

#[test]
fn a_free_map_that_is_stopped_on_its_way_past_itself_does_not_overlap() {
    let s = triangulated(&ramp(1.3, 40));
    for n in [0, 1, 5, 10, 20, 40, 60, 80, 120] {
        let options = MapOptions { boundary: Boundary::Free, valid: Valid::OneToOne, ..MapOptions::default() };
        let stopped = run(&Input::of("ramp".to_owned(), s.clone()), &options, &mut Stopper(n)).unwrap();
        assert!(stopped.validity.is_one_to_one(), "stopped after {n}");
    }
}

/// The lower half of the unit sphere as the image of the disc under the inverse of stereographic projection, with the points of the disc: a
/// grid of n × n cells whose inner vertices are moved anywhere that leaves all triangles positive, however thin.
fn cap(n: u32, random: &mut Random) -> Input {
    let mut grid = triangulated(&quad_grid(n, n, Sides::Free));
    let mut st: Vec<[f64; 2]> = (0..(n + 1) * (n + 1)).map(|v| [v % (n + 1), v / (n + 1)].map(f64::from)).collect();
    let faces: Vec<Vec<usize>> = grid.faces.iter().map(|f| f.iter().map(|&v| v as usize).collect()).collect();
    let area = |st: &[[f64; 2]], f: &[usize]| {
        let [a, b, c] = [st[f[0]], st[f[1]], st[f[2]]];
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    let last = f64::from(n);
    let mut around = vec![Vec::new(); st.len()];
    faces.iter().for_each(|f| f.iter().for_each(|&v| around[v].push(f)));
    let inner: Vec<usize> = (0..st.len()).filter(|&v| st[v].iter().all(|&x| x > 0.0 && x < last)).collect();
    for &v in inner.iter().cycle().take(8 * inner.len()) {
        let old = st[v];
        st[v] = old.map(|x| x + random.real());
        if around[v].iter().any(|f| area(&st, f) < 1e-3) {
            st[v] = old;
        }
    }
    let on_disc = |[s, t]: [f64; 2]| {
        let (s, t) = (2.0 * s / last - 1.0, 2.0 * t / last - 1.0);
        [s * (1.0 - 0.5 * t * t).sqrt(), t * (1.0 - 0.5 * s * s).sqrt()]
    };
    let w: Vec<[f64; 2]> = st.into_iter().map(on_disc).collect();
    grid.positions = w
        .iter()
        .map(|&[x, y]| {
            let r = x * x + y * y;
            [2.0 * x / (1.0 + r), 2.0 * y / (1.0 + r), (r - 1.0) / (1.0 + r)]
        })
        .collect();
    Input { exact: Some(w), ..Input::of(format!("cap, n = {n}"), grid) }
}

#[test]
fn maps_that_replace_folded_ones_have_the_three_points_and_converge_to_the_exact_map() {
    let mut random = Random(41);
    let error = |n: u32, random: &mut Random| {
        let input = cap(n, random);
        let mapped = run(&input, &MapOptions::default(), &mut Silent).unwrap();
        shows(&input.source, &mapped);
        assert!(mapped.validity.is_one_to_one() && mapped.map.anchored && mapped.map.fixed.len() == 3);
        let exact = input.exact.as_ref().unwrap();
        let source = &mapped.domain.disc.source_vertex;
        for (v, place) in mapped.map.fixed.iter() {
            let [x, y] = exact[source[v as usize] as usize];
            // The angle is kept, and the place is on the circle to rounding.
            assert!(mapped.map.z[v as usize] == place && (place.re - x).hypot(place.im - y) < 1e-15);
        }
        let squares = source.iter().zip(&mapped.map.z).map(|(&v, z)| {
            let [x, y] = exact[v as usize];
            (z.re - x).powi(2) + (z.im - y).powi(2)
        });
        let rms = (squares.sum::<f64>() / source.len() as f64).sqrt();
        println!("n = {n}: rms {rms:.2e}, repaired {}", mapped.map.repaired);
        (rms, mapped.map.repaired)
    };
    let errors = [16, 32, 64].map(|n| error(n, &mut random));
    // Thin triangles fold the plain maps.
    assert!(errors.iter().all(|(_, repaired)| *repaired), "{errors:?}");
    // First order at least.
    assert!(errors[2].0 < 0.25 * errors[0].0, "{errors:?}");
}

#[test]
fn where_three_points_are_too_much_for_doubles_one_is_held() {
    let spiral = Input::open("spiral?rounds=6&n=2&mesh=triangle").unwrap();
    let map = run(&spiral, &MapOptions::default(), &mut Silent).unwrap();
    assert!(map.validity.is_one_to_one() && map.map.repaired);
    assert_eq!(map.map.fixed.len(), 1);
}

#[test]
fn two_points_are_met_too_where_two_are_asked_for() {
    let s = rough(20, &mut Random(3));
    for (fix, valid) in [(2, Valid::Auto), (3, Valid::Auto), (2, Valid::BestQc), (3, Valid::BestQc)] {
        let of = |valid| mapped(s.clone(), &MapOptions { fix, valid, ..MapOptions::default() }, "rough");
        let (plain, repaired) = (of(Valid::Off), of(valid));
        assert!(repaired.map.repaired && repaired.validity.is_one_to_one());
        assert_eq!(repaired.map.fixed, plain.map.fixed, "{fix} {valid:?}");
        for (v, place) in plain.map.fixed.iter() {
            assert_eq!(repaired.map.z[v as usize], place, "{fix} {valid:?}");
        }
    }
}
