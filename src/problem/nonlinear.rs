//! The nonlinear problem: a weighted sum of energies as a function of the unknowns that constraints
//! leave.

use num_complex::Complex64;

use crate::constraint::Freedoms;
use crate::energy::conformal::Dirichlet;
use crate::energy::{Block, Curvature, Energy, Polynomial};
use crate::sparse::{Analysis, Breakdown, Columns, Pattern, Stencils, pairs_of};

/// Energies with their coefficients.
pub type Terms = Vec<(f64, Box<dyn Energy>)>;

/// The objective `E(y) = Σ coefficient × energy(x(y))`. It is all that a minimiser knows of the
/// problem.
pub struct Objective {
    /// The energies with their coefficients.
    pub terms: Terms,
    /// The unknowns.
    pub freedoms: Freedoms,
    /// The norm in which steps are measured.
    pub norm: Dirichlet,
}

impl Objective {
    /// Returns E(y); +∞ if y is not admissible or vertices on the circle are out of order.
    pub fn value(&self, y: &[f64]) -> f64 {
        if !self.freedoms.is_in_order(y) {
            return f64::INFINITY;
        }
        let z = self.freedoms.expand(y);
        self.terms.iter().map(|(t, energy)| t * energy.value(&z)).sum()
    }

    /// Returns the values of the energies without their coefficients.
    pub fn values(&self, y: &[f64]) -> Vec<(&'static str, f64)> {
        let z = self.freedoms.expand(y);
        self.terms.iter().map(|(_, energy)| (energy.name(), energy.value(&z))).collect()
    }

    /// Whether there are clearly more squares than unknowns, as with A or L in addition to H. The
    /// minimum is then not 0, and there are other local minima with flipped faces. H + C and H + L'
    /// have about as many squares as unknowns.
    pub fn is_overdetermined(&self) -> bool {
        let squares: usize = self.terms.iter().map(|(_, energy)| energy.residual_count()).sum();
        4 * squares > 5 * self.freedoms.unknowns()
    }

    /// Returns the gradient ∇E(y) (`m`).
    pub fn gradient(&self, y: &[f64]) -> Vec<f64> {
        self.gradient_of_map(y, &self.freedoms.expand(y))
    }

    /// Returns the derivatives at the map z in the directions of the unknowns at y (`m`).
    pub fn gradient_of_map(&self, y: &[f64], z: &[Complex64]) -> Vec<f64> {
        self.freedoms.restrict_gradient(y, &self.gradient_at(z))
    }

    /// ∂E/∂Re z + i ∂E/∂Im z (`nv`).
    fn gradient_at(&self, z: &[Complex64]) -> Vec<Complex64> {
        let mut g = vec![Complex64::ZERO; z.len()];
        for (t, energy) in &self.terms {
            energy.add_gradient(*t, z, &mut g);
        }
        g
    }

    /// Returns `Zᵀ Σ 2 r″ ∇r`, where r″ are the second derivatives of the residuals along p: the
    /// right-hand side of geodesic acceleration.
    pub fn bending(&self, y: &[f64], p: &[f64]) -> Vec<f64> {
        let (z, d) = (self.freedoms.expand(y), self.freedoms.expand_direction(y, p));
        let mut g = vec![Complex64::ZERO; z.len()];
        for (t, energy) in &self.terms {
            energy.add_bending(*t, &z, &d, &mut g);
        }
        self.freedoms.restrict_gradient(y, &g)
    }

    /// Returns |J p|², where J is the Jacobian at y of all residuals, multiplied by the square
    /// roots of their coefficients.
    pub fn stretch(&self, y: &[f64], p: &[f64]) -> Option<f64> {
        let (z, d) = (self.freedoms.expand(y), self.freedoms.expand_direction(y, p));
        self.terms.iter().map(|(t, energy)| Some(t * energy.stretch(&z, &d)?)).sum()
    }

    /// Returns the largest step from y along p for which E is finite, up to rounding; see
    /// [`Energy::largest_step`]. If vertices slide on a circle, the step is along the tangent of
    /// their path.
    pub fn largest_step(&self, y: &[f64], p: &[f64]) -> f64 {
        let (z, d) = (self.freedoms.expand(y), self.freedoms.expand_direction(y, p));
        let order = self.freedoms.largest_step(y, p);
        self.terms.iter().map(|(_, energy)| energy.largest_step(&z, &d)).fold(order, f64::min)
    }

