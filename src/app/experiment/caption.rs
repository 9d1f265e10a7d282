use serde::{Deserialize, Deserializer};
use serde_json::Value;

use super::RunError;
use super::grid::number;
use crate::figure::power_of_ten;

/// A caption template. `{result.energy.total}` is replaced by the value at that dotted key, a
/// number to four digits; `{result.distortion.quasi_conformal.max - 1}` how much it exceeds 1;
/// `{+result.rho.im}` has its sign written apart; `{result.periods.tau.1}` is the second element of
/// an array. Text in `[ ]` is left out if one of its keys has no value.
#[derive(Clone, Debug, PartialEq)]
pub struct Caption {
    parts: Vec<Part>,
}

#[derive(Clone, Debug, PartialEq)]
enum Part {
    Text(String),
    /// The value of a key.
    Value(Place),
    /// In brackets.
    Optional(Vec<Part>),
}

/// A key whose value is inserted.
#[derive(Clone, Debug, PartialEq)]
struct Place {
    key: String,
    /// The number that is subtracted from the value.
    less: f64,
    /// Whether the sign is always written, with spaces around it.
    signed: bool,
}

/// Braces or brackets that do not match.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CaptionError {
    /// `{` without `}`, or the other way round.
    #[error("the caption has a `{0}` without its counterpart; values stand in {{ }}, optional parts in [ ]")]
    Unmatched(char),
    /// Brackets in brackets, or a key that is none.
    #[error("`{0}` in the caption is no key; expected one like {{result.energy.total}}")]
    NoKey(String),
}

impl Caption {
    /// Reads a template.
    ///
    /// # Errors
    /// Braces or brackets that do not match.
    pub fn parse(text: &str) -> Result<Self, CaptionError> {
        let (mut parts, mut outer) = (Vec::new(), None);
        let mut rest = text;
        while let Some(at) = rest.find(['{', '}', '[', ']']) {
            if at > 0 {
                parts.push(Part::Text(rest[..at].to_owned()));
            }
            let (sign, after) = (rest.as_bytes()[at] as char, &rest[at + 1..]);
            rest = after;
            match sign {
                '{' => {
                    let end = after.find('}').ok_or(CaptionError::Unmatched('{'))?;
                    let no_key = || CaptionError::NoKey(after[..end].to_owned());
                    let (signed, inner) =
                        after[..end].strip_prefix('+').map_or((false, &after[..end]), |key| (true, key));
                    let (key, less) = inner.split_once(" - ").unwrap_or((inner, "0"));
                    let less: f64 = less.parse().map_err(|_| no_key())?;
                    let plain = |c: char| c.is_alphanumeric() || "._-".contains(c);
                    if key.is_empty() || !key.chars().all(plain) || !less.is_finite() {
                        return Err(no_key());
                    }
                    parts.push(Part::Value(Place { key: key.to_owned(), less, signed }));
                    rest = &after[end + 1..];
                }
                '[' if outer.is_none() => outer = Some(std::mem::take(&mut parts)),
                ']' => {
                    let inner = std::mem::replace(&mut parts, outer.take().ok_or(CaptionError::Unmatched(']'))?);
                    parts.push(Part::Optional(inner));
                }
                unmatched => return Err(CaptionError::Unmatched(unmatched)),
            }
        }
        if outer.is_some() {
            return Err(CaptionError::Unmatched('['));
        }
        parts.push(Part::Text(rest.to_owned()));
        Ok(Caption { parts })
    }

    /// Fills in the caption of a run. `values` maps the first parts of keys to their values.
    ///
    /// # Errors
    /// [`RunError::CaptionKey`]: a key that is not there; one that is there without a value may
    /// stand in brackets alone.
    pub fn filled(&self, values: &Value) -> Result<String, RunError> {
        Ok(fill(&self.parts, values, true)?.unwrap_or_default())
    }
}

/// `None` where an optional part misses a value.
fn fill(parts: &[Part], values: &Value, required: bool) -> Result<Option<String>, RunError> {
    let mut text = String::new();
    for part in parts {
        match part {
            Part::Text(words) => text.push_str(words),
            Part::Optional(inner) => text.push_str(&fill(inner, values, false)?.unwrap_or_default()),
            Part::Value(Place { key, less, signed }) => match lookup(values, key)? {
                Value::Null if !required => return Ok(None),
                Value::Null => return Err(RunError::CaptionValue { key: key.clone() }),
                value => {
                    let difference = value.as_f64().filter(|_| *less != 0.0).map(|x| Value::from(x - less));
                    let number = printed(difference.as_ref().unwrap_or(value));
                    match number.strip_prefix('−') {
                        _ if !signed => text.push_str(&number),
                        Some(digits) => text.push_str(&format!("− {digits}")),
                        None => text.push_str(&format!("+ {number}")),
                    }
                }
            },
        }
    }
    Ok(Some(text))
}

