//! Hard shapes by construction, their maps, and what must hold of these.

use std::f64::consts::TAU;

use riemap::input::Input;
use riemap::map::{Boundary, MapOptions, Mapped, map_input};
use riemap::solver::Silent;
use riemap::surface::Surface;

use crate::common::*;

/// A quarter of a turn around a tube of this many sides, `rings` times; the first ring is the boundary.
pub fn tube(sides: u32, rings: u32, height: f64) -> (Vec<[f64; 3]>, Vec<[u32; 4]>) {
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
pub fn capsule(length: u32) -> Surface {
    let sides = 12;
    let (mut positions, quads) = tube(sides, length, 0.5);
    let tip = positions.len() as u32;
    positions.push([0.0, 0.0, 0.5 * f64::from(length) + 0.3]);
    let walls = quads.iter().flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]);
    let fan = (0..sides).map(|i| [length * sides + i, length * sides + (i + 1) % sides, tip]);
    surface(positions, walls.chain(fan).map(|f| f.to_vec()))
}

/// A square with spikes drawn out of it, `height` times as high as a cell is wide.
pub fn spikes(n: u32, height: f64) -> Surface {
    let mut grid = triangulated(&quad_grid(n, n, Sides::Free));
    for v in 0..(n + 1) * (n + 1) {
        let (i, j) = (v % (n + 1), v / (n + 1));
        let spike = if i % 4 == 2 && j % 4 == 2 { height } else { 0.0 };
        grid.positions_mut()[v as usize] = [f64::from(i), f64::from(j), spike];
    }
    grid
}

/// Teeth of a comb: strips `length` cells long and one wide on a common back, `teeth` of them.
pub fn comb(teeth: u32, length: u32) -> Surface {
    let grid = quad_grid(2 * teeth - 1, length + 1, Sides::Free);
    let across = 2 * teeth;
    let mut s = grid;
    for (v, p) in s.positions_mut().iter_mut().enumerate() {
        *p = [f64::from(v as u32 % across), f64::from(v as u32 / across), 0.0];
    }
    let kept = filtered(&s, |f| (f as u32) / (2 * teeth - 1) == 0 || ((f as u32) % (2 * teeth - 1)).is_multiple_of(2));
    triangulated(&kept)
}

/// A strip `n` cells long that is wound up in the plane, one cell wide.
pub fn spiral(n: u32) -> Surface {
    let mut s = quad_grid(n, 1, Sides::Free);
    for (v, p) in s.positions_mut().iter_mut().enumerate() {
        let (i, j) = (v as u32 % (n + 1), v as u32 / (n + 1));
        let angle = 0.15 * f64::from(i);
        let radius = 5.0 + 0.3 * angle - 0.8 * f64::from(j);
        *p = [radius * angle.cos(), radius * angle.sin(), 0.0];
    }
    // The inner side has the larger j here: seen from above the faces turn right.
    let all = 0..s.faces().len();
    triangulated(&flipped(&s, all))
}

/// The cells of a grid over a disc, its boundary a staircase.
pub fn staircase(n: u32, bump: f64) -> Surface {
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
    surface(positions.collect(), grid.faces().iter().filter(|face| inside(face)))
}

/// A flat grid of triangles whose vertices are anywhere within their cells, and heights to match.
pub fn rough(n: u32, random: &mut Random) -> Surface {
    let mut s = triangulated(&quad_grid(n, n, Sides::Free));
    for (v, p) in s.positions_mut().iter_mut().enumerate() {
        let (i, j) = (v as u32 % (n + 1), v as u32 / (n + 1));
        *p = [f64::from(i) + 0.49 * random.real(), f64::from(j) + 0.49 * random.real(), 2.0 * random.real()];
    }
    s
}

pub fn mapped(s: Surface, options: &MapOptions, what: &str) -> Mapped {
    map_input(&Input::of(what.to_owned(), s), options, &mut Silent).unwrap_or_else(|error| panic!("{what}: {error}"))
}

pub fn shows(what: &str, mapped: &Mapped) {
    println!(
        "{what}: {} {} after {}, folded before {:?}, σ1/σ2 {:?}",
        mapped.map.provenance,
        mapped.map.ending.name(),
        mapped.map.iterations,
        mapped.map.provenance.flipped(),
        mapped.distortion.quasi_conformal.map(|e| e.mean)
    );
}

/// Circle maps are one-to-one, free ones near every point.
pub fn assert_valid(s: &Surface, what: &str) {
    let circle = mapped(s.clone(), &MapOptions::default(), what);
    shows(&format!("{what}, circle"), &circle);
    assert!(circle.validity.is_one_to_one(), "{what}: {:?}", circle.validity);
    assert_eq!(circle.distortion.boundary_out_of_order, Some(0), "{what}");
    let free = mapped(s.clone(), &MapOptions { boundary: Boundary::FREE, ..MapOptions::default() }, what);
    shows(&format!("{what}, free"), &free);
    assert!(free.validity.is_locally_one_to_one(), "{what}: {:?}", free.validity);
}
