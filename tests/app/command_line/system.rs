//! `--system`: system (2) in Matrix Market format.

use super::shell::{Shell, hill, numbers, texture};

type Pair = [f64; 2];

/// A complex matrix as its file lists it, and the held vertices of its comments, all from 0.
struct System {
    rows: usize,
    columns: usize,
    entries: Vec<(usize, usize, Pair)>,
    held: Vec<(usize, Pair)>,
}

fn parse(text: &str) -> System {
    let (head, rest) = text.split_once('\n').unwrap();
    assert_eq!(head, "%%MatrixMarket matrix coordinate complex general");
    let mut lines = rest.lines().filter(|line| !line.starts_with('%'));
    let size: Vec<usize> = lines.next().unwrap().split(' ').map(|n| n.parse().unwrap()).collect();
    let entries: Vec<_> = lines
        .map(|line| {
            let words: Vec<&str> = line.split(' ').collect();
            let index = |k: usize| words[k].parse::<usize>().unwrap() - 1;
            (index(0), index(1), [words[2].parse().unwrap(), words[3].parse().unwrap()])
        })
        .collect();
    assert_eq!(entries.len(), size[2]);
    let head = "% held vertices (column, Re z, Im z):\n";
    let held =
        numbers(text.split_once(head).unwrap().1, "% held ").map(|n| (n[0] as usize - 1, [n[1], n[2]])).collect();
    System { rows: size[0], columns: size[1], entries, held }
}

fn times(a: Pair, b: Pair) -> Pair {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

fn add(a: Pair, b: Pair) -> Pair {
    [a[0] + b[0], a[1] + b[1]]
}

impl System {
    /// max |A z|
    fn residual(&self, z: &[Pair]) -> f64 {
        let mut product = vec![[0.0; 2]; self.rows];
        for &(row, column, a) in &self.entries {
            product[row] = add(product[row], times(a, z[column]));
        }
        product.iter().map(|p| p[0].hypot(p[1])).fold(0.0, f64::max)
    }
}

#[test]
fn it_has_a_row_a_quad_a_column_a_vertex_and_four_entries_a_row() {
    let shell = Shell::new();
    for (quads, rows, columns) in [(true, 25, 36), (false, 85, 36 + 50 + 20)] {
        shell.write("m.obj", hill(6, 1.0, quads));
        shell.done(&["map", "m.obj", "--boundary", "fixed", "--system", "a.mtx"]);
        let system = parse(&shell.read("a.mtx"));
        assert_eq!((system.rows, system.columns, system.entries.len()), (rows, columns, 4 * rows));
        let mut places: Vec<(usize, usize)> = system.entries.iter().map(|&(i, j, _)| (i, j)).collect();
        places.sort_unstable();
        places.dedup();
        assert_eq!(places.len(), 4 * rows);
        assert!(places.iter().all(|&(i, j)| i < rows && j < columns));
        // The whole boundary is held.
        assert_eq!(system.held.len(), if quads { 20 } else { 40 });
        // A constant map is conformal, to the rounding of sums of four terms of size 3.
        assert!(system.residual(&vec![[3.0, -2.0]; columns]) < 1e-14);
    }
}

#[test]
fn the_identity_of_a_flat_quad_mesh_solves_it() {
    let shell = Shell::new();
    shell.done(&["map", "plane?n=8", "--boundary", "fixed", "--system", "a.mtx", "-o", "m.obj"]);
    let z: Vec<Pair> = numbers(&shell.read("m.obj"), "v ").map(|v| [v[0], v[1]]).collect();
    let system = parse(&shell.read("a.mtx"));
    // Sums of four terms of size 1.
    assert!(system.residual(&z) < 1e-14);
    let conjugate: Vec<Pair> = z.iter().map(|z| [z[0], -z[1]]).collect();
    assert!(system.residual(&conjugate) > 0.1, "and its mirror image does not");
}

/// The map of the mesh's vertices together with the one dual vertex that is held determines all dual ones, row by row;
/// the rows that are left, one for every inner vertex, then hold by themselves.
#[test]
fn a_square_system_is_solved_by_the_map_that_is_written() {
    let shell = Shell::new();
    shell.write("m.obj", hill(6, 1.0, false));
    for dual in ["barycentre", "circumcentre", "incentre"] {
        shell.done(&[
            "map",
            "m.obj",
            "--boundary",
            "fixed",
            "--dual",
            dual,
            "--hold",
            "primal",
            "--system",
            "a.mtx",
            "-o",
            "o.obj",
            "--quiet",
        ]);
        let system = parse(&shell.read("a.mtx"));
        let uv = texture(&shell.read("o.obj"));
        assert_eq!(system.held.len(), 20 + 1);
        let mut z: Vec<Option<Pair>> = uv.iter().map(|&z| Some(z)).collect();
        z.resize(system.columns, None);
        for &(v, place) in &system.held {
            assert!(z[v].is_none_or(|z| z == place), "held vertices are where the comments say");
            z[v] = Some(place);
        }
        let mut rows = vec![Vec::new(); system.rows];
        for &(row, column, a) in &system.entries {
            rows[row].push((column, a));
        }
        let mut used = 0;
        while let Some((row, unknown)) = rows.iter().enumerate().find_map(|(r, entries)| {
            let mut missing = entries.iter().filter(|(column, _)| z[*column].is_none());
            let first = missing.next()?;
            missing.next().is_none().then_some((r, *first))
        }) {
            let known = rows[row].iter().filter_map(|&(column, a)| z[column].map(|z| times(a, z)));
            let sum = known.fold([0.0; 2], add);
            // Dual vertices have the coefficients 1 and −1.
            assert_eq!((unknown.1[0].abs(), unknown.1[1]), (1.0, 0.0));
            z[unknown.0] = Some([-sum[0] * unknown.1[0], -sum[1] * unknown.1[0]]);
            used += 1;
        }
        assert_eq!(system.rows - used, 16, "one row is left for every inner vertex");
        let z: Vec<Pair> = z.into_iter().map(Option::unwrap).collect();
        // Rounding of values of size 1, carried along paths of some 20 quads.
        assert!(system.residual(&z) < 1e-12, "{dual}: {}", system.residual(&z));
    }
}
