use crate::common::*;
use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;
use riemap::constraint::on_circle;
use riemap::energy::conformal::Weight;
use riemap::energy::{Authalic, Circle, Conformal, Curvature, Energy, Gaps, Metric, Order, Rest, SquareSum};
use riemap::energy::{ENERGIES, EnergyKind, EnergyRow};
use riemap::quad_graph::QuadGraph;
use riemap::quad_graph::dual::{BoundaryDual, DUAL_POINTS, dual_point};
use riemap::quad_graph::metric::RestMetric;
use riemap::solver::Silent;
use riemap::solver::convex::{convex_map, edge_weights};
use riemap::surface::oriented_mesh::OrientedMesh;

pub const WEIGHTS: [Weight; 2] = [Weight::Unit, Weight::Integral];

/// A quad graph with its rest metric.
pub struct Case {
    pub name: String,
    pub disc: OrientedMesh,
    pub graph: QuadGraph,
    pub metric: RestMetric,
}

impl Case {
    pub fn quads(name: &str) -> Self {
        let disc = disc_of(name);
        let graph = graph_of(&disc, "");
        let metric = RestMetric::of_quads(&disc, &graph, None);
        Case { name: name.to_owned(), disc, graph, metric }
    }

    /// `None` where a foot misses its edge.
    pub fn triangles(name: &str, dual: &str, boundary_dual: BoundaryDual) -> Option<Self> {
        let disc = disc_of(name);
        let point = dual_point(dual)?;
        let graph = QuadGraph::from_triangles(&disc, point, boundary_dual).ok()?;
        let metric = RestMetric::of_triangles(&disc, &graph, point).unwrap();
        Some(Case { name: format!("{name} {dual} {boundary_dual:?}"), disc, graph, metric })
    }

    /// Quads and triangles, regular and not, every dual point, both boundary duals.
    pub fn all(surface: &str) -> Vec<Self> {
        let mut cases = vec![Self::quads(&format!("{surface}&mesh=quad"))];
        for mesh in ["triangle", "delaunay"] {
            for dual in DUAL_POINTS {
                for boundary in [BoundaryDual::Midpoint, BoundaryDual::Foot] {
                    cases.extend(Self::triangles(&format!("{surface}&mesh={mesh}"), dual.name(), boundary));
                }
            }
        }
        // Feet of incentres are always within their edges.
        assert!(cases.len() >= 9);
        cases
    }

    pub fn rest<'a>(&'a self, weight: Weight, held: &'a [bool]) -> Rest<'a> {
        Rest { graph: &self.graph, metric: &self.metric, weight, held }
    }

    /// The boundary near the unit circle and in order, the rest anywhere in it.
    pub fn state(&self, random: &mut Random) -> Vec<Complex64> {
        let mut z: Vec<Complex64> = (0..self.graph.vertices).map(|_| 0.7 * random.complex()).collect();
        for (v, place) in on_circle(&self.graph, 1.0, &[(0, 0.3)]).unwrap().iter() {
            z[v as usize] = place * (1.0 + 0.1 * random.real());
        }
        z
    }

    /// All energies that are finite on maps that fold, where they are defined; the barriers too.
    pub fn energies(&self, weight: Weight, held: &[bool]) -> Vec<Box<dyn Energy>> {
        let rest = self.rest(weight, held);
        let rows = || ENERGIES.iter().filter(|row| !row.properties().flip_free);
        let mut energies: Vec<Box<dyn Energy>> = rows().filter_map(|row| row.make(rest).ok()).collect();
        let defined = weight == Weight::Unit || self.graph.min_re_rho() > 0.0;
        assert_eq!(energies.len(), if defined { rows().count() } else { 2 }, "{}", self.name);
        energies.push(Box::new(Order::new(&self.graph)));
        energies.push(Box::new(Gaps::new(&self.graph)));
        energies
    }

    /// Those that are infinite there.
    pub fn flip_free(&self, weight: Weight) -> Vec<(&'static EnergyRow, Box<dyn Energy>)> {
        let held = vec![false; self.graph.vertices];
        let rows = ENERGIES.iter().filter(|row| row.properties().flip_free);
        rows.map(|row| (row, row.make(self.rest(weight, &held)).unwrap())).collect()
    }

