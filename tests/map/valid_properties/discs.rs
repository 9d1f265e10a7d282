//! Random discs: any topology, any shape of faces.

use std::collections::HashMap;

use crate::common::{Random, Sides, grown_disc, quad_grid, surface, triangulated};
use riemap::surface::Surface;

/// How the faces of a disc hang together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Topology {
    /// A grid of squares.
    Grid,
    /// Grown face by face on its boundary, each new face on one or two of the edges there.
    Grown,
    /// A grid with as many random flips of edges as it has faces: of any valence.
    Flipped,
    /// One triangle with vertices put into random faces: few of high valence, many of three.
    Stacked,
    /// All faces around one vertex.
    Wheel,
}

/// Where the vertices are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// Anywhere in R³, at distances over six decades.
    Terrible,
    /// A flat grid moved about within its cells, then drawn out in one direction, by up to 1e9.
    Drawn,
    /// The same, undrawn, with random vertices next to one of their neighbours: needles of aspects down to 1e-12.
    Needles,
    /// The same with random vertices next to the middle of the edge across a face: caps of aspects down to 1e-12.
    Caps,
    /// The same with random vertices on one of their neighbours, or on the edge across a face: faces without area.
    Collapsed,
}

/// A random disc of about `size` triangles, or of three times as many quads, one in each corner of a triangle.
pub fn random_disc(seed: u64, size: usize, topology: Topology, shape: Shape, quads: bool) -> Surface {
    let mut random = Random(seed);
    let columns = 1 + random.below((size as f64).sqrt() as usize + 1);
    let rows = (size / (2 * columns)).max(1);
    let grid = || triangulated(&quad_grid(columns as u32, rows as u32, Sides::Free));
    let mut disc = match topology {
        Topology::Grid => grid(),
        Topology::Grown => grown_disc(3, size, &mut random),
        Topology::Flipped => flipped_at_random(&grid(), size, &mut random),
        Topology::Stacked => stacked(size, &mut random),
        Topology::Wheel => wheel(size.max(3)),
    };
    place(&mut disc, columns, shape, &mut random);
    if quads { cornered(&disc) } else { disc }
}

/// Flips of edges that leave a simplicial complex.
fn flipped_at_random(s: &Surface, flips: usize, random: &mut Random) -> Surface {
    let mut faces: Vec<[u32; 3]> = s.faces().iter().map(|f| [f[0], f[1], f[2]]).collect();
    let mut face_of: HashMap<[u32; 2], usize> = HashMap::new();
    let join = |face_of: &mut HashMap<[u32; 2], usize>, f: usize, [a, b, c]: [u32; 3]| {
        [[a, b], [b, c], [c, a]].into_iter().for_each(|edge| _ = face_of.insert(edge, f));
    };
    (0..faces.len()).for_each(|f| join(&mut face_of, f, faces[f]));
    for _ in 0..flips {
        let f = random.below(faces.len());
        let k = random.below(3);
        let [a, b, c] = [0, 1, 2].map(|i| faces[f][(k + i) % 3]);
        let Some(&g) = face_of.get(&[b, a]) else { continue };
        let d = faces[g].into_iter().find(|&v| v != a && v != b).unwrap();
        if face_of.contains_key(&[c, d]) || face_of.contains_key(&[d, c]) {
            continue;
        }
        face_of.remove(&[a, b]);
        face_of.remove(&[b, a]);
        (faces[f], faces[g]) = ([a, d, c], [d, b, c]);
        join(&mut face_of, f, faces[f]);
        join(&mut face_of, g, faces[g]);
    }
    surface(s.positions().to_vec(), faces)
}

fn stacked(steps: usize, random: &mut Random) -> Surface {
    let mut faces = vec![[0, 1, 2]];
    let vertices = 3 + steps as u32 / 2;
    for v in 3..vertices {
        let f = random.below(faces.len());
        let [a, b, c] = faces[f];
        faces[f] = [a, b, v];
        faces.extend([[b, c, v], [c, a, v]]);
    }
    surface((0..vertices).map(|_| random.vector()).collect(), faces)
}

fn wheel(spokes: usize) -> Surface {
    let n = spokes as u32;
    surface(vec![[0.0; 3]; spokes + 1], (0..n).map(|k| [0, 1 + k, 1 + (k + 1) % n]))
}

fn place(disc: &mut Surface, columns: usize, shape: Shape, random: &mut Random) {
    let across = columns + 1;
    for (v, p) in disc.positions_mut().iter_mut().enumerate() {
        let cell = [(v % across) as f64, (v / across) as f64];
        *p = match shape {
            Shape::Terrible => {
                let scale = 10f64.powf(3.0 * random.real());
                random.vector().map(|x| scale * x)
            }
            _ => [cell[0] + 0.4 * random.real(), cell[1] + 0.4 * random.real(), 0.2 * random.real()],
        };
    }
    if shape == Shape::Drawn {
        let factor = 10f64.powf(4.5 * (1.0 + random.real()));
        disc.positions_mut().iter_mut().for_each(|p| p[0] *= factor);
    }
    if !matches!(shape, Shape::Needles | Shape::Caps | Shape::Collapsed) {
        return;
    }
    for _ in 0..disc.faces().len() / 8 + 1 {
        let f = disc.faces().get(random.below(disc.faces().len())).to_vec();
        let k = random.below(3);
        let [a, b, c] = [0, 1, 2].map(|i| disc.positions()[f[(k + i) % 3] as usize]);
        let gap = if shape == Shape::Collapsed { 0.0 } else { 10f64.powf(-6.0 * (1.0 + random.real())) };
        let off = random.vector().map(|x| gap * x);
        let share = match shape {
            Shape::Needles => 0.0,
            Shape::Collapsed if random.below(2) == 0 => 0.0,
            _ => 0.5 + 0.4 * random.real(),
        };
        // Far enough from each other that no face loses its area to rounding.
        disc.positions_mut()[f[(k + 2) % 3] as usize] =
            match shape == Shape::Collapsed || crate::common::distance(a, b) > 0.1 {
                true => [0, 1, 2].map(|i| a[i] + share * (b[i] - a[i]) + off[i]),
                false => c,
            };
    }
}

/// Every triangle cut into three quads, one in each corner.
fn cornered(s: &Surface) -> Surface {
    let mut positions = s.positions().to_vec();
    let mut middle: HashMap<[u32; 2], u32> = HashMap::new();
    let mut faces: Vec<[u32; 4]> = Vec::new();
    for f in s.faces().iter() {
        let mean = |of: &[u32]| {
            [0, 1, 2].map(|i| of.iter().map(|&v| s.positions()[v as usize][i]).sum::<f64>() / of.len() as f64)
        };
        let m = [0, 1, 2].map(|k| {
            let (a, b) = (f[k], f[(k + 1) % 3]);
            *middle.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                positions.push(mean(&[a, b]));
                positions.len() as u32 - 1
            })
        });
        let centre = positions.len() as u32;
        positions.push(mean(f));
        faces.extend([0, 1, 2].map(|k| [f[k], m[k], centre, m[(k + 2) % 3]]));
    }
    surface(positions, faces)
}
