//! A folder of its own and the program run in it.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;
use std::process::{Command, Stdio};

use tempfile::TempDir;

/// The boundary of a linear map.
pub const FIXED: [&str; 2] = ["--boundary", "fixed"];

pub struct Shell {
    folder: TempDir,
}

/// What a run left behind.
pub struct Ran {
    pub code: i32,
    pub out: String,
    pub err: String,
}

impl Shell {
    pub fn new() -> Self {
        Shell { folder: tempfile::tempdir().unwrap() }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.path(name), content).unwrap();
    }

    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_riemap"));
        command.args(arguments).current_dir(self.folder.path()).stdin(Stdio::null()).env_remove("RUST_BACKTRACE");
        command
    }

    /// Runs the program, which never panics and ends with one of the documented exit codes.
    pub fn run(&self, arguments: &[&str]) -> Ran {
        let output = self.command(arguments).output().unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        let ran = Ran { code: output.status.code().unwrap_or(-1), out: text(output.stdout), err: text(output.stderr) };
        assert!((0..=3).contains(&ran.code) && !ran.err.contains("panicked"), "{arguments:?}: {}", ran.err);
        ran
    }

    /// What a run prints that must do what is asked.
    pub fn done(&self, arguments: &[&str]) -> String {
        let ran = self.run(arguments);
        assert_eq!(ran.code, 0, "{arguments:?}: {}", ran.err);
        ran.out
    }

    /// The one message of a run that must fail, and must leave the folder as it was.
    pub fn refused(&self, arguments: &[&str]) -> String {
        let before = self.files();
        let ran = self.run(arguments);
        assert_eq!(ran.code, 1, "{arguments:?} did not fail: {}{}", ran.out, ran.err);
        assert_eq!(ran.out, "", "{arguments:?}");
        let message = ran.err.strip_prefix("riemap: error: ").unwrap_or_else(|| panic!("{arguments:?}: {}", ran.err));
        assert!(!message.contains("riemap: ") && message.trim().len() > 10, "{arguments:?}: {message}");
        assert!(self.files() == before, "{arguments:?} left something behind");
        message.trim().to_owned()
    }

    /// Names and contents of all files, hidden ones too.
    pub fn files(&self) -> BTreeMap<PathBuf, Option<Vec<u8>>> {
        let entries = fs::read_dir(self.folder.path()).unwrap().map(|entry| entry.unwrap().path());
        entries.map(|path| (path.clone(), path.is_file().then(|| fs::read(path).unwrap()))).collect()
    }

    /// The map of `mesh` with `options`, its boundary fixed unless these say otherwise: texture coordinates by vertex, as
    /// written to OBJ.
    pub fn uv(&self, mesh: &str, options: &[&str]) -> Vec<[f64; 2]> {
        let boundary = if options.contains(&"--boundary") { &[][..] } else { &FIXED };
        self.done(&[&["map", mesh, "--quiet", "-o", "uv of a run.obj"], boundary, options].concat());
        texture(&self.read("uv of a run.obj"))
    }
}

/// The `vt` lines of an OBJ file.
pub fn texture(obj: &str) -> Vec<[f64; 2]> {
    numbers(obj, "vt ").map(|v| [v[0], v[1]]).collect()
}

/// The numbers of the lines that begin with `key`.
pub fn numbers<'a>(text: &'a str, key: &'a str) -> impl Iterator<Item = Vec<f64>> + 'a {
    let lines = text.lines().filter_map(move |line| line.strip_prefix(key));
    lines.map(|rest| rest.split_whitespace().map(|word| word.parse().unwrap()).collect())
}

/// max |a − b|, NaN if one is.
pub fn distance(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    assert_eq!(a.len(), b.len());
    let each = a.iter().zip(b).map(|(p, q)| (p[0] - q[0]).hypot(p[1] - q[1]));
    each.fold(0.0, |worst: f64, d| if d.is_nan() || d > worst { d } else { worst })
}

/// n × n vertices over a bumpy square, triangles or quads, scaled.
pub fn hill(n: usize, scale: f64, quads: bool) -> String {
    let mut text = String::new();
    for i in 0..n {
        for j in 0..n {
            let (x, y) = (i as f64 + 0.1 * ((i * j) % 3) as f64, j as f64 + 0.1 * ((i + j) % 2) as f64);
            let z = 0.3 * (x * 0.9).sin() * (y * 0.7).cos();
            text += &format!("v {:?} {:?} {:?}\n", scale * x, scale * y, scale * z);
        }
    }
    for i in 0..n - 1 {
        for j in 0..n - 1 {
            let (a, b) = (i * n + j + 1, (i + 1) * n + j + 1);
            text += &if quads {
                format!("f {a} {b} {} {}\n", b + 1, a + 1)
            } else {
                format!("f {a} {b} {}\nf {a} {} {}\n", b + 1, b + 1, a + 1)
            };
        }
    }
    text
}
