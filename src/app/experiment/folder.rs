use std::path::Path;

use toml::Spanned;
use toml::de::DeValue;

use super::ConfigError;
use super::document::{Document, SweptKey};
use crate::io::Format;

/// The swept key that a folder of meshes sets.
const SWEPT: &str = "surface.source";

/// `folder = "…"`: sweeps over the mesh files of that folder, sorted by name, instead of the given
/// sources. Subfolders are not read.
pub(super) fn sweep_over_folder<'a>(document: &Document<'a>, sweep: &mut Vec<SweptKey<'a>>) -> Result<(), ConfigError> {
    let Some(folder) = document.optional::<String>("folder")? else { return Ok(()) };
    let span = document.span("folder");
    let refused = |reason| ConfigError::Folder { place: document.place(span.clone()), folder: folder.clone(), reason };
    let entries = Path::new(&folder).read_dir().map_err(|error| refused(error.to_string()))?;
    let paths = entries.flatten().map(|entry| entry.path()).filter(|path| path.is_file());
    let mut sources: Vec<String> =
        paths.filter(|path| Format::of(path).is_some()).filter_map(|path| Some(path.to_str()?.to_owned())).collect();
    sources.sort();
    if sources.is_empty() {
        return Err(refused(format!("it has no mesh files ({})", Format::known())));
    }
    let usual = sources.len();
    let values = sources.into_iter().map(|source| Spanned::new(span.clone(), DeValue::String(source.into())));
    let axis =
        SweptKey { key: SWEPT.to_owned(), values: values.collect(), usual, names: Vec::new(), span: span.clone() };
    match sweep.iter_mut().find(|axis| axis.key == SWEPT) {
        Some(swept) => *swept = axis,
        None => sweep.insert(0, axis),
    }
    Ok(())
}
