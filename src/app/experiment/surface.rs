use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::Value;

use super::{ConfigError, DataFile, Document, RunError};
use crate::input::{Input, InputOptions};
use crate::io::Sample;
use crate::surface::digital::Adjacency;

/// `[surface]`: the surface that is mapped.
#[derive(Clone, Debug)]
pub(super) struct SurfaceSpec {
    table: Table,
    data: Option<DataFile>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    /// A mesh file, `data:` with the name of a public file, or the name of a generated surface.
    source: String,
    /// Parameters of a generated surface beside those in its name, so that they can be swept.
    #[serde(default)]
    parameters: BTreeMap<String, Value>,
    /// Options of volume files, as in [`InputOptions`].
    threshold: Option<f64>,
    size: Option<[usize; 3]>,
    #[serde(rename = "type")]
    sample: Option<Sample>,
    adjacency: Option<Adjacency>,
    component: Option<usize>,
}

impl SurfaceSpec {
    /// Reads the table `[surface]` of a config.
    pub(super) fn of(config: &Document) -> Result<Self, ConfigError> {
        let table: Table = config.table("surface")?;
        let data = DataFile::find(&table.source, config.data_folders());
        Ok(SurfaceSpec { table, data })
    }

    /// Reads or generates the surface. A public file is named as in the config, wherever the file
    /// lies.
    pub(super) fn open(&self) -> Result<Input, RunError> {
        let Table { threshold, size, sample, adjacency, component, .. } = self.table;
        let options = InputOptions { threshold, size, sample, adjacency, component };
        let Some(data) = &self.data else { return Ok(Input::open_with(&self.name(&self.table.source), &options)?) };
        let path = data.path.as_ref().ok_or_else(|| RunError::NoData { file: data.clone() })?;
        let input = Input::open_with(&self.name(&path.to_string_lossy()), &options)?;
        Ok(Input { source: self.table.source.clone(), ..input })
    }

    fn name(&self, source: &str) -> String {
        let mut name = source.to_owned();
        for (parameter, value) in &self.table.parameters {
            name.push(if name.contains('?') { '&' } else { '?' });
            let value = value.as_str().map_or_else(|| value.to_string(), str::to_owned);
            name.push_str(&format!("{parameter}={value}"));
        }
        name
    }
}
