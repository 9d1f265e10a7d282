//! Boundaries of sets of voxels: whatever the voxels, they are oriented closed manifolds.

use std::collections::{BTreeMap, HashMap};
use std::path::Path;

use crate::common::{cross, data_folder, dot, sub};
use proptest::prelude::*;
use riemap::io::{VolumeOptions, read_volume};
use riemap::surface::Surface;
use riemap::surface::digital::{Adjacency, Digital, DigitalError, Solid, boundary};
use riemap::surface::topology::Topology;

const BOTH: [Adjacency; 2] = [Adjacency::Six, Adjacency::Eighteen];

fn solid(size: [usize; 3], inside: impl Fn([i32; 3]) -> bool) -> Solid {
    let mut solid = Solid::empty(size, [0.0; 3]);
    for k in 0..size[2] as i32 {
        for j in 0..size[1] as i32 {
            for i in 0..size[0] as i32 {
                if inside([i, j, k]) {
                    solid.insert([i, j, k]);
                }
            }
        }
    }
    solid
}

fn of(voxels: &[[i32; 3]]) -> Solid {
    let mut solid = Solid::empty([4; 3], [0.0; 3]);
    voxels.iter().for_each(|&v| solid.insert(v));
    solid
}

fn steps() -> impl Iterator<Item = (u8, bool, [i32; 3])> {
    (0..6).map(|d: u8| {
        let mut step = [0; 3];
        step[usize::from(d / 2)] = if d % 2 == 1 { 1 } else { -1 };
        (d / 2, d % 2 == 1, step)
    })
}

