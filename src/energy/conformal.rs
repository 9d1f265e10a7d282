//! The conformal energy H: `H = Σ_quads w |z3 − z1 − iρ(z2 − z0)|²`.

use num_complex::Complex64;

use super::{Block, LocalMap, Polynomial, Rest, SquareSum};
use crate::quad_graph::QuadGraph;
use crate::sparse::Stencils;

/// The weights of quads and other pieces in the energies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Weight {
    /// `w = 1 / (4 Re ρ)`: H = 2 ∫ |∂̄z|², the Dirichlet energy minus the area; converges under
    /// refinement.
    #[default]
    Integral,
    /// `w = 1`, as in the paper.
    Unit,
}

/// Integral weights are undefined or negative on some quads.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "quad {quad}, with vertices {vertices:?} of the quad graph, has Re ρ = {re_rho:e}, and {count} in all are not \
     positive: integral weights are not defined there"
)]
pub struct NonPositiveRho {
    /// The first such quad.
    pub quad: usize,
    /// Its vertices.
    pub vertices: [u32; 4],
    /// Its Re ρ.
    pub re_rho: f64,
    /// Number of such quads.
    pub count: usize,
}

/// Returns the weight of every quad (`nf`).
///
/// # Errors
/// [`NonPositiveRho`] for integral weights if some Re ρ ≤ 0.
pub fn weights(graph: &QuadGraph, weight: Weight) -> Result<Vec<f64>, NonPositiveRho> {
    match weight {
        Weight::Unit => Ok(vec![1.0; graph.rho.len()]),
        Weight::Integral => {
            let mut bad = (0..graph.rho.len()).filter(|&q| graph.rho[q].re <= 0.0);
            match bad.next() {
                None => Ok(graph.rho.iter().map(|rho| 0.25 / rho.re).collect()),
                Some(quad) => Err(NonPositiveRho {
                    quad,
                    vertices: graph.quads[quad],
                    re_rho: graph.rho[quad].re,
                    count: 1 + bad.count(),
                }),
            }
        }
    }
}

/// The residual `r = z3 − z1 − iρ(z2 − z0)` of equation (2) on quad `q`.
pub fn residual(graph: &QuadGraph, q: usize, z: &[Complex64]) -> Complex64 {
    residual_at(graph.rho[q], graph.quads[q].map(|v| z[v as usize]))
}

/// The residual of equation (2) for a quad with corners at `z0, z1, z2, z3`.
pub fn residual_at(rho: Complex64, [z0, z1, z2, z3]: [Complex64; 4]) -> Complex64 {
    z3 - z1 - Complex64::I * rho * (z2 - z0)
}

/// The value `H = Σ w |r|²`.
pub fn value(graph: &QuadGraph, w: &[f64], z: &[Complex64]) -> f64 {
    (0..w.len()).map(|q| w[q] * residual(graph, q, z).norm_sqr()).sum()
}

/// Returns `Aᴴ W A z` (`nv`), which is ∂H/∂z̄, half of the gradient ∂H/∂x + i ∂H/∂y.
pub fn normal_product(graph: &QuadGraph, w: &[f64], z: &[Complex64]) -> Vec<Complex64> {
    normal_product_at(graph, w, |q| graph.quads[q].map(|v| z[v as usize]))
}

/// Returns `Aᴴ W r` (`nv`), where r are the residuals of quads `q` with corners at `corners(q)`.
///
/// This is [`normal_product`] for maps that are multivalued at the vertices.
pub fn normal_product_at(graph: &QuadGraph, w: &[f64], corners: impl Fn(usize) -> [Complex64; 4]) -> Vec<Complex64> {
    let mut product = vec![Complex64::ZERO; graph.vertices];
    for (q, &w) in w.iter().enumerate() {
        let r = w * residual_at(graph.rho[q], corners(q));
        for (v, a) in graph.quads[q].into_iter().zip(row(graph.rho[q])) {
            product[v as usize] += a.conj() * r;
        }
    }
    product
}

/// Returns `|Aᴴ| W |A| |z|` (`nv`), the size of the terms in the sums of [`normal_product`], and
/// hence of its rounding error.
pub fn normal_product_scale(graph: &QuadGraph, w: &[f64], z: &[Complex64]) -> Vec<f64> {
    normal_product_scale_at(graph, w, |q| graph.quads[q].map(|v| z[v as usize]))
}

/// Returns the size of the terms in the sums of [`normal_product_at`].
pub fn normal_product_scale_at(graph: &QuadGraph, w: &[f64], corners: impl Fn(usize) -> [Complex64; 4]) -> Vec<f64> {
    let mut scale = vec![0.0; graph.vertices];
    for (q, &w) in w.iter().enumerate() {
        let a = row(graph.rho[q]).map(Complex64::norm);
        let terms: f64 = corners(q).iter().zip(a).map(|(z, a)| a * z.norm()).sum();
        for (v, a) in graph.quads[q].into_iter().zip(a) {
            scale[v as usize] += w * a * terms;
        }
    }
    scale
}