/// Formats a value as in tables, except that powers of ten are superscripts, zeros stay where they
/// say how a number was rounded (1.000 is not 1), and the energy Lb is called L'.
fn printed(value: &Value) -> String {
    let text = number(value);
    match value {
        Value::String(words) => {
            words.split(' ').map(|w| if w == "Lb" { "L'" } else { w }).collect::<Vec<_>>().join(" ")
        }
        Value::Number(n) if n.is_f64() && !text.contains('e') => {
            let x = n.as_f64().unwrap_or(f64::NAN);
            // Text of four digits that is the number itself was not rounded.
            if text.parse() == Ok(x) {
                return text.replace('-', "−");
            }
            let decimals = (3.0 - x.abs().log10().floor()).max(0.0) as usize;
            format!("{x:.decimals$}").replace('-', "−")
        }
        _ => power_of_ten(&text),
    }
}

/// The value at a dotted key, or null. Elements of arrays are numbered from 0.
fn lookup<'a>(values: &'a Value, key: &str) -> Result<&'a Value, RunError> {
    let mut value = values;
    for (i, name) in key.split('.').enumerate() {
        let inner = match value {
            Value::Null => return Ok(value),
            Value::Array(parts) => name.parse::<usize>().ok().and_then(|k| parts.get(k)),
            _ => value.get(name),
        };
        let Some(inner) = inner else {
            let known = value.as_object().map(|fields| fields.keys().cloned().collect::<Vec<_>>().join(", "));
            let at = key.split('.').take(i).collect::<Vec<_>>().join(".");
            return Err(RunError::CaptionKey { key: key.to_owned(), at, known: known.unwrap_or_default() });
        };
        value = inner;
    }
    Ok(value)
}

impl<'de> Deserialize<'de> for Caption {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Caption::parse(&String::deserialize(deserializer)?).map_err(serde::de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn filled(template: &str) -> Result<String, RunError> {
        let values = json!({"result": {"E": 2.5e-26, "C": null, "name": "quad", "faces": 12, "x": 1.5, "tau": [0, 2], "y": 1.0001, "minus": -0.25, "L": "H + 0.5 Lb"}});
        Caption::parse(template).unwrap().filled(&values)
    }

    #[test]
    fn values_stand_where_their_keys_do_and_optional_parts_without_one_are_left_out() {
        assert_eq!(filled("E = {result.E}, {result.faces} {result.name}s").unwrap(), "E = 2.50×10⁻²⁶, 12 quads");
        assert_eq!(filled("a[, C = {result.C}][, n = {result.faces}]").unwrap(), "a, n = 12");
        assert_eq!(
            filled("1.5 - 1 = {result.x - 1}, 12 - 2 = {result.faces - 2}").unwrap(),
            "1.5 - 1 = 0.5, 12 - 2 = 10"
        );
        assert_eq!(filled("{result.y} is not {result.y - 0.0001}, {result.L}").unwrap(), "1.000 is not 1, H + 0.5 L'");
        assert_eq!(filled("[{result.C.re}, ]{result.tau.1} i").unwrap(), "2 i");
        assert_eq!(filled("{result.x} {+result.minus} i {+result.x}").unwrap(), "1.5 − 0.25 i + 1.5");
        assert_eq!(filled("").unwrap(), "");
    }

    #[test]
    fn keys_that_are_not_there_are_named_with_those_that_are() {
        let message = filled("{result.e}").unwrap_err().to_string();
        assert!(message.contains("result.e") && message.contains("faces"), "{message}");
        assert!(filled("[{result.none}]").is_err());
        assert!(filled("{result.C}").unwrap_err().to_string().contains("no value"));
        for wrong in ["{a", "a}", "[a", "a]", "{}", "[[a]]", "{a b}", "{a - b}", "{a - inf}"] {
            assert!(Caption::parse(wrong).is_err(), "{wrong}");
        }
    }
}
