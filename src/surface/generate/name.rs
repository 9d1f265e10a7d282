use super::{Arguments, GenerateError, Parameter, SurfaceKind};
use crate::surface::parameters::synopsis;

/// Finds the kind in `table` and reads the parameters of `kind?parameter=value&…`.
pub(super) fn parse<'a>(table: &'a [SurfaceKind], source: &str) -> Result<(&'a SurfaceKind, Arguments), GenerateError> {
    let (kind, query) = source.split_once('?').unwrap_or((source, ""));
    let row = table.iter().find(|row| row.name == kind).ok_or_else(|| {
        let known: Vec<&str> = table.iter().map(|row| row.name).collect();
        GenerateError::UnknownSurface { name: kind.to_string(), known: known.join(", ") }
    })?;
    Ok((row, Arguments::parse(row.name, row.all_parameters(), query)?))
}

impl SurfaceKind {
    /// Iterates over all parameters in order.
    pub fn all_parameters(&self) -> impl Iterator<Item = &'static Parameter> {
        self.parameters.iter().flat_map(|group| group.iter())
    }

    /// The parameters with their defaults, in the form used after the `?`.
    pub fn synopsis(&self) -> String {
        synopsis(self.all_parameters())
    }
}