/// The row of system (2) for a quad: the coefficients of z0, z1, z2, z3 in `z3 − z1 − iρ(z2 − z0)`.
pub fn row(rho: Complex64) -> [Complex64; 4] {
    let i_rho = Complex64::I * rho;
    [i_rho, -Complex64::ONE, -i_rho, Complex64::ONE]
}

/// The Hermitian 4 × 4 block `w āᵢ aⱼ` of a quad in `Aᴴ W A`, where a is its [`row`].
pub fn block(rho: Complex64, w: f64) -> [[Complex64; 4]; 4] {
    let a = row(rho);
    a.map(|ai| a.map(|aj| w * ai.conj() * aj))
}

/// H as an [`Energy`](super::Energy): two residuals per quad, the real and imaginary part of `√w
/// r`.
pub struct Conformal {
    quads: Stencils,
    rho: Vec<Complex64>,
    root_weight: Vec<f64>,
}

impl Conformal {
    /// Makes H of the quads of the graph.
    ///
    /// # Errors
    /// [`NonPositiveRho`] with integral weights.
    pub fn new(rest: Rest) -> Result<Self, NonPositiveRho> {
        let root_weight = weights(rest.graph, rest.weight)?.into_iter().map(f64::sqrt).collect();
        Ok(Conformal { quads: Stencils::new(&rest.graph.quads), rho: rest.graph.rho.clone(), root_weight })
    }

    fn weighted(&self, e: usize, [z0, z1, z2, z3]: &LocalMap) -> Complex64 {
        self.root_weight[e] * (z3 - z1 - Complex64::I * self.rho[e] * (z2 - z0))
    }
}

impl SquareSum for Conformal {
    fn name(&self) -> &'static str {
        "H"
    }

    fn stencils(&self) -> &Stencils {
        &self.quads
    }

    fn residuals_per_piece(&self) -> usize {
        2
    }

    fn residuals(&self, e: usize, z: &LocalMap) -> [f64; 2] {
        let r = self.weighted(e, z);
        [r.re, r.im]
    }

    fn jacobian(&self, e: usize, _z: &LocalMap) -> [[f64; 8]; 2] {
        let mut rows = [[0.0; 8]; 2];
        for (i, a) in row(self.rho[e]).into_iter().enumerate() {
            let a = self.root_weight[e] * a;
            (rows[0][2 * i], rows[0][2 * i + 1]) = (a.re, -a.im);
            (rows[1][2 * i], rows[1][2 * i + 1]) = (a.im, a.re);
        }
        rows
    }

    fn curvature(&self, _e: usize, _z: &LocalMap) -> Option<Block> {
        None
    }

    fn residuals_along(&self, e: usize, z: &LocalMap, d: &LocalMap) -> [Polynomial; 2] {
        let (r, s) = (self.weighted(e, z), self.weighted(e, d));
        [Polynomial::quadratic(r.re, s.re, 0.0), Polynomial::quadratic(r.im, s.im, 0.0)]
    }

    fn is_linear(&self) -> bool {
        true
    }
}

/// The Dirichlet part of H: `Σ w (|z3 − z1|² + |ρ|² |z2 − z0|² + 2 Im ρ (z3 − z1)·(z2 − z0))`.
///
/// This is H without the area term, the matrix D of `Aᴴ W A = D + iK`. It is not a term of the
/// energy but the natural norm of a change of the map: `2 ∫ |∇δz|²`.
pub struct Dirichlet {
    quads: Stencils,
    rho: Vec<Complex64>,
    weight: Vec<f64>,
}

impl Dirichlet {
    /// Makes it from the quads of the graph, with unit weights if integral ones are undefined.
    pub fn new(graph: &QuadGraph, weight: Weight) -> Self {
        let weight = weights(graph, weight).unwrap_or_else(|_| vec![1.0; graph.quads.len()]);
        Dirichlet { quads: Stencils::new(&graph.quads), rho: graph.rho.clone(), weight }
    }

    /// The vertices of each piece.
    pub fn stencils(&self) -> &Stencils {
        &self.quads
    }

    /// The second derivatives of a piece.
    pub fn block(&self, e: usize) -> Block {
        let hermitian = block(self.rho[e], self.weight[e]);
        let mut real = [[0.0; 8]; 8];
        for i in 0..4 {
            for j in 0..4 {
                let entry = 2.0 * hermitian[i][j].re;
                (real[2 * i][2 * j], real[2 * i + 1][2 * j + 1]) = (entry, entry);
            }
        }
        real
    }
}
