//! The interior eliminated: `H(z_B) = z_Bᴴ M z_B` for boundary values z_B alone.

use std::cell::RefCell;

use num_complex::Complex64;

use super::BoundaryError;
use crate::constraint::{Elimination, Fixed};
use crate::energy::conformal::{Weight, block, weights};
use crate::quad_graph::QuadGraph;
use crate::solver::Phase;
use crate::solver::linear::normal::{pattern, real_values};
use crate::sparse::{Pattern, PrunedCholesky, SplitColumns};

/// `K = c (shift ahead − shift back)` along the boundary.
pub(super) const C: f64 = 0.25;

/// With integral weights `Aᴴ W A = D + iK`, D real, K on the boundary alone: `(K z)_v = ¼ (z_{v+1} − z_{v−1})`. So the
/// interior that minimises H is `z_I = −D_II⁻¹ D_IB z_B`, and
///
/// ```text
/// H = z_Bᴴ M z_B     M = S + iK     S = D_BB − D_BI D_II⁻¹ D_IB     (nb × nb, S dense, real)
/// ```
///
/// S is the discrete Poincaré–Steklov operator. It is not formed: a product is a pair of triangular solves with the factor
/// of D_II, cut down to what connects the boundary. Boundary values are in the order of [`QuadGraph::boundary`].
pub struct Reduction<'a> {
    /// The graph.
    pub graph: &'a QuadGraph,
    /// The boundary held: what is left is the interior.
    elimination: Elimination,
    /// Of D_II; `None` without interior vertices.
    factor: Option<PrunedCholesky>,
    /// D_BI: (boundary position, port, value), by position.
    outward: Vec<(u32, u32, f64)>,
    /// D_BB, all entries: (position, position, value), sorted.
    along: Vec<(u32, u32, f64)>,
    work: RefCell<Work>,
}

struct Work {
    columns: Option<SplitColumns>,
    at_ports: Vec<Complex64>,
    products: usize,
}

impl<'a> Reduction<'a> {
    /// Eliminates the interior: one real Cholesky factorisation. `tell` is called when a phase begins.
    ///
    /// # Errors
    /// Re ρ ≤ 0 somewhere; a factor that breaks down.
    pub fn new(graph: &'a QuadGraph, mut tell: impl FnMut(Phase)) -> Result<Self, BoundaryError> {
        let w = weights(graph, Weight::Integral)?;
        let mut position = vec![Pattern::NONE; graph.vertices];
        for (k, &v) in graph.boundary.iter().enumerate() {
            position[v as usize] = k as u32;
        }
        let mut fixed = Fixed::default();
        graph.boundary.iter().for_each(|&v| fixed.hold(v, Complex64::ZERO));
        tell(Phase::Order);
        let elimination = Elimination::for_factor(graph, &fixed);
        tell(Phase::Assemble);
        let unknown = &elimination.unknown;
        let (mut outward, mut along) = (Vec::new(), Vec::new());
        for (q, quad) in graph.quads.iter().enumerate() {
            if quad.iter().all(|&v| position[v as usize] == Pattern::NONE) {
                continue;
            }
            let block = block(graph.rho[q], w[q]).map(|row| row.map(|entry| entry.re));
            for (i, &v) in quad.iter().enumerate().filter(|(_, v)| position[**v as usize] != Pattern::NONE) {
                for (j, &other) in quad.iter().enumerate() {
                    let (row, port) = (position[v as usize], unknown[other as usize]);
                    match port {
                        Pattern::NONE => along.push((row, position[other as usize], block[i][j])),
                        port => outward.push((row, port, block[i][j])),
                    }
                }
            }
        }
        add_up(&mut outward);
        add_up(&mut along);
        let mut ports: Vec<u32> = outward.iter().map(|&(_, u, _)| u).collect();
        ports.sort_unstable();
        ports.dedup();
        for (_, port, _) in &mut outward {
            *port = ports.partition_point(|p| p < port) as u32;
        }
        let count = ports.len();
        let unknowns = elimination.unknowns();
        let factor = if unknowns == 0 {
            None
        } else {
            let pattern = pattern(graph, &elimination);
            let values = real_values(&pattern, graph, &elimination, &w);
            let columns = pattern.into_columns();
            tell(Phase::Factor);
            let broken = |reason| BoundaryError::Factorisation { unknowns, reason };
            Some(PrunedCholesky::new(&columns, elimination.order, &values, ports).map_err(broken)?)
        };
        let columns = factor.as_ref().map(PrunedCholesky::work);
        let work = RefCell::new(Work { columns, at_ports: vec![Complex64::ZERO; count], products: 0 });
        Ok(Reduction { graph, elimination, factor, outward, along, work })
    }

    /// Whether vertex `v` is not on the boundary.
    pub(super) fn is_inside(&self, v: u32) -> bool {
        self.elimination.is_free(v)
    }