    /// A map without folds, of an area like the surface's: means of neighbours, the boundary on a circle, all moved a little.
    pub fn state_without_folds(&self, random: &mut Random) -> Vec<Complex64> {
        let fixed = on_circle(&self.graph, 1.0, &[(0, 0.3)]).unwrap();
        let uniform = edge_weights("uniform").unwrap();
        let weights = (uniform.make)(&self.disc).unwrap();
        let mut z = convex_map(&self.disc, &weights, &fixed, &mut Silent).unwrap().z;
        z.resize(self.graph.vertices, Complex64::ZERO);
        let stretch = random.real();
        for z in &mut z {
            *z = *z + 0.3 * stretch * z.conj() + 0.02 * random.complex();
        }
        assert!(self.flip_free(Weight::Unit).iter().all(|(_, energy)| energy.value(&z).is_finite()), "{}", self.name);
        z
    }

    pub fn square_sums(&self, weight: Weight, held: &[bool]) -> Vec<Box<dyn SquareSum>> {
        let rest = self.rest(weight, held);
        let mut sums: Vec<Box<dyn SquareSum>> =
            vec![Box::new(Circle::new(rest)), Box::new(Metric::boundary_edges(rest))];
        sums.extend(Conformal::new(rest).ok().map(|e| Box::new(e) as Box<dyn SquareSum>));
        sums.extend(Authalic::new(rest).ok().map(|e| Box::new(e) as Box<dyn SquareSum>));
        sums.extend(Metric::all_edges(rest).ok().map(|e| Box::new(e) as Box<dyn SquareSum>));
        sums
    }
}

pub fn real(z: &[Complex64]) -> DVector<f64> {
    DVector::from_iterator(2 * z.len(), z.iter().flat_map(|z| [z.re, z.im]))
}

pub fn gradient(energy: &dyn Energy, z: &[Complex64]) -> DVector<f64> {
    let mut g = vec![Complex64::ZERO; z.len()];
    energy.add_gradient(1.0, z, &mut g);
    real(&g)
}

/// The sum of all blocks, dense.
pub fn hessian(energy: &dyn Energy, z: &[Complex64], curvature: Curvature) -> DMatrix<f64> {
    let stencils = energy.stencils();
    let mut dense = DMatrix::zeros(2 * z.len(), 2 * z.len());
    let mut pieces = 0;
    energy.hessian(z, curvature, &mut |e, block| {
        let place = |i: usize| 2 * stencils.get(e)[i / 2] as usize + i % 2;
        for i in 0..2 * stencils.arity {
            for j in 0..2 * stencils.arity {
                dense[(place(i), place(j))] += block[i][j];
            }
        }
        pieces += 1;
    });
    assert_eq!(pieces, stencils.len());
    dense
}

/// Central differences of `f` at x, one column for each coordinate.
pub fn differences(x: &DVector<f64>, h: f64, f: impl Fn(&DVector<f64>) -> DVector<f64>) -> DMatrix<f64> {
    let columns: Vec<DVector<f64>> = (0..x.len())
        .map(|k| {
            let (mut ahead, mut behind) = (x.clone(), x.clone());
            ahead[k] += h;
            behind[k] -= h;
            (f(&ahead) - f(&behind)) / (ahead[k] - behind[k])
        })
        .collect();
    DMatrix::from_columns(&columns)
}

pub fn complex(x: &DVector<f64>) -> Vec<Complex64> {
    x.as_slice().chunks_exact(2).map(|x| Complex64::new(x[0], x[1])).collect()
}

/// Relative to the largest entry. With h = 1e-5 differences are off by h² times third derivatives, which exceed the
/// first ones by 1e3 at most here, and by the rounding of values, 1e-16 / h, up to 1e3 as large as the derivatives.
pub const DIFFERENCE: f64 = 1e-6;
pub const STEP: f64 = 1e-5;

#[track_caller]
pub fn assert_near(a: &DMatrix<f64>, b: &DMatrix<f64>, tolerance: f64, what: &str) {
    let (apart, size) = ((a - b).amax(), a.amax().max(b.amax()));
    assert!(apart <= tolerance * size, "{what}: {apart:e} of {size:e}");
}
