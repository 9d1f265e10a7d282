use serde::Deserialize;
use serde_json::Value;

/// What a claim says of one number or word of the result.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Bound {
    /// The value is at least this.
    pub min: Option<f64>,
    /// The value is at most this.
    pub max: Option<f64>,
    /// The value is this.
    pub equal: Option<Value>,
}

impl Bound {
    /// Why `value` is not as claimed; `None` if it is.
    pub fn violation(&self, value: &Value) -> Option<String> {
        if let Some(wanted) = self.equal.as_ref().filter(|wanted| *wanted != value) {
            return Some(format!("is {value}, expected {wanted}"));
        }
        if self.min.is_none() && self.max.is_none() {
            return None;
        }
        let Some(number) = value.as_f64() else { return Some(format!("is {value}, expected a number")) };
        // No number lies in a range that a NaN bounds.
        if let Some(min) = self.min.filter(|min| !(*min..).contains(&number)) {
            return Some(format!("is {number:e}, expected {min:e} or more"));
        }
        self.max
            .filter(|max| !(..=*max).contains(&number))
            .map(|max| format!("is {number:e}, expected {max:e} or less"))
    }
}
