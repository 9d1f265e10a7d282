use super::interpreter::last_lines;
use super::{Environment, LibiglError};
use serde_json::{Map, Value, json};
use std::fs::File;
use std::io::{BufRead, BufReader, BufWriter, Read, Write};
use std::path::{Path, PathBuf};

const SCRIPT: &str = include_str!("calls.py");

/// The numbers of an array that is passed to libigl, row by row.
pub(super) enum Numbers<'a> {
    Real(&'a [f64]),
    Index(&'a [u32]),
}

/// A named array that is passed to libigl; a single column arrives as a vector.
pub(super) struct Array<'a> {
    pub name: &'static str,
    pub columns: usize,
    pub numbers: Numbers<'a>,
}

/// The answer of a function of `calls.py`.
#[derive(Debug)]
pub(super) struct Answer {
    function: &'static str,
    fields: Value,
    arrays: Vec<(String, usize, Vec<f64>)>,
}

/// Runs `function` of `calls.py` in its own process.
pub(super) fn call(
    environment: &Environment,
    function: &'static str,
    arrays: &[Array],
    options: Value,
) -> Result<Answer, LibiglError> {
    // Removed with all in it when it goes out of scope, also on errors.
    let folder = tempfile::Builder::new().prefix("riemap-libigl-").tempdir();
    let folder = folder.map_err(|source| at(&std::env::temp_dir())(source))?;
    let (request, answer) = (folder.path().join("request"), folder.path().join("answer"));
    write_request(&request, function, arrays, options).map_err(at(&request))?;

    let mut command = environment.command();
    // In an empty folder, as Python would import a module that happens to lie in the current one.
    let output = command.args(["-c", SCRIPT]).arg(&request).arg(&answer).current_dir(folder.path()).output();
    let failed = |status, lines| LibiglError::Call { function, python: environment.python.clone(), status, lines };
    let output = output.map_err(|error| failed("it did not start".to_string(), vec![error.to_string()]))?;
    if !output.status.success() {
        return Err(failed(output.status.to_string(), last_lines(&output)));
    }
    read_answer(&answer, function)
}

fn write_request(path: &Path, function: &str, arrays: &[Array], options: Value) -> std::io::Result<()> {
    let header = json!({
        "function": function,
        "options": options,
        "arrays": arrays.iter().map(Array::header).collect::<Vec<_>>(),
    });
    let mut file = BufWriter::new(File::create(path)?);
    writeln!(file, "{header}")?;
    for array in arrays {
        match array.numbers {
            Numbers::Real(numbers) => numbers.iter().try_for_each(|x| file.write_all(&x.to_le_bytes()))?,
            Numbers::Index(numbers) => numbers.iter().try_for_each(|i| file.write_all(&i.to_le_bytes()))?,
        }
    }
    file.flush()
}

fn read_answer(path: &Path, function: &'static str) -> Result<Answer, LibiglError> {
    let unreadable = |what: String| LibiglError::Answer { function, what };
    let mut file = BufReader::new(File::open(path).map_err(at(path))?);
    let mut line = Vec::new();
    file.read_until(b'\n', &mut line).map_err(at(path))?;
    let mut header: Map<String, Value> =
        serde_json::from_slice(&line).map_err(|error| unreadable(error.to_string()))?;
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes).map_err(at(path))?;

    let mut rest = bytes.as_slice();
    let mut arrays = Vec::new();
    for array in header.get("arrays").and_then(Value::as_array).map(Vec::as_slice).unwrap_or_default() {
        let name = array["name"].as_str().unwrap_or_default();
        let size = |field: &str| array[field].as_u64().and_then(|n| usize::try_from(n).ok()).unwrap_or_default();
        let columns = size("columns");
        let length = size("rows").saturating_mul(columns).saturating_mul(8);
        let Some((these, others)) = rest.split_at_checked(length) else {
            return Err(unreadable(format!("it ends within the array `{name}`")));
        };
        let numbers = these.as_chunks::<8>().0.iter().map(|&chunk| f64::from_le_bytes(chunk)).collect();
        arrays.push((name.to_string(), columns, numbers));
        rest = others;
    }
    Ok(Answer { function, fields: header.remove("fields").unwrap_or_default(), arrays })
}

impl Array<'_> {
    fn header(&self) -> Value {
        let (kind, length) = match self.numbers {
            Numbers::Real(numbers) => ("f8", numbers.len()),
            Numbers::Index(numbers) => ("u4", numbers.len()),
        };
        json!({"name": self.name, "type": kind, "columns": self.columns, "rows": length / self.columns})
    }
}

impl Answer {
    /// Returns the number in the field `name`.
    pub fn number(&self, name: &str) -> Result<f64, LibiglError> {
        self.fields[name].as_f64().ok_or_else(|| self.lacks("number", name))
    }

    /// Returns the count in the field `name`.
    pub fn count(&self, name: &str) -> Result<usize, LibiglError> {
        let count = self.fields[name].as_u64().and_then(|n| usize::try_from(n).ok());
        count.ok_or_else(|| self.lacks("count", name))
    }

    /// Returns the array `name`, `rows × N`.
    pub fn rows<const N: usize>(&self, name: &str, rows: usize) -> Result<Vec<[f64; N]>, LibiglError> {
        let found = self
            .arrays
            .iter()
            .find(|(n, columns, numbers)| n == name && *columns == N && numbers.len() == rows.saturating_mul(N));
        let (_, _, numbers) = found.ok_or_else(|| self.lacks(&format!("{rows} × {N} array"), name))?;
        Ok(numbers.as_chunks::<N>().0.to_vec())
    }

    fn lacks(&self, kind: &str, name: &str) -> LibiglError {
        LibiglError::Answer { function: self.function, what: format!("it has no {kind} `{name}`") }
    }
}

fn at(path: &Path) -> impl Fn(std::io::Error) -> LibiglError {
    let path: PathBuf = path.to_path_buf();
    move |source| LibiglError::Exchange { path: path.clone(), source }
}
