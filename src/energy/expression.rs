use std::fmt;
use std::str::FromStr;
use std::sync::Arc;

use serde::{Deserialize, Deserializer};

use super::{ENERGIES, EnergyKind, energy};

/// A sum of energies with coefficients, such as `H + 0.5 L + A`.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    terms: Vec<Term>,
}

/// A coefficient and an energy.
#[derive(Clone)]
pub struct Term {
    /// The coefficient, finite and ≥ 0.
    pub coefficient: f64,
    /// The energy.
    pub energy: Arc<dyn EnergyKind>,
}

impl PartialEq for Term {
    fn eq(&self, other: &Self) -> bool {
        self.coefficient == other.coefficient && self.energy.name() == other.energy.name()
    }
}

impl fmt::Debug for Term {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{} {}", self.coefficient, self.energy.name())
    }
}

/// The expressions that have methods of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standard {
    /// H.
    Conformal,
    /// H + C.
    OnCircle,
    /// H + L'.
    OfLengths,
}

/// A text is not an expression.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ExpressionError {
    /// No energy has this name.
    #[error("unknown energy `{name}`; known: {}", ENERGIES.iter().map(EnergyKind::name).collect::<Vec<_>>().join(", "))]
    Unknown {
        /// The name.
        name: String,
    },
    /// A term is malformed.
    #[error("`{term}` is not a term; expected a name, or a coefficient and a name, as in `H + 0.5 L`")]
    Term {
        /// The term.
        term: String,
    },
    /// A coefficient is negative or not finite.
    #[error("the coefficient of {name} is {coefficient}; it must be finite and not negative")]
    Coefficient {
        /// The energy.
        name: &'static str,
        /// Its coefficient.
        coefficient: f64,
    },
    /// An energy occurs twice.
    #[error("{name} occurs twice")]
    Twice {
        /// The energy.
        name: &'static str,
    },
}

impl Expression {
    /// The sum of energies of the table, each with the coefficient 1.
    fn of(names: &[&str]) -> Self {
        let row = |name: &&str| Some(Term { coefficient: 1.0, energy: Arc::new(*energy(name)?) });
        Expression { terms: names.iter().filter_map(row).collect() }
    }

    /// A standard expression, with coefficients 1.
    pub fn standard(standard: Standard) -> Self {
        Expression::of(match standard {
            Standard::Conformal => &["H"],
            Standard::OnCircle => &["H", "C"],
            Standard::OfLengths => &["H", "Lb"],
        })
    }

    /// Which standard expression it is, whatever the coefficients.
    pub fn as_standard(&self) -> Option<Standard> {
        let mut names: Vec<&str> = self.energies().map(EnergyKind::name).collect();
        names.sort_unstable();
        match names[..] {
            ["H"] => Some(Standard::Conformal),
            ["C", "H"] => Some(Standard::OnCircle),
            ["H", "Lb"] => Some(Standard::OfLengths),
            _ => None,
        }
    }

    /// The same sum and one term more, of an energy of the table or of one's own.
    ///
    /// # Errors
    /// A coefficient that is negative or not finite; an energy of a name that occurs already.
    pub fn plus(mut self, coefficient: f64, energy: Arc<dyn EnergyKind>) -> Result<Self, ExpressionError> {
        let name = energy.name();
        if !(coefficient >= 0.0 && coefficient.is_finite()) {
            return Err(ExpressionError::Coefficient { name, coefficient });
        }
        if self.terms.iter().any(|term| term.energy.name() == name) {
            return Err(ExpressionError::Twice { name });
        }
        self.terms.push(Term { coefficient, energy });
        Ok(self)
    }

    /// The terms in the order given, no energy twice, those with the coefficient 0 included.
    pub fn terms(&self) -> &[Term] {
        &self.terms
    }

