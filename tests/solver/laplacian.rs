use nalgebra::DMatrix;
use num_complex::Complex64;
use riemap::input::Input;
use riemap::laplacian::{Colouring, ConformalLaplacian, LaplacianError, Ordered};
use riemap::quad_graph::QuadGraph;
use riemap::quad_graph::dual::{BoundaryDual, dual_point};
use riemap::surface::oriented_mesh::OrientedMesh;

use crate::common::{Random, disc_of, graph_of, planar_places};

/// Quads, triangles, irregular ones, every dual point; on the last, with circumcentres, some Re ρ are negative.
const MESHES: [(&str, &str); 7] = [
    ("graph:cos+cos?n=9", "barycentre"),
    ("graph:cos+cos?n=8&jitter=0.3&seed=4", "barycentre"),
    ("enneper?n=7&mesh=triangle", "barycentre"),
    ("sphere?n=12&mesh=delaunay", "barycentre"),
    ("sphere?n=12&mesh=delaunay", "incentre"),
    ("sphere?n=12&mesh=delaunay", "circumcentre"),
    ("graph:cos+cos?n=9&mesh=triangle&jitter=0.4", "circumcentre"),
];

fn laplacian(graph: &QuadGraph) -> ConformalLaplacian {
    ConformalLaplacian::new(graph, || ()).unwrap_or_else(|error| panic!("{error}"))
}

fn flux(laplacian: &ConformalLaplacian, b: &[Complex64]) -> Vec<Complex64> {
    let mut flux = vec![Complex64::ZERO; b.len()];
    laplacian.flux(b, &mut flux, &mut laplacian.work());
    flux
}

fn random(n: usize, seed: u64) -> Vec<Complex64> {
    let mut random = Random(seed);
    (0..n).map(|_| random.complex()).collect()
}

fn size(z: &[Complex64]) -> f64 {
    z.iter().map(|z| z.norm()).fold(0.0, f64::max)
}