fn plus(a: [i32; 3], b: [i32; 3]) -> [i32; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// All components, largest first.
fn all(solid: &Solid, adjacency: Adjacency) -> Vec<(Surface, Digital)> {
    let first = boundary(solid.clone(), adjacency, 0).expect("a boundary");
    let count = first.1.components.len();
    std::iter::once(first)
        .chain((1..count).map(|c| boundary(solid.clone(), adjacency, c).expect("a component")))
        .collect()
}

/// What every component promises; its Euler number.
fn check(surface: &Surface, digital: &Digital) -> Result<i64, TestCaseError> {
    let topology = Topology::new(surface);
    prop_assert_eq!(topology.components.len(), 1);
    let part = &topology.components[0];
    prop_assert!(part.manifold && part.orientable && part.boundary_loops.is_empty(), "{:?}", part);
    prop_assert!(topology.orientation.flip.iter().all(|&flip| !flip));
    prop_assert!(topology.fans.iter().all(|&fans| fans == 1));
    prop_assert_eq!(surface.faces().len(), digital.surfels.len());
    prop_assert_eq!(surface.faces().len(), digital.components[digital.component]);
    let euler = part.euler();
    prop_assert!(euler % 2 == 0 && euler <= 2, "Euler number {}", euler);
    for (f, (quad, surfel)) in surface.faces().iter().zip(&digital.surfels).enumerate() {
        // a unit square where it should be, counter-clockwise from outside
        let p: Vec<[f64; 3]> = quad.iter().map(|&v| surface.positions()[v as usize]).collect();
        for k in 0..4 {
            let normal = cross(sub(p[(k + 1) % 4], p[k]), sub(p[(k + 2) % 4], p[(k + 1) % 4]));
            prop_assert_eq!(normal, surfel.normal(), "surfel {}", f);
        }
        let middle = [0, 1, 2].map(|i| 0.25 * p.iter().map(|p| p[i]).sum::<f64>());
        prop_assert_eq!(middle, surfel.centre(&digital.solid));
        prop_assert!(digital.solid.contains(surfel.voxel));
        let outer = plus(surfel.voxel, surfel.normal().map(|x| x as i32));
        prop_assert!(!digital.solid.contains(outer));
    }
    Ok(euler)
}

/// Voxels of a box with one layer around the solid, and the component of each, inner ones by `inner`, outer ones by `outer`
/// adjacency (the number of coordinates that may differ by 1).
fn labels(solid: &Solid, inner: i32, outer: i32) -> HashMap<[i32; 3], usize> {
    let [a, b, c] = solid.size().map(|n| n as i32);
    let in_box = |v: [i32; 3]| (-1..=a).contains(&v[0]) && (-1..=b).contains(&v[1]) && (-1..=c).contains(&v[2]);
    let mut label = HashMap::new();
    let mut next = 0;
    for seed in (-1..=c).flat_map(|k| (-1..=b).flat_map(move |j| (-1..=a).map(move |i| [i, j, k]))) {
        if label.contains_key(&seed) {
            continue;
        }
        let inside = solid.contains(seed);
        let reach = if inside { inner } else { outer };
        let mut stack = vec![seed];
        label.insert(seed, next);
        while let Some(v) = stack.pop() {
            for n in 0..27 {
                let step = [n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1];
                let (w, moved) = (plus(v, step), step.iter().map(|s| s.abs()).sum::<i32>());
                if moved <= reach && in_box(w) && solid.contains(w) == inside && !label.contains_key(&w) {
                    label.insert(w, next);
                    stack.push(w);
                }
            }
        }
        next += 1;
    }
    label
}

/// Surfels between every pair of an inner and an outer component.
fn between(solid: &Solid, adjacency: Adjacency) -> Vec<usize> {
    let (inner, outer) = if adjacency == Adjacency::Six { (1, 2) } else { (2, 1) };
    let label = labels(solid, inner, outer);
    let mut count = BTreeMap::new();
    for v in solid.voxels() {
        for (_, _, step) in steps() {
            let w = plus(v, step);
            if !solid.contains(w) {
                *count.entry((label[&v], label[&w])).or_insert(0) += 1;
            }
        }
    }
    let mut sizes: Vec<usize> = count.into_values().collect();
    sizes.sort_unstable_by(|a, b| b.cmp(a));
    sizes
}

#[test]
fn one_voxel_is_a_cube_seen_from_outside() {
    for adjacency in BOTH {
        let (surface, digital) = boundary(of(&[[1, 2, 3]]), adjacency, 0).expect("a boundary");
        assert_eq!((surface.positions().len(), surface.faces().len()), (8, 6));
        assert_eq!(check(&surface, &digital).unwrap(), 2);
        assert!(surface.positions().iter().all(|p| sub(*p, [1.0, 2.0, 3.0]).iter().all(|x| x.abs() == 0.5)));
    }
}

#[test]
fn voxels_that_share_an_edge_are_joined_by_eighteen_alone() {
    let sizes = |voxels: &[[i32; 3]], adjacency| boundary(of(voxels), adjacency, 0).unwrap().1.components;
    let edge = [[1, 1, 1], [2, 2, 1]];
    assert_eq!(sizes(&edge, Adjacency::Six), [6, 6]);
    assert_eq!(sizes(&edge, Adjacency::Eighteen), [12]);
    let vertex = [[1, 1, 1], [2, 2, 2]];
    let face = [[1, 1, 1], [2, 1, 1]];
    for adjacency in BOTH {
        assert_eq!(sizes(&vertex, adjacency), [6, 6]);
        assert_eq!(sizes(&face, adjacency), [10]);
    }
}

#[test]
fn cavities_are_components_that_look_into_themselves() {
    let shell = solid([5; 3], |v| v.iter().all(|x| (0..5).contains(x)) && v != [2, 2, 2] && v != [1, 1, 1]);
    for (adjacency, sizes) in [(Adjacency::Six, vec![150, 6, 6]), (Adjacency::Eighteen, vec![150, 6, 6])] {
        let parts = all(&shell, adjacency);
        assert_eq!(parts[0].1.components, sizes);
        // signed volume: that of the outer boundary, or minus that of the cavity
        for ((surface, digital), volume) in parts.iter().zip([125.0, -1.0, -1.0]) {
            check(surface, digital).unwrap();
            let of_face = |quad: &[u32]| {
                let p = [0, 1, 2, 3].map(|k| surface.positions()[quad[k] as usize]);
                (dot(p[0], cross(p[1], p[2])) + dot(p[0], cross(p[2], p[3]))) / 6.0
            };
            assert!((surface.faces().iter().map(of_face).sum::<f64>() - volume).abs() < 1e-9);
        }
    }
}

/// Two outer voxels that share an edge, all around them inside: both fans at either end of the edge are one, so the edge is
/// there twice with the same ends.
#[test]
fn two_edges_with_the_same_ends_are_told_apart() {
    let touching = solid([4, 4, 3], |v| v != [1, 1, 1] && v != [2, 2, 1]);
    let mut stated = Vec::new();
    for adjacency in BOTH {
        for (surface, digital) in all(&touching, adjacency) {
            check(&surface, &digital).unwrap();
            stated.push((digital.surfels.len(), surface.faces().twins().is_some()));
        }
    }
    // Six joins the two cavities; Eighteen keeps them apart, and nothing is ambiguous then
    assert_eq!(stated, [(80, false), (12, true), (80, false), (6, false), (6, false)]);
}

#[test]
fn what_cannot_be_is_said_with_its_numbers() {
    let empty = Solid::empty([3, 4, 5], [0.0; 3]);
    assert_eq!(boundary(empty, Adjacency::Six, 0).unwrap_err(), DigitalError::Empty { size: [3, 4, 5] });
    let error = boundary(of(&[[0; 3], [2; 3]]), Adjacency::Six, 2).unwrap_err();
    assert!(
        error.to_string().contains("no component 2: the boundary has 2, counted from 0, of 6, 6 surfels"),
        "{error}"
    );
}

/// (file, voxels, adjacency, (surfels, Euler number) of the largest components): reached by another program, by labelling
/// inner and outer voxels and counting, at every pointel, the components of its eight voxels.
#[test]
fn boundaries_of_public_volumes_have_the_counts_of_an_independent_program() {
    let Some(folder) = data_folder() else {
        eprintln!("no public data: nothing is compared");
        return;
    };
    for (file, voxels, six, eighteen) in PUBLIC {
        let path = folder.join("digital").join(file);
        if !Path::new(&path).is_file() {
            eprintln!("{file} is not there: nothing is compared");
            continue;
        }
        let solid = read_volume(&path, &VolumeOptions::default()).unwrap();
        assert_eq!(solid.len(), voxels, "{file}");
        for (adjacency, expected) in BOTH.into_iter().zip([six, eighteen]) {
            let found: Vec<(usize, i64)> =
                all(&solid, adjacency).iter().map(|(s, d)| (d.surfels.len(), check(s, d).unwrap())).collect();
            assert_eq!(found, expected, "{file} {adjacency:?}");
        }
    }
}

type Parts = &'static [(usize, i64)];
const PUBLIC: [(&str, usize, Parts, Parts); 3] = [
    ("Al.100.vol", 70413, &[(21556, -2)], &[(21556, 2)]),
    ("bunny-64.vol", 47705, &[(13236, 2)], &[(13236, 2)]),
    ("cat10.vol", 8043, &[(3966, 2)], &[(3966, 2)]),
];

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 200, ..ProptestConfig::default() })]

    #[test]
    fn boundaries_of_random_voxels_are_closed_oriented_manifolds(
        size in [1_usize..9, 1_usize..7, 1_usize..7],
        wide: bool,
        density in prop::sample::select(vec![0.1, 0.3, 0.5, 0.7, 0.9, 0.97]),
        seed: u64,
    ) {
        // rows of more than one word too
        let size = if wide { [size[0] + 60, size[1], size[2]] } else { size };
        let mut state = seed;
        let solid = solid(size, |_| true);
        let mut noise = Solid::empty(size, [0.5, -2.0, 3.0]);
        for v in solid.voxels() {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            if ((state >> 33) as f64) < density * (1_u64 << 31) as f64 {
                noise.insert(v);
            }
        }
        prop_assume!(!noise.is_empty());
        for adjacency in BOTH {
            let parts = all(&noise, adjacency);
            let pairs: usize = noise.voxels().map(|v| steps().filter(|s| !noise.contains(plus(v, s.2))).count()).sum();
            prop_assert_eq!(parts[0].1.components.iter().sum::<usize>(), pairs);
            // a boundary separates one inner from one outer component (Herman; Udupa: of 6 and 18, or 18 and 6)
            prop_assert_eq!(&parts[0].1.components, &between(&noise, adjacency));
            for (surface, digital) in &parts {
                check(surface, digital)?;
            }
        }
    }

    #[test]
    fn boundaries_of_checkerboards_are_manifolds(size in [1_usize..7, 1_usize..7, 1_usize..7], kind in 0..4, odd in 0..2) {
        let board = solid(size, |[i, j, k]| match kind {
            0 => (i + j + k) % 2 == odd,
            1 => (i + j) % 2 == odd,
            2 => i % 2 == odd || (j + k) % 2 == 0,
            _ => (i / 2 + j / 2 + k / 2) % 2 == odd,
        });
        prop_assume!(!board.is_empty());
        for adjacency in BOTH {
            let parts = all(&board, adjacency);
            prop_assert_eq!(&parts[0].1.components, &between(&board, adjacency));
            for (surface, digital) in &parts {
                check(surface, digital)?;
            }
        }
    }
}
