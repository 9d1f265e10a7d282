//! Sources inside, and the flux that they send through the boundary.

use num_complex::Complex64;

use super::{ConformalLaplacian, Work};

impl ConformalLaplacian {
    /// Writes the flux `−L_BI L_II⁻¹ s` (n) through the black boundary vertices of sources s at the inner black ones (m, in the
    /// order of [`ConformalLaplacian::inner`]). Its sum is that of s.
    pub fn outflow(&self, sources: &[Complex64], flux: &mut [Complex64], work: &mut Work) {
        let mut y = work.take();
        y.copy_from_slice(sources);
        self.factor.solve(&mut y, work);
        flux.fill(Complex64::ZERO);
        self.rows.subtract_outward(&y, flux);
        work.give_back(y);
    }
}
