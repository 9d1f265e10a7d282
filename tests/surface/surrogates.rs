//! Faces without area: refused by name, or mapped by a shape of their own.

use crate::common::*;
use riemap::constraint::ConstraintError;
use riemap::input::Input;
use riemap::map::{Boundary, MapError, MapOptions, Mapped, map_input};
use riemap::report::{Cost, Report};
use riemap::solver::Silent;
use riemap::surface::topology::diagnosis::Severity;
use riemap::surface::{Surface, Surrogates};

/// A bumpy square of n × n cells.
fn bumpy(n: u32, quads: bool) -> Surface {
    let mut grid = quad_grid(n, n, Sides::Free);
    for (v, p) in grid.positions_mut().iter_mut().enumerate() {
        let (x, y) = (f64::from(v as u32 % (n + 1)), f64::from(v as u32 / (n + 1)));
        *p = [x, y, 0.3 * (0.5 * x).sin() * (0.4 * y).cos()];
    }
    if quads { grid } else { triangulated(&grid) }
}

/// The square with the vertices of some cells moved onto those of others: (i, j) to `onto(i, j)`.
fn collapsed(n: u32, quads: bool, onto: impl Fn(u32, u32) -> (u32, u32)) -> Surface {
    let mut s = bumpy(n, quads);
    let whole = s.positions().to_vec();
    for (v, p) in s.positions_mut().iter_mut().enumerate() {
        let (i, j) = onto(v as u32 % (n + 1), v as u32 / (n + 1));
        *p = whole[(j * (n + 1) + i) as usize];
    }
    s
}

/// The square cut in two, the halves joined again by cells of this width.
fn joined(n: u32, quads: bool, width: f64) -> Surface {
    let mut s = bumpy(n, quads);
    let middle = f64::from(n / 2);
    for p in s.positions_mut() {
        let x = p[0];
        *p = [if x <= middle { x - middle } else { x - middle - 1.0 + width }, p[1], 0.0];
    }
    s
}

/// Surfaces with faces without area, and what became of them.
fn flat_faces(quads: bool) -> Vec<(&'static str, Surface)> {
    let n = 10;
    vec![
        ("a strip", collapsed(n, quads, |i, j| (if i == 6 { 5 } else { i }, j))),
        ("two strips", collapsed(n, quads, |i, j| (if i == 6 { 5 } else { i }, if j == 4 { 3 } else { j }))),
        ("a strip along the boundary", collapsed(n, quads, |i, j| (i.max(1), j))),
        (
            "edges here and there",
            collapsed(n, quads, |i, j| (if (i * 7 + j * 5) % 11 == 0 { i.max(1) - 1 } else { i }, j)),
        ),
        ("a block in one point", {
            let inside = |k: u32| (3..7).contains(&k);
            collapsed(n, quads, move |i, j| if inside(i) && inside(j) { (5, 5) } else { (i, j) })
        }),
        (
            "a corner of the boundary in one point",
            collapsed(n, quads, |i, j| if i < 3 && j < 3 { (0, 0) } else { (i, j) }),
        ),
        ("all but one corner in a line", collapsed(4, quads, |i, j| if (i, j) == (0, 4) { (0, 4) } else { (i, 0) })),
        ("all in one point", collapsed(2, quads, |_, _| (0, 0))),
        ("faces as wide as 1e-200", joined(n, quads, 1e-200)),
        ("faces of an area that is a denormal number", joined(n, quads, 1e-320)),
        ("faces as wide as the rounding of their length", joined(n, quads, 1e-16)),
    ]
}

fn mapped(what: &str, s: &Surface, options: &MapOptions) -> Result<Mapped, MapError> {
    map_input(&Input::of(what.to_owned(), s.clone()), options, &mut Silent)
}

#[test]
fn they_are_refused_and_mapped_on_request() {
    for (quads, (what, s)) in
        [false, true].into_iter().flat_map(|quads| flat_faces(quads).into_iter().map(move |c| (quads, c)))
    {
        for boundary in [Boundary::CIRCLE, Boundary::FREE] {
            let plain = MapOptions { boundary: boundary.clone(), ..MapOptions::default() };
            let what = format!("{what}, {}, {boundary:?}", if quads { "quads" } else { "triangles" });
            // Quads may lack nothing but the length of an edge, which the boundary alone must have.
            match mapped(&what, &s, &plain) {
                Err(MapError::NoDisc(_)) => {}
                Err(MapError::Constraint(ConstraintError::NoArcLength(..))) if quads => {}
                Ok(mapped) if quads => {
                    assert!(mapped.validity.is_locally_one_to_one(), "{what}: {:?}", mapped.validity);
                    continue;
                }
                other => panic!("{what}: {:?}", other.map(|mapped| mapped.validity)),
            }
            for height in [Surrogates::HEIGHT, 1.0, 1e-3] {
                let options = MapOptions { surrogate: Some(height), ..plain.clone() };
                let mapped = mapped(&what, &s, &options).unwrap_or_else(|error| panic!("{what}: {error}"));
                assert!(mapped.validity.is_locally_one_to_one(), "{what}, {height}: {:?}", mapped.validity);
                assert!(boundary.is_free() || mapped.validity.is_one_to_one(), "{what}, {height}");
                assert!(mapped.map.z.iter().all(|z| z.is_finite()), "{what}, {height}");
                let found = mapped.findings.iter().filter(|f| f.severity() == Severity::Repaired).count();
                assert_eq!(found, usize::from(!mapped.domain.disc.surrogates.faces.is_empty()), "{what}");
            }
        }
    }
}