    /// The energies that occur with positive coefficients.
    pub fn energies(&self) -> impl Iterator<Item = &dyn EnergyKind> + '_ {
        self.terms.iter().filter(|term| term.coefficient > 0.0).map(|term| &*term.energy)
    }

    /// Whether all coefficients are 1.
    pub fn is_even(&self) -> bool {
        self.terms.iter().all(|term| term.coefficient == 1.0)
    }

    /// Whether it fixes the scale of the map.
    pub fn fixes_scale(&self) -> bool {
        self.energies().any(|energy| energy.properties().fixes_scale)
    }

    /// Whether lengths or areas enter by polynomials, which admit flipped faces.
    pub fn has_lengths_or_areas(&self) -> bool {
        self.energies().map(EnergyKind::properties).any(|is| is.fixes_scale && !is.flip_free)
    }

    /// Whether lengths or areas of the interior enter by polynomials.
    pub fn has_inner_lengths_or_areas(&self) -> bool {
        self.energies().map(EnergyKind::properties).any(|is| is.fixes_scale && !is.flip_free && !is.boundary_only)
    }

    /// Whether it keeps the lengths of the boundary edges.
    pub fn keeps_boundary_lengths(&self) -> bool {
        self.energies().map(EnergyKind::properties).any(|is| is.fixes_scale && is.boundary_only)
    }

    /// Whether a term that admits flipped faces sees how the two diagonal classes of vertices lie to each other.
    pub fn joins_diagonal_classes(&self) -> bool {
        self.energies().map(EnergyKind::properties).any(|is| !is.diagonals_only && !is.flip_free && !is.on_circle)
    }

    /// Whether it draws the boundary to the unit circle.
    pub fn is_on_circle(&self) -> bool {
        self.energies().any(|energy| energy.properties().on_circle)
    }

    /// Whether it says where inner vertices are.
    pub fn determines_interior(&self) -> bool {
        self.energies().any(|energy| energy.properties().determines_interior)
    }

    /// Whether the sum is +∞ for maps with flipped faces.
    pub fn is_flip_free(&self) -> bool {
        self.energies().any(|energy| energy.properties().flip_free)
    }

    /// Whether all terms are sums over triangles that are +∞ where one is flipped.
    pub fn is_of_triangles(&self) -> bool {
        self.energies().all(|energy| energy.properties().flip_free)
    }

    /// Whether the lengths of the boundary are stiff beside H: with integral weights they are, and far from a solution the energy has long
    /// narrow valleys.
    pub fn is_stiff(&self) -> bool {
        self.keeps_boundary_lengths() && self.energies().any(|energy| energy.name() == "H")
    }
}

impl FromStr for Expression {
    type Err = ExpressionError;

    fn from_str(text: &str) -> Result<Self, ExpressionError> {
        let mut sum = Expression { terms: Vec::new() };
        for part in split_terms(text) {
            let part = part.trim();
            let wrong = || ExpressionError::Term { term: part.to_owned() };
            let start = part.find(|c: char| c.is_alphabetic() && !is_exponent(part, c)).ok_or_else(wrong)?;
            let (number, name) = part.split_at(start);
            let number = number.trim().trim_end_matches('*').trim();
            let coefficient = if number.is_empty() { 1.0 } else { number.parse().map_err(|_| wrong())? };
            let row = energy(name.trim()).ok_or_else(|| ExpressionError::Unknown { name: name.trim().to_owned() })?;
            sum = sum.plus(coefficient, Arc::new(*row))?;
        }
        Ok(sum)
    }
}

/// Whether the letter belongs to an exponent, as in 1e-3: an `e` between digits or before a sign.
fn is_exponent(part: &str, letter: char) -> bool {
    let Some(at) = part.find(letter) else { return false };
    let (before, after) = (&part[..at], &part[at + letter.len_utf8()..]);
    letter.eq_ignore_ascii_case(&'e')
        && before.ends_with(|c: char| c.is_ascii_digit() || c == '.')
        && after.starts_with(|c: char| c.is_ascii_digit() || c == '-' || c == '+')
}

/// Splits at every `+` that is not the sign of an exponent.
fn split_terms(text: &str) -> Vec<&str> {
    let bytes = text.as_bytes();
    let exponent = |k: usize| {
        k >= 2 && bytes[k - 1].eq_ignore_ascii_case(&b'e') && (bytes[k - 2].is_ascii_digit() || bytes[k - 2] == b'.')
    };
    let mut parts = Vec::new();
    let mut start = 0;
    for k in (0..bytes.len()).filter(|&k| bytes[k] == b'+') {
        if !exponent(k) {
            parts.push(&text[start..k]);
            start = k + 1;
        }
    }
    parts.push(&text[start..]);
    parts
}

impl fmt::Display for Expression {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, term) in self.terms.iter().enumerate() {
            let plus = if k == 0 { "" } else { " + " };
            match term.coefficient {
                1.0 => write!(out, "{plus}{}", term.energy.name())?,
                c => write!(out, "{plus}{c} {}", term.energy.name())?,
            }
        }
        Ok(())
    }
}

impl<'de> Deserialize<'de> for Expression {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        String::deserialize(deserializer)?.parse().map_err(serde::de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn expressions_read_back() {
        for text in ["H", "H + 0.5 L + A", "2.5 H + 0.001 Lb"] {
            assert_eq!(text.parse::<Expression>().unwrap().to_string(), text);
        }
        let e: Expression = "1e-3H+1e+2*C".parse().unwrap();
        let terms: Vec<_> = e.terms().iter().map(|term| (term.coefficient, term.energy.name())).collect();
        assert_eq!(terms, [(1e-3, "H"), (100.0, "C")]);
    }

    #[test]
    fn what_is_no_expression_is_refused() {
        let refused = |text: &str| text.parse::<Expression>().unwrap_err();
        assert_eq!(refused("H + X"), ExpressionError::Unknown { name: "X".into() });
        assert_eq!(refused("H + H"), ExpressionError::Twice { name: "H" });
        assert!(matches!(refused("H + -1 C"), ExpressionError::Coefficient { name: "C", .. }));
        for text in ["", "H +", "3", "H - C", "0.5.5 H", "1e400 H"] {
            text.parse::<Expression>().unwrap_err();
        }
    }
}
