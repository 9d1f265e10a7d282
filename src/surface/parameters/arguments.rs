use super::{Parameter, ParameterError, Values, synopsis};

/// The value of a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Value {
    Whole(u64),
    Real(f64),
    Choice(&'static str),
}

/// The parameters of a named item, each with a value in its range.
#[derive(Clone, Debug, PartialEq)]
pub struct Arguments {
    subject: &'static str,
    values: Vec<(Parameter, Value)>,
}

impl Arguments {
    /// Reads `query`, which is empty or `parameter=value&…`; parameters that are not given get
    /// their defaults.
    ///
    /// # Errors
    /// Unknown or repeated parameters; values that are malformed, out of range, or without effect.
    /// The messages begin with `subject`, the name before the `?`.
    pub fn parse<'a>(
        subject: &'static str,
        declared: impl IntoIterator<Item = &'a Parameter>,
        query: &str,
    ) -> Result<Self, ParameterError> {
        let declared: Vec<Parameter> = declared.into_iter().copied().collect();
        let mut given: Vec<Option<&str>> = vec![None; declared.len()];
        for pair in query.split('&').filter(|_| !query.is_empty()) {
            let (name, value) = pair.split_once('=').ok_or_else(|| ParameterError::NotAPair {
                subject,
                text: pair.to_string(),
                known: synopsis(&declared),
            })?;
            let position = declared.iter().position(|p| p.name == name).ok_or_else(|| {
                ParameterError::UnknownParameter { subject, parameter: name.to_string(), known: synopsis(&declared) }
            })?;
            if given[position].replace(value).is_some() {
                return Err(ParameterError::Repeated { subject, parameter: declared[position].name });
            }
        }
        let mut arguments = Arguments { subject, values: Vec::with_capacity(declared.len()) };
        for (parameter, given) in declared.iter().zip(&given) {
            let value = match given {
                Some(text) => read(subject, parameter, text)?,
                None => default(&parameter.values),
            };
            arguments.values.push((*parameter, value));
        }
        for (parameter, _) in declared.iter().zip(&given).filter(|(_, given)| given.is_some()) {
            if let Some((condition, value)) = arguments.obstacle(parameter) {
                let needed = parameter.only_with.map(|(_, needed)| needed.join(" or ")).unwrap_or_default();
                return Err(ParameterError::NoEffect { subject, parameter: parameter.name, condition, value, needed });
            }
        }
        Ok(arguments)
    }

    /// Returns the default of every parameter.
    pub fn defaults<'a>(subject: &'static str, declared: impl IntoIterator<Item = &'a Parameter>) -> Self {
        Arguments { subject, values: declared.into_iter().map(|p| (*p, default(&p.values))).collect() }
    }

    /// Returns the value of a parameter declared as a whole number.
    ///
    /// # Errors
    /// [`ParameterError::Undeclared`].
    pub fn whole(&self, name: &'static str) -> Result<u64, ParameterError> {
        match self.find(name)? {
            Value::Whole(x) => Ok(x),
            _ => Err(self.undeclared(name)),
        }
    }

    /// Returns the value of a parameter declared as a real number.
    ///
    /// # Errors
    /// [`ParameterError::Undeclared`].
    pub fn real(&self, name: &'static str) -> Result<f64, ParameterError> {
        match self.find(name)? {
            Value::Real(x) => Ok(x),
            _ => Err(self.undeclared(name)),
        }
    }

    /// Returns the value of a parameter declared as a choice.
    ///
    /// # Errors
    /// [`ParameterError::Undeclared`].
    pub fn choice(&self, name: &'static str) -> Result<&'static str, ParameterError> {
        match self.find(name)? {
            Value::Choice(x) => Ok(x),
            _ => Err(self.undeclared(name)),
        }
    }

    /// Returns the error for a value that is excluded by another parameter.
    pub fn out_of_range<E: From<ParameterError>>(
        &self,
        parameter: &'static str,
        circumstance: String,
        range: String,
    ) -> E {
        let value = self.find(parameter).map(text).unwrap_or_default();
        ParameterError::OutOfRange { subject: self.subject, parameter, value, circumstance, range }.into()
    }

    /// The canonical name, in which every parameter that has an effect is spelled out.
    pub fn canonical(&self) -> String {
        let effective = self.values.iter().filter(|(p, _)| self.obstacle(p).is_none());
        let pairs: Vec<String> = effective.map(|(p, value)| format!("{}={}", p.name, text(*value))).collect();
        if pairs.is_empty() { self.subject.to_string() } else { format!("{}?{}", self.subject, pairs.join("&")) }
    }

    fn find(&self, name: &'static str) -> Result<Value, ParameterError> {
        let found = self.values.iter().find(|(p, _)| p.name == name);
        found.map(|&(_, value)| value).ok_or_else(|| self.undeclared(name))
    }

    fn undeclared(&self, parameter: &'static str) -> ParameterError {
        ParameterError::Undeclared { subject: self.subject, parameter }
    }

    /// If parameter `p` has no effect, returns the parameter that is responsible and its value.
    fn obstacle(&self, p: &Parameter) -> Option<(&'static str, String)> {
        let (condition, needed) = p.only_with?;
        let value = self.find(condition).map(text).unwrap_or_default();
        (!needed.contains(&value.as_str())).then_some((condition, value))
    }
}

fn text(value: Value) -> String {
    match value {
        Value::Whole(x) => x.to_string(),
        Value::Real(x) => x.to_string(),
        Value::Choice(x) => x.to_string(),
    }
}

fn default(values: &Values) -> Value {
    match *values {
        Values::Whole { default, .. } => Value::Whole(default),
        Values::Real { default, .. } => Value::Real(default),
        Values::Choice(words) => Value::Choice(words.first().copied().unwrap_or_default()),
    }
}

fn read(subject: &'static str, parameter: &Parameter, value: &str) -> Result<Value, ParameterError> {
    let malformed = |expected| ParameterError::Malformed {
        subject,
        parameter: parameter.name,
        value: value.to_string(),
        expected,
        range: parameter.values.to_string(),
    };
    let read = match parameter.values {
        Values::Whole { min, max, .. } => {
            // Digits that overflow are a number that is too large, not a malformed number.
            let digits = !value.is_empty() && value.bytes().all(|b| b.is_ascii_digit());
            let x = value.parse::<u64>().ok();
            if !digits {
                return Err(malformed("whole number"));
            }
            x.filter(|x| (min..=max).contains(x)).map(Value::Whole)
        }
        Values::Real { min, max, .. } => {
            let x: f64 = value.parse().map_err(|_| malformed("number"))?;
            // + 0.0 turns a negative zero, which would show in the canonical name, into zero.
            (min..=max).contains(&x).then_some(Value::Real(x + 0.0))
        }
        Values::Choice(words) => words.iter().find(|&&w| w == value).map(|&w| Value::Choice(w)),
    };
    read.ok_or_else(|| ParameterError::OutOfRange {
        subject,
        parameter: parameter.name,
        value: value.to_string(),
        circumstance: String::new(),
        range: parameter.values.to_string(),
    })
}