fn apart(a: &[Complex64], b: &[Complex64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
}

/// The same with T as a dense matrix for at most `dense` boundary vertices.
fn laplacian_with(graph: &QuadGraph, dense: usize) -> ConformalLaplacian {
    Ordered::new(graph, Colouring::new(graph).unwrap()).unwrap().factorise(graph, dense, || ()).unwrap()
}

/// L on all vertices, by its definition.
fn dense(graph: &QuadGraph, laplacian: &ConformalLaplacian) -> DMatrix<Complex64> {
    let mut l = DMatrix::zeros(graph.vertices, graph.vertices);
    for quad in laplacian.colouring().quads(graph) {
        let [i, j] = quad.black.map(|v| v as usize);
        l[(i, i)] += quad.rho;
        l[(j, j)] += quad.rho;
        l[(i, j)] -= quad.rho;
        l[(j, i)] -= quad.rho;
    }
    l
}

#[test]
fn extensions_of_any_boundary_values_meet_system_2_to_rounding() {
    for (name, dual) in MESHES {
        let graph = graph_of(&disc_of(name), dual);
        let laplacian = laplacian(&graph);
        let b = random(laplacian.len(), 5);
        let w_0 = Complex64::new(0.3, -2.0);
        let z = laplacian.extend(&graph, &b, w_0, &mut laplacian.work());
        // The same for (2) as the quads state it.
        let worst = (0..graph.quads.len()).map(|q| riemap::energy::conformal::residual(&graph, q, &z).norm());
        let worst = worst.fold(0.0, f64::max);
        println!("{name} {dual}: {worst:e}, {:e}", laplacian.residual(&graph, &z));
        assert!(worst < 1e-11 * size(&z), "{name} {dual}: {worst:e}");
        assert!(laplacian.residual(&graph, &z) < 1e-11, "{name} {dual}");
        for (&v, b) in laplacian.black_boundary().iter().zip(&b) {
            assert_eq!(z[v as usize], *b);
        }
        let mut w = vec![Complex64::ZERO; b.len()];
        laplacian.white(&b, &flux(&laplacian, &b), w_0, &mut w);
        let on_boundary: Vec<Complex64> = laplacian.white_boundary().iter().map(|&v| z[v as usize]).collect();
        assert!(apart(&w, &on_boundary) < 1e-11 * size(&z), "{name} {dual}");
        let mean = w.iter().sum::<Complex64>() / w.len() as f64;
        assert!((mean - w_0).norm() < 1e-12 * size(&z), "{name} {dual}");
    }
}

#[test]
fn the_flux_is_that_of_the_dense_schur_complement_which_is_symmetric() {
    for (name, dual) in MESHES {
        let graph = graph_of(&disc_of(name), dual);
        let laplacian = laplacian(&graph);
        let l = dense(&graph, &laplacian);
        let n = laplacian.len();
        let indices = |vertices: &[u32]| vertices.iter().map(|&v| v as usize).collect::<Vec<_>>();
        let (b, i) = (indices(laplacian.black_boundary()), indices(laplacian.inner()));
        let part = |rows: &[usize], columns: &[usize]| l.select_rows(rows).select_columns(columns);
        let inverse = part(&i, &i).lu().solve(&part(&i, &b)).unwrap();
        let t = part(&b, &b) - part(&b, &i) * inverse;
        assert!((&t - t.transpose()).camax() < 1e-11 * t.camax(), "{name} {dual}");
        for dense in [0, n] {
            let laplacian = laplacian_with(&graph, dense);
            for k in 0..n {
                let mut unit = vec![Complex64::ZERO; n];
                unit[k] = Complex64::ONE;
                let column: Vec<Complex64> = t.column(k).iter().copied().collect();
                assert!(apart(&flux(&laplacian, &unit), &column) < 1e-11 * t.camax(), "{name} {dual} {dense} {k}");
            }
        }
    }
}

#[test]
fn extensions_do_not_depend_on_how_t_is_kept() {
    for (name, dual) in MESHES {
        let graph = graph_of(&disc_of(name), dual);
        let [pruned, dense] = [0, usize::MAX].map(|dense| laplacian_with(&graph, dense));
        let b = random(pruned.len(), 6);
        let [z, other] = [&pruned, &dense].map(|l| l.extend(&graph, &b, Complex64::ZERO, &mut l.work()));
        assert!(apart(&z, &other) < 1e-11 * size(&z), "{name} {dual}");
        let right = random(pruned.inner().len(), 7);
        let [y, other] = [&pruned, &dense].map(|l| {
            let mut work = l.work();
            let mut y = right.clone();
            // What a flux leaves behind must not matter.
            l.flux(&b, &mut vec![Complex64::ZERO; b.len()], &mut work);
            l.inner_solve(&mut y, &mut work);
            l.inner_solve(&mut right.clone(), &mut work);
            y
        });
        assert!(apart(&y, &other) < 1e-11 * size(&y), "{name} {dual}");
    }
}

#[test]
fn constants_have_no_flux_and_what_flows_out_is_nothing_in_all() {
    for (name, dual) in MESHES {
        let laplacian = laplacian(&graph_of(&disc_of(name), dual));
        let n = laplacian.len();
        assert!(size(&flux(&laplacian, &vec![Complex64::ONE; n])) < 1e-11, "{name} {dual}");
        let flux = flux(&laplacian, &random(n, 8));
        assert!(flux.iter().sum::<Complex64>().norm() < 1e-11 * size(&flux) * n as f64, "{name} {dual}");
    }
}

#[test]
fn planar_meshes_are_extended_to_themselves() {
    for dual in ["barycentre", "incentre", "circumcentre"] {
        let disc = disc_of("graph:cos+cos?n=12&amplitude=0&mesh=delaunay&seed=5");
        let graph = graph_of(&disc, dual);
        let z = planar_places(&disc, dual_point(dual).unwrap(), BoundaryDual::Midpoint);
        is_extended_to(&graph, &z);
    }
    let disc = disc_of("graph:cos+cos?n=12&amplitude=0&mesh=quad&jitter=0.3&seed=5");
    is_extended_to(&graph_of(&disc, ""), &planar(&disc));
}

fn planar(disc: &OrientedMesh) -> Vec<Complex64> {
    disc.positions.iter().map(|p| Complex64::new(p[0], p[1])).collect()
}

/// The boundary values of z extend to z, which is discrete conformal.
fn is_extended_to(graph: &QuadGraph, z: &[Complex64]) {
    let laplacian = laplacian(graph);
    let at = |vertices: &[u32]| vertices.iter().map(|&v| z[v as usize]).collect::<Vec<_>>();
    let b = at(laplacian.black_boundary());
    let first = laplacian.loops()[0].clone();
    let w_0 = at(laplacian.white_boundary())[first.clone()].iter().sum::<Complex64>() / first.len() as f64;
    let extended = laplacian.extend(graph, &b, w_0, &mut laplacian.work());
    assert!(apart(&extended, z) < 1e-11 * size(z), "{:e}", apart(&extended, z));
    let mut w = vec![Complex64::ZERO; b.len()];
    laplacian.white(&b, &flux(&laplacian, &b), w_0, &mut w);
    assert!(apart(&w, &at(laplacian.white_boundary())) < 1e-11 * size(z));
}

/// A planar ring of quads, `rings` deep, with 2n vertices around; its inner loop begins with a white vertex.
fn ring(n: usize, rings: usize) -> (QuadGraph, Vec<Complex64>) {
    let around = 2 * n;
    let mut random = Random(3);
    let z: Vec<Complex64> = (0..=rings)
        .flat_map(|r| (0..around).map(move |k| (r, k)))
        .map(|(r, k)| {
            let place = Complex64::from_polar(1.0 - 0.2 * r as f64, (k as f64) * std::f64::consts::PI / n as f64);
            place + 0.02 * random.complex()
        })
        .collect();
    let at = |r: usize, k: usize| (r * around + k % around) as u32;
    let quads: Vec<[u32; 4]> = (0..rings)
        .flat_map(|r| (0..around).map(move |k| (r, k)))
        .map(|(r, k)| [at(r, k), at(r, k + 1), at(r + 1, k + 1), at(r + 1, k)])
        .collect();
    let diagonals = |q: &[u32; 4]| {
        let [a, b, c, d] = q.map(|v| z[v as usize]);
        (c - a, d - b)
    };
    let outer = 0..around;
    let mut boundary: Vec<u32> = outer.clone().map(|k| at(0, k)).collect();
    boundary.extend((0..around).map(|k| at(rings, 2 * around + 1 - rings % 2 - k)));
    let graph = QuadGraph {
        vertices: z.len(),
        primal: z.len(),
        rho: quads.iter().map(|q| (diagonals(q).1) / (Complex64::I * diagonals(q).0)).collect(),
        diagonal: quads.iter().map(|q| diagonals(q).0.norm()).collect(),
        tilted: 0,
        boundary_length: vec![1.0; boundary.len()],
        boundary,
        loops: vec![outer, around..2 * around],
        places: z.iter().map(|z| [z.re, z.im, 0.0]).collect(),
        quads,
    };
    (graph, z)
}

#[test]
fn the_white_values_of_a_hole_follow_from_those_of_the_outer_loop() {
    for (n, rings) in [(5, 2), (8, 3), (11, 1)] {
        let (graph, z) = ring(n, rings);
        is_extended_to(&graph, &z);
        assert_eq!(laplacian(&graph).shifts().len(), 1);
    }
}

#[test]
fn closed_surfaces_are_solved_with_one_black_vertex_held() {
    for name in ["torus?n=8", "torus?n=8&mesh=triangle"] {
        let input = Input::open(name).unwrap();
        let (disc, _) = OrientedMesh::closed(&input.surface, &input.diagnosis(), false).unwrap();
        let graph = graph_of(&disc, "barycentre");
        let laplacian = laplacian(&graph);
        let l = dense(&graph, &laplacian);
        let held = laplacian.held().unwrap();
        assert!(laplacian.is_empty() && laplacian.inner_index(held).is_none());
        let right = random(laplacian.inner().len(), 9);
        let mut y = right.clone();
        laplacian.inner_solve(&mut y, &mut laplacian.work());
        let mut z = nalgebra::DVector::zeros(graph.vertices);
        for (&v, y) in laplacian.inner().iter().zip(&y) {
            z[v as usize] = *y;
        }
        let product = l * z;
        let found: Vec<Complex64> = laplacian.inner().iter().map(|&v| product[v as usize]).collect();
        assert!(apart(&found, &right) < 1e-11, "{name}");
    }
}

#[test]
fn surfaces_whose_edges_do_not_alternate_are_refused() {
    let input = Input::open("torus?n=7").unwrap();
    let (disc, _) = OrientedMesh::closed(&input.surface, &input.diagnosis(), false).unwrap();
    let error = ConformalLaplacian::new(&graph_of(&disc, ""), || ()).unwrap_err();
    assert_eq!(error, LaplacianError::NotTwoColoured { classes: 1 });
}

#[test]
fn the_greens_function_sends_all_its_flux_through_the_boundary() {
    for (name, dual) in MESHES {
        let graph = graph_of(&disc_of(name), dual);
        let laplacian = laplacian(&graph);
        let green = laplacian.green(&graph, &mut laplacian.work()).unwrap();
        assert!(laplacian.inner_index(green.pole).is_some());
        assert!((green.flux.iter().sum::<Complex64>() - 1.0).norm() < 1e-11, "{name} {dual}");
    }
}
