use std::fmt;

/// A place in a config or in a `--set` argument.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Path of the config; `--set key=value`.
    pub source: String,
    /// Line, from 1; `None` for what was given with `--set`.
    pub line: Option<usize>,
    /// The text of that line.
    pub text: String,
    /// First character of the offender in `text`, from 0.
    pub column: usize,
    /// Its length in characters; at least 1.
    pub width: usize,
}

/// `file:line`.
impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "{}:{line}", self.source),
            None => f.write_str(&self.source),
        }
    }
}

impl Place {
    /// The line with carets below the offender.
    pub(super) fn excerpt(&self) -> String {
        let number = self.line.map(|line| line.to_string()).unwrap_or_default();
        let (gutter, shift) = (number.len(), self.column);
        format!("{number} | {}\n{:gutter$} | {:shift$}{}", self.text, "", "", "^".repeat(self.width))
    }
}