    /// Returns the coefficients of `t ↦ E(y + t p)`, if it is a polynomial.
    pub fn along(&self, y: &[f64], p: &[f64]) -> Option<Polynomial> {
        if self.freedoms.slides() {
            return None;
        }
        let (z, d) = (self.freedoms.expand(y), self.freedoms.expand_direction(y, p));
        let mut sum = Polynomial::ZERO;
        for (t, energy) in &self.terms {
            sum.add_scaled(*t, &energy.along(&z, &d)?);
        }
        Some(sum)
    }
}

/// Assembles Hessians of an objective on a pattern that is made once; constant parts are also
/// assembled once.
pub struct HessianAssembly<'a> {
    objective: &'a Objective,
    stencils: Vec<Stencils>,
    pattern: Pattern,
    /// For each entry of the pattern over vertices, the number of rows before it in its column of
    /// the real matrix.
    rows_before: Vec<u32>,
    columns: Columns,
    constant: Vec<f64>,
}

impl<'a> HessianAssembly<'a> {
    /// Makes the pattern. Vertices of one piece are coupled, each with as many rows and columns as
    /// it has unknowns.
    pub fn new(objective: &'a Objective) -> Self {
        let freedoms = &objective.freedoms;
        let vertices = freedoms.offset.len() - 1;
        let mut unknown = vec![Pattern::NONE; vertices];
        let moving: Vec<u32> = (0..vertices as u32).filter(|&v| freedoms.width(v as usize) > 0).collect();
        for (k, &v) in moving.iter().enumerate() {
            unknown[v as usize] = k as u32;
        }
        let mut stencils: Vec<Stencils> = objective.terms.iter().map(|(_, energy)| energy.stencils()).collect();
        stencils.push(objective.norm.stencils().clone());
        let pattern = Pattern::new(&stencils.iter().collect::<Vec<_>>(), &unknown, moving.len());

        let mut rows_before = vec![0; pattern.columns.rows.len()];
        let mut columns = Columns { offsets: vec![0], rows: Vec::with_capacity(4 * pattern.columns.rows.len()) };
        for (k, &v) in moving.iter().enumerate() {
            let mut before = 0;
            for entry in pattern.columns.entries(k) {
                rows_before[entry] = before;
                before += freedoms.width(moving[pattern.columns.rows[entry] as usize] as usize) as u32;
            }
            for component in 0..freedoms.width(v as usize) {
                for entry in pattern.columns.entries(k) {
                    let row = moving[pattern.columns.rows[entry] as usize] as usize;
                    let first = freedoms.offset[row] as usize + if row == v as usize { component } else { 0 };
                    columns.rows.extend(first as u32..freedoms.offset[row + 1]);
                }
                columns.offsets.push(columns.rows.len() as u32);
            }
        }
        let mut assembly = HessianAssembly { objective, stencils, pattern, rows_before, columns, constant: Vec::new() };
        let mut constant = vec![0.0; assembly.columns.rows.len()];
        let origin = vec![Complex64::ZERO; vertices];
        let directions = freedoms.directions(&vec![0.0; freedoms.unknowns()]);
        for (list, (t, energy)) in
            objective.terms.iter().enumerate().filter(|(_, (_, e))| is_constant(freedoms, e.as_ref()))
        {
            assembly.add(list, *t, energy.as_ref(), (&origin, &directions), Curvature::GaussNewton, &mut constant);
        }
        assembly.constant = constant;
        assembly
    }

    /// The pattern of the lower triangle.
    pub fn columns(&self) -> &Columns {
        &self.columns
    }