    /// Number of boundary vertices.
    pub fn len(&self) -> usize {
        self.graph.boundary.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.graph.boundary.is_empty()
    }

    /// Products with S made so far.
    pub fn products(&self) -> usize {
        self.work.borrow().products
    }

    /// Values of the factor, and of the part that a product reads.
    pub fn factor_len(&self) -> (usize, usize) {
        self.factor.as_ref().map_or((0, 0), |factor| (factor.len(), factor.pruned_len()))
    }

    /// S z (`nb`).
    pub fn s(&self, z: &[Complex64]) -> Vec<Complex64> {
        let mut product = vec![Complex64::ZERO; z.len()];
        for &(row, column, value) in &self.along {
            product[row as usize] += value * z[column as usize];
        }
        let work = &mut *self.work.borrow_mut();
        work.products += 1;
        if let (Some(factor), Some(columns)) = (&self.factor, &mut work.columns) {
            self.inward(z, &mut work.at_ports);
            factor.solve_at_ports(&mut work.at_ports, columns);
            for &(row, port, value) in &self.outward {
                product[row as usize] -= value * work.at_ports[port as usize];
            }
        }
        product
    }

    /// M z = S z + iK z (`nb`), which is ∂H/∂z̄.
    pub fn m(&self, z: &[Complex64]) -> Vec<Complex64> {
        let n = z.len();
        let mut product = self.s(z);
        for (v, product) in product.iter_mut().enumerate() {
            *product += Complex64::I * C * (z[(v + 1) % n] - z[(v + n - 1) % n]);
        }
        product
    }

    /// The map (`nv`) with these boundary values and the interior that minimises H.
    pub fn extend(&self, z: &[Complex64]) -> Vec<Complex64> {
        let mut map = vec![Complex64::ZERO; self.graph.vertices];
        for (&v, &z) in self.graph.boundary.iter().zip(z) {
            map[v as usize] = z;
        }
        let work = &mut *self.work.borrow_mut();
        if let (Some(factor), Some(columns)) = (&self.factor, &mut work.columns) {
            self.inward(z, &mut work.at_ports);
            for (&v, z) in self.elimination.free.iter().zip(factor.solve_from_ports(&work.at_ports, columns)) {
                map[v as usize] = -z;
            }
        }
        map
    }

    /// The flux `−D_BI D_II⁻¹ e` (`nb`) that leaves through the boundary when e, a few sources (vertex, strength), is fed
    /// into the interior; sources on the boundary leave at once.
    pub fn flux(&self, sources: &[(u32, Complex64)]) -> Vec<Complex64> {
        let inside = |v: u32| self.elimination.unknown[v as usize];
        let sources: Vec<_> = sources.iter().map(|&(v, e)| (inside(v), e)).filter(|s| s.0 != Pattern::NONE).collect();
        let work = &mut *self.work.borrow_mut();
        let mut flux = vec![Complex64::ZERO; self.len()];
        if let (Some(factor), Some(columns)) = (&self.factor, &mut work.columns) {
            let at_ports = factor.solve_to_ports(sources.into_iter(), columns);
            for &(row, port, value) in &self.outward {
                flux[row as usize] -= value * at_ports[port as usize];
            }
        }
        flux
    }

    /// The flux `f = e_B − D_BI D_II⁻¹ e_I` (`nb`) of sources everywhere (`nv`).
    pub fn whole_flux(&self, sources: &[f64]) -> Vec<f64> {
        let work = &mut *self.work.borrow_mut();
        let mut flux: Vec<f64> = self.graph.boundary.iter().map(|&v| sources[v as usize]).collect();
        if let (Some(factor), Some(columns)) = (&self.factor, &mut work.columns) {
            let inside: Vec<Complex64> =
                self.elimination.free.iter().map(|&v| Complex64::new(sources[v as usize], 0.0)).collect();
            let potential = factor.solve_to_ports(inside.iter().enumerate().map(|(u, &e)| (u as u32, e)), columns);
            for &(row, port, value) in &self.outward {
                flux[row as usize] -= value * potential[port as usize].re;
            }
        }
        flux
    }

    /// D_IB z at the ports.
    fn inward(&self, z: &[Complex64], at_ports: &mut [Complex64]) {
        at_ports.fill(Complex64::ZERO);
        for &(row, port, value) in &self.outward {
            at_ports[port as usize] += value * z[row as usize];
        }
    }
}

/// Sorts, and adds up the values of equal places.
fn add_up(entries: &mut Vec<(u32, u32, f64)>) {
    entries.sort_unstable_by_key(|&(row, column, _)| (row, column));
    entries.dedup_by(|next, kept| {
        let same = (next.0, next.1) == (kept.0, kept.1);
        if same {
            kept.2 += next.2;
        }
        same
    });
}
