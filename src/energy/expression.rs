use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Deserializer};

use super::{ENERGIES, EnergyRow, energy};

/// A sum of energies with coefficients, such as `H + 0.5 L + A`.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    /// The terms in the given order; no energy occurs twice.
    pub terms: Vec<Term>,
}

/// A coefficient and an energy.
#[derive(Clone, Debug, PartialEq)]
pub struct Term {
    /// The coefficient, ≥ 0.
    pub coefficient: f64,
    /// Name of the energy.
    pub name: &'static str,
}

/// A text is not an expression.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ExpressionError {
    /// No energy has this name.
    #[error("unknown energy `{name}`; known: {}", ENERGIES.iter().map(|e| e.name).collect::<Vec<_>>().join(", "))]
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
    /// Returns the sum of the energies with these names, all with coefficient 1.
    pub fn of(names: &[&'static str]) -> Self {
        Expression { terms: names.iter().map(|&name| Term { coefficient: 1.0, name }).collect() }
    }

    /// Whether the energy occurs with a positive coefficient.
    pub fn has(&self, name: &str) -> bool {
        self.terms.iter().any(|t| t.name == name && t.coefficient > 0.0)
    }

    /// Whether the sum is +∞ for maps with flipped faces.
    pub fn is_flip_free(&self) -> bool {
        self.rows().any(|row| row.flip_free)
    }

    /// The table entries of the energies with positive coefficients.
    pub fn rows(&self) -> impl Iterator<Item = &'static EnergyRow> + '_ {
        self.terms.iter().filter(|t| t.coefficient > 0.0).filter_map(|t| energy(t.name))
    }
}

impl FromStr for Expression {
    type Err = ExpressionError;

    fn from_str(text: &str) -> Result<Self, ExpressionError> {
        let mut terms: Vec<Term> = Vec::new();
        for part in split_terms(text) {
            let part = part.trim();
            let wrong = || ExpressionError::Term { term: part.to_owned() };
            let start = part.find(|c: char| c.is_alphabetic() && !is_exponent(part, c)).ok_or_else(wrong)?;
            let (number, name) = part.split_at(start);
            let number = number.trim().trim_end_matches('*').trim();
            let coefficient = if number.is_empty() { 1.0 } else { number.parse().map_err(|_| wrong())? };
            let row = energy(name.trim()).ok_or_else(|| ExpressionError::Unknown { name: name.trim().to_owned() })?;
            if !(coefficient >= 0.0 && f64::is_finite(coefficient)) {
                return Err(ExpressionError::Coefficient { name: row.name, coefficient });
            }
            if terms.iter().any(|t| t.name == row.name) {
                return Err(ExpressionError::Twice { name: row.name });
            }
            terms.push(Term { coefficient, name: row.name });
        }
        Ok(Expression { terms })
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
                1.0 => write!(out, "{plus}{}", term.name)?,
                c => write!(out, "{plus}{c} {}", term.name)?,
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
        assert_eq!(e.terms, [Term { coefficient: 1e-3, name: "H" }, Term { coefficient: 100.0, name: "C" }]);
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