    /// Returns the elimination tree and fill of the pattern, in the order of
    /// [`Freedoms::elimination`] or by minimum degree.
    ///
    /// # Errors
    /// [`Breakdown::TooLarge`].
    pub fn analysis(&self) -> Result<Analysis<'_>, Breakdown> {
        let freedoms = &self.objective.freedoms;
        if freedoms.elimination.is_empty() {
            return Analysis::new(&self.columns);
        }
        let unknowns = |&v: &u32| freedoms.offset[v as usize]..freedoms.offset[v as usize + 1];
        let order: Vec<u32> = freedoms.elimination.iter().flat_map(unknowns).collect();
        Analysis::permuted(&self.columns, &order)
    }

    /// Returns the values of ∇²E(y) on the pattern.
    pub fn values(&self, y: &[f64], curvature: Curvature) -> Vec<f64> {
        let mut values = Vec::new();
        self.write_values(y, curvature, &mut values);
        values
    }

    /// Writes the values of ∇²E(y) on the pattern to `values`, whose memory is reused.
    pub fn write_values(&self, y: &[f64], curvature: Curvature, values: &mut Vec<f64>) {
        values.clone_from(&self.constant);
        let freedoms = &self.objective.freedoms;
        let (z, directions) = (freedoms.expand(y), freedoms.directions(y));
        let terms = self.objective.terms.iter().enumerate();
        for (list, (t, energy)) in terms.filter(|(_, (_, e))| !is_constant(freedoms, e.as_ref())) {
            self.add(list, *t, energy.as_ref(), (&z, &directions), curvature, values);
        }
        if freedoms.slides() {
            // ∂²z/∂θ² = −z. If the energy pulls a vertex outwards, this term keeps its steps short.
            let g = self.objective.gradient_at(&z);
            for (v, at) in freedoms.angles() {
                let bend = -(z[v].conj() * g[v]).re;
                values[self.columns.offsets[at] as usize] += match curvature {
                    Curvature::Exact => bend,
                    Curvature::GaussNewton => bend.max(0.0),
                };
            }
        }
    }

    /// Returns the values on the pattern of the matrix of the norm [`Objective::norm`] at y.
    pub fn norm_values(&self, y: &[f64]) -> Vec<f64> {
        let list = self.stencils.len() - 1;
        let mut values = vec![0.0; self.columns.rows.len()];
        let directions = self.objective.freedoms.directions(y);
        for e in 0..self.stencils[list].len() {
            self.add_block((list, e), 1.0, &self.objective.norm.block(e), &directions, &mut values);
        }
        values
    }

    /// Adds t × the Hessian of one energy.
    fn add(
        &self,
        list: usize,
        t: f64,
        energy: &dyn Energy,
        (z, directions): (&[Complex64], &[Complex64]),
        curvature: Curvature,
        values: &mut [f64],
    ) {
        energy.hessian(z, curvature, &mut |e, block| self.add_block((list, e), t, block, directions, values));
    }

    /// Adds t × the block of piece e of a list; `directions` are those of [`Freedoms::directions`].
    fn add_block(
        &self,
        (list, e): (usize, usize),
        t: f64,
        block: &Block,
        directions: &[Complex64],
        values: &mut [f64],
    ) {
        let freedoms = &self.objective.freedoms;
        let stencils = &self.stencils[list];
        let stencil = stencils.get(e);
        for (&slot, (i, j)) in self.pattern.slots(list, e, stencils.arity).iter().zip(pairs_of(stencils.arity)) {
            if slot == Pattern::NONE {
                continue;
            }
            // The entry is in the rows of the later vertex and the columns of the earlier one.
            let (i, j) = if stencil[i] >= stencil[j] { (i, j) } else { (j, i) };
            let (row, column) = (stencil[i], stencil[j]);
            let before = self.rows_before[slot as usize] as usize;
            let part = self.local_block(block, (i, row), (j, column), directions);
            let first_column = freedoms.offset[column as usize] as usize;
            for b in 0..freedoms.width(column as usize) {
                let start = self.columns.offsets[first_column + b] as usize + before;
                let from = if row == column { b } else { 0 };
                for a in from..freedoms.width(row as usize) {
                    values[start + a - b] += t * part[a][b];
                }
            }
        }
    }

    /// The 2 × 2 part of a block for two of its vertices, projected to the direction of a vertex
    /// with one unknown.
    fn local_block(
        &self,
        block: &Block,
        (i, row): (usize, u32),
        (j, column): (usize, u32),
        directions: &[Complex64],
    ) -> [[f64; 2]; 2] {
        let freedoms = &self.objective.freedoms;
        let mut part =
            [[block[2 * i][2 * j], block[2 * i][2 * j + 1]], [block[2 * i + 1][2 * j], block[2 * i + 1][2 * j + 1]]];
        if freedoms.width(row as usize) == 1 {
            let d = directions[row as usize];
            part[0] = [d.re * part[0][0] + d.im * part[1][0], d.re * part[0][1] + d.im * part[1][1]];
        }
        if freedoms.width(column as usize) == 1 {
            let d = directions[column as usize];
            for row in &mut part {
                row[0] = d.re * row[0] + d.im * row[1];
            }
        }
        part
    }
}

/// Whether the second derivatives of an energy with respect to the unknowns are constant.
fn is_constant(freedoms: &Freedoms, energy: &dyn Energy) -> bool {
    energy.is_quadratic() && !freedoms.slides()
}
