use super::{GenerateError, Parameter, Row, Values};

/// The value of a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Value {
    Whole(u64),
    Real(f64),
    Choice(&'static str),
}

/// The parameters of one surface, all with a value within their range.
#[derive(Clone, Debug, PartialEq)]
pub struct Arguments {
    surface: &'static str,
    values: Vec<(Parameter, Value)>,
}

impl Arguments {
    /// A parameter declared as a whole number.
    ///
    /// # Errors
    /// [`GenerateError::Undeclared`].
    pub fn whole(&self, name: &'static str) -> Result<u64, GenerateError> {
        match self.find(name)? {
            Value::Whole(x) => Ok(x),
            _ => Err(self.undeclared(name)),
        }
    }

    /// A parameter declared as a real number.
    ///
    /// # Errors
    /// [`GenerateError::Undeclared`].
    pub fn real(&self, name: &'static str) -> Result<f64, GenerateError> {
        match self.find(name)? {
            Value::Real(x) => Ok(x),
            _ => Err(self.undeclared(name)),
        }
    }

    /// A parameter declared as a choice.
    ///
    /// # Errors
    /// [`GenerateError::Undeclared`].
    pub fn choice(&self, name: &'static str) -> Result<&'static str, GenerateError> {
        match self.find(name)? {
            Value::Choice(x) => Ok(x),
            _ => Err(self.undeclared(name)),
        }
    }

    /// The error for a value that another parameter forbids.
    pub fn out_of_range(&self, parameter: &'static str, circumstance: String, range: String) -> GenerateError {
        let value = self.find(parameter).map(text).unwrap_or_default();
        GenerateError::OutOfRange { surface: self.surface, parameter, value, circumstance, range }
    }

    /// The name with every parameter that has an effect spelled out.
    pub(super) fn canonical(&self, row: &Row) -> String {
        let effective = self.values.iter().filter(|(p, _)| self.obstacle(p).is_none());
        let pairs: Vec<String> = effective.map(|(p, value)| format!("{}={}", p.name, text(*value))).collect();
        if pairs.is_empty() { row.name.to_string() } else { format!("{}?{}", row.name, pairs.join("&")) }
    }

    fn find(&self, name: &'static str) -> Result<Value, GenerateError> {
        let found = self.values.iter().find(|(p, _)| p.name == name);
        found.map(|&(_, value)| value).ok_or_else(|| self.undeclared(name))
    }

    fn undeclared(&self, parameter: &'static str) -> GenerateError {
        GenerateError::Undeclared { surface: self.surface, parameter }
    }

    /// What keeps parameter `p` from having an effect: the parameter that decides and its value.
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

/// Finds the kind and reads the parameters of `kind?parameter=value&…`.
pub(super) fn parse<'a>(table: &'a [Row], source: &str) -> Result<(&'a Row, Arguments), GenerateError> {
    let (kind, query) = source.split_once('?').unwrap_or((source, ""));
    let row = table.iter().find(|row| row.name == kind).ok_or_else(|| {
        let known: Vec<&str> = table.iter().map(|row| row.name).collect();
        GenerateError::UnknownSurface { name: kind.to_string(), known: known.join(", ") }
    })?;
    let declared: Vec<Parameter> = row.all_parameters().copied().collect();
    let mut given: Vec<Option<&str>> = vec![None; declared.len()];
    for pair in query.split('&').filter(|_| !query.is_empty()) {
        let (name, value) = pair.split_once('=').ok_or_else(|| GenerateError::NotAPair {
            surface: row.name,
            text: pair.to_string(),
            known: row.synopsis(),
        })?;
        let position = declared.iter().position(|p| p.name == name).ok_or_else(|| GenerateError::UnknownParameter {
            surface: row.name,
            parameter: name.to_string(),
            known: row.synopsis(),
        })?;
        if given[position].replace(value).is_some() {
            return Err(GenerateError::Repeated { surface: row.name, parameter: declared[position].name });
        }
    }
    let mut arguments = Arguments { surface: row.name, values: Vec::with_capacity(declared.len()) };
    for (parameter, given) in declared.iter().zip(&given) {
        let value = match given {
            Some(text) => read(row, parameter, text)?,
            None => default(&parameter.values),
        };
        arguments.values.push((*parameter, value));
    }
    for (parameter, _) in declared.iter().zip(&given).filter(|(_, given)| given.is_some()) {
        if let Some((condition, value)) = arguments.obstacle(parameter) {
            let needed = parameter.only_with.map(|(_, needed)| needed.join(" or ")).unwrap_or_default();
            let (surface, parameter) = (row.name, parameter.name);
            return Err(GenerateError::NoEffect { surface, parameter, condition, value, needed });
        }
    }
    Ok((row, arguments))
}

fn default(values: &Values) -> Value {
    match *values {
        Values::Whole { default, .. } => Value::Whole(default),
        Values::Real { default, .. } => Value::Real(default),
        Values::Choice(words) => Value::Choice(words.first().copied().unwrap_or_default()),
    }
}

fn read(row: &Row, parameter: &Parameter, value: &str) -> Result<Value, GenerateError> {
    let malformed = |expected| GenerateError::Malformed {
        surface: row.name,
        parameter: parameter.name,
        value: value.to_string(),
        expected,
        range: parameter.values.to_string(),
    };
    let read = match parameter.values {
        Values::Whole { min, max, .. } => {
            // digits that overflow are a number too large, not a malformed one
            let digits = !value.is_empty() && value.bytes().all(|b| b.is_ascii_digit());
            let x = value.parse::<u64>().ok();
            if !digits {
                return Err(malformed("whole number"));
            }
            x.filter(|x| (min..=max).contains(x)).map(Value::Whole)
        }
        Values::Real { min, max, .. } => {
            let x: f64 = value.parse().map_err(|_| malformed("number"))?;
            // + 0.0: a negative zero would show in the canonical name
            (min..=max).contains(&x).then_some(Value::Real(x + 0.0))
        }
        Values::Choice(words) => words.iter().find(|&&w| w == value).map(|&w| Value::Choice(w)),
    };
    read.ok_or_else(|| GenerateError::OutOfRange {
        surface: row.name,
        parameter: parameter.name,
        value: value.to_string(),
        circumstance: String::new(),
        range: parameter.values.to_string(),
    })
}

impl Row {
    /// All parameters in order.
    pub fn all_parameters(&self) -> impl Iterator<Item = &'static Parameter> {
        self.parameters.iter().flat_map(|group| group.iter())
    }

    /// The parameters with their defaults, as they would stand behind the `?`.
    pub fn synopsis(&self) -> String {
        let pairs: Vec<String> =
            self.all_parameters().map(|p| format!("{}={}", p.name, p.values.default_text())).collect();
        pairs.join("&")
    }
}