#[test]
fn they_are_counted_in_the_report_and_left_out_of_distortion() {
    let s = collapsed(10, false, |i, j| (if i == 6 { 5 } else { i }, j));
    let options = MapOptions { boundary: Boundary::FREE, surrogate: Some(0.01), ..MapOptions::default() };
    let input = Input::of("strip".to_owned(), s);
    let mapped = map_input(&input, &options, &mut Silent).unwrap();
    let report = Report::new(&input, &mapped, Cost::default());
    let surrogates = report.input.surrogates.unwrap();
    assert_eq!((surrogates.count, surrogates.shape, surrogates.height), (20, "lifted", 0.01));
    assert_eq!((surrogates.faces.len(), surrogates.faces[0]), (10, 10));
    // A nearly developable surface: were the strip counted, there would be faces as flat as 0.01.
    let error = report.distortion.quasi_conformal.unwrap();
    assert!(error.max < 1.02, "{error:?}");
    assert!(report.distortion.length.unwrap().max < 1.05);
    assert_eq!(report.distortion.flipped, 0);
}

/// The strip without width is one of width 0.01: the map must be near to that of the surface without it, and the nearer the less the height.
#[test]
fn the_less_their_height_the_less_they_disturb_the_others() {
    for quads in [false, true] {
        let n = 10;
        let free = MapOptions { boundary: Boundary::FREE, ..MapOptions::default() };
        // The flat strip is as long as the square is high: what it adds to the width of the map is all that it does.
        let s = joined(n, quads, 0.0);
        let width = |height: f64| {
            let options = MapOptions { surrogate: Some(height), ..free.clone() };
            let mapped = mapped("joined", &s, &options).unwrap();
            let z = &mapped.map.z;
            // From the left side to the right one, at half the height.
            let at = |i: u32| z[(n / 2 * (n + 1) + i) as usize];
            (at(n) - at(0)).norm()
        };
        let whole = f64::from(n - 1);
        for height in [0.1, 0.01, 1e-3] {
            let added = width(height) - whole;
            assert!((added - height).abs() < 0.02 * height + 1e-6, "{quads}: {added} for {height}");
        }
    }
}

#[test]
fn what_has_area_is_mapped_bit_for_bit_as_without() {
    for quads in [false, true] {
        let s = bumpy(9, quads);
        for boundary in [Boundary::CIRCLE, Boundary::FREE] {
            let of = |surrogate| {
                mapped("whole", &s, &MapOptions { boundary: boundary.clone(), surrogate, ..MapOptions::default() })
                    .unwrap()
            };
            let (plain, with) = (of(None), of(Some(0.01)));
            assert_eq!(plain.map.z, with.map.z);
            assert_eq!(plain.distortion, with.distortion);
        }
    }
}

#[test]
fn heights_that_are_none_are_refused() {
    let s = bumpy(3, false);
    for height in [0.0, -1.0, 1.5, f64::NAN, f64::INFINITY] {
        let options = MapOptions { surrogate: Some(height), ..MapOptions::default() };
        assert!(matches!(mapped("whole", &s, &options).unwrap_err(), MapError::SurrogateHeight { .. }), "{height}");
    }
}

/// A corner of a quad may have no area where the quad has. Energies of angles do not see it; what takes the place of a map that folds there must.
#[test]
fn quads_with_straight_corners_or_edges_without_length_are_mapped_without_folds() {
    // A square of four quads around a vertex, with vertices more in the middles of two sides.
    let positions =
        vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 2.0, 0.0], [2.0, 2.0, 0.0]];
    let straight = surface(positions, [[0, 1, 2, 3], [0, 3, 5, 4]]);
    let mut pinched = bumpy(6, true);
    pinched.positions_mut()[24] = pinched.positions()[25];
    for (what, s) in [("straight corner", straight), ("edge without length", pinched)] {
        for boundary in [Boundary::CIRCLE, Boundary::FREE] {
            let mapped = mapped(what, &s, &MapOptions { boundary: boundary.clone(), ..MapOptions::default() });
            let mapped = mapped.unwrap_or_else(|error| panic!("{what} {boundary:?}: {error}"));
            assert!(mapped.validity.is_locally_one_to_one(), "{what} {boundary:?}: {:?}", mapped.validity);
        }
    }
}
