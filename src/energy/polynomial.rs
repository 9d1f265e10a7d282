/// A polynomial of degree at most 8, used for an energy along a line; the coefficient of tᵏ is at
/// index k.
///
/// H, C and the metric energies are quartic along a line; A squares a squared area and has degree
/// 8.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polynomial(pub [f64; 9]);

impl Polynomial {
    /// The zero polynomial.
    pub const ZERO: Polynomial = Polynomial([0.0; 9]);

    /// Returns `a + b t + c t²`.
    pub fn quadratic(a: f64, b: f64, c: f64) -> Self {
        let mut p = Self::ZERO;
        p.0[..3].copy_from_slice(&[a, b, c]);
        p
    }

    /// Adds r², where r has degree at most 4.
    pub fn add_square(&mut self, r: &Polynomial) {
        for i in 0..5 {
            for j in 0..5 {
                self.0[i + j] += r.0[i] * r.0[j];
            }
        }
    }

    /// Adds `t p`.
    pub fn add_scaled(&mut self, t: f64, p: &Polynomial) {
        for (a, b) in self.0.iter_mut().zip(p.0) {
            *a += t * b;
        }
    }

    /// Returns `t p`.
    pub fn scaled(mut self, t: f64) -> Self {
        self.0.iter_mut().for_each(|a| *a *= t);
        self
    }

    /// Returns the square; the degree must be at most 4.
    pub fn squared(&self) -> Self {
        let mut square = Self::ZERO;
        square.add_square(self);
        square
    }

    /// Returns p(t).
    pub fn at(&self, t: f64) -> f64 {
        self.0.iter().rev().fold(0.0, |sum, a| sum * t + a)
    }

    /// Returns the derivative p′.
    pub fn derivative(&self) -> Self {
        let mut d = Self::ZERO;
        for k in 1..9 {
            d.0[k - 1] = k as f64 * self.0[k];
        }
        d
    }

    /// Returns the t > 0 with the smallest value among those at which the derivative changes sign;
    /// `None` if there are none. It is exact up to rounding, however many minima there are.
    pub fn minimum_ahead(&self) -> Option<f64> {
        let derivative = self.derivative();
        let bound = derivative.root_bound()?;
        let roots = derivative.roots_between(0.0, bound);
        let positive = roots.into_iter().filter(|&t| t > 0.0);
        positive.min_by(|&a, &b| self.at(a).total_cmp(&self.at(b)))
    }

    fn degree(&self) -> usize {
        self.0.iter().rposition(|&a| a != 0.0).unwrap_or(0)
    }

    /// Returns an upper bound on the absolute values of all roots.
    fn root_bound(&self) -> Option<f64> {
        let n = self.degree();
        if n == 0 {
            return None;
        }
        // Fujiwara's bound: 2 max |a_{n−k}/a_n|^{1/k}.
        let ratio = |k: usize| (self.0[n - k] / self.0[n]).abs().powf(1.0 / k as f64);
        let bound = 2.0 * (1..=n).map(ratio).fold(0.0, f64::max);
        bound.is_finite().then_some(bound)
    }

    /// Returns the simple real roots in `a ..= b`, ascending. Between neighbouring roots of the
    /// derivative the polynomial is monotone, and a change of sign is bisected.
    fn roots_between(&self, a: f64, b: f64) -> Vec<f64> {
        if self.degree() == 0 {
            return Vec::new();
        }
        let mut marks = vec![a];
        marks.extend(self.derivative().roots_between(a, b));
        marks.push(b);
        marks.windows(2).filter_map(|w| self.bisect(w[0], w[1])).collect()
    }

    fn bisect(&self, mut low: f64, mut high: f64) -> Option<f64> {
        let (at_low, at_high) = (self.at(low), self.at(high));
        if at_low == 0.0 {
            return Some(low);
        }
        if at_high == 0.0 || (at_low < 0.0) == (at_high < 0.0) {
            return None;
        }
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            if (self.at(middle) < 0.0) == (at_low < 0.0) {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(0.5 * (low + high))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lowest_of_several_minima_ahead_is_found() {
        // (t − 1)² (t − 3)² − t/10 has its lower minimum near 3.
        let mut p = Polynomial::ZERO;
        p.add_square(&Polynomial::quadratic(3.0, -4.0, 1.0));
        p.0[1] -= 0.1;
        let t = p.minimum_ahead().unwrap();
        assert!((t - 3.0).abs() < 0.02 && p.derivative().at(t).abs() < 1e-12);
    }

    #[test]
    fn minima_behind_are_not_taken() {
        assert_eq!(Polynomial::quadratic(0.0, 2.0, 1.0).minimum_ahead(), None);
        assert_eq!(Polynomial::quadratic(0.0, -2.0, 1.0).minimum_ahead(), Some(1.0));
        assert_eq!(Polynomial::quadratic(1.0, 0.0, 0.0).minimum_ahead(), None);
    }
}
