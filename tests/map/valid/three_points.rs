//! The points that the plain circle map holds, in the map that takes its place.

use riemap::input::Input;
use riemap::map::{Boundary, MapOptions, PinnedPoints, Valid, map_input};
use riemap::solver::Silent;

use super::shapes::*;
use crate::common::*;

/// The lower half of the unit sphere as the image of the disc under the inverse of stereographic projection, with the points of the disc: a
/// grid of n × n cells whose inner vertices are moved anywhere that leaves all triangles positive, however thin.
fn cap(n: u32, random: &mut Random) -> Input {
    let mut grid = triangulated(&quad_grid(n, n, Sides::Free));
    let mut st: Vec<[f64; 2]> = (0..(n + 1) * (n + 1)).map(|v| [v % (n + 1), v / (n + 1)].map(f64::from)).collect();
    let faces: Vec<Vec<usize>> = grid.faces().iter().map(|f| f.iter().map(|&v| v as usize).collect()).collect();
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
    for (p, &[x, y]) in grid.positions_mut().iter_mut().zip(&w) {
        let r = x * x + y * y;
        *p = [2.0 * x / (1.0 + r), 2.0 * y / (1.0 + r), (r - 1.0) / (1.0 + r)];
    }
    Input { exact: Some(w), ..Input::of(format!("cap, n = {n}"), grid) }
}

#[test]
fn maps_that_replace_folded_ones_have_the_three_points_and_converge_to_the_exact_map() {
    let mut random = Random(41);
    let error = |n: u32, random: &mut Random| {
        let input = cap(n, random);
        let mapped = map_input(&input, &MapOptions::default(), &mut Silent).unwrap();
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
        println!("n = {n}: rms {rms:.2e}, repaired {}", mapped.map.provenance.is_repaired());
        (rms, mapped.map.provenance.is_repaired())
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
    let map = map_input(&spiral, &MapOptions::default(), &mut Silent).unwrap();
    assert!(map.validity.is_one_to_one() && map.map.provenance.is_repaired());
    assert_eq!(map.map.fixed.len(), 1);
}

#[test]
fn two_points_are_met_too_where_two_are_asked_for() {
    let s = rough(20, &mut Random(3));
    use PinnedPoints::{Three, Two};
    for (pinned, valid) in [(Two, Valid::Auto), (Three, Valid::Auto), (Two, Valid::BestQc), (Three, Valid::BestQc)] {
        let boundary = Boundary::Circle { pinned, ordered: false };
        let of = |valid| {
            mapped(s.clone(), &MapOptions { boundary: boundary.clone(), valid, ..MapOptions::default() }, "rough")
        };
        let (plain, repaired) = (of(Valid::Off), of(valid));
        assert!(repaired.map.provenance.is_repaired() && repaired.validity.is_one_to_one());
        assert_eq!(plain.map.fixed.len(), if pinned == Two { 2 } else { 3 });
        for (v, place) in plain.map.fixed.iter() {
            assert!((repaired.map.z[v as usize] - place).norm() < 1e-12, "{pinned:?} {valid:?}");
        }
    }
}
