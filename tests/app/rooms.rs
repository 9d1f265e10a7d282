//! The modules of the library stand in one order, and each imports only what stands before it.

use std::fs;
use std::path::{Path, PathBuf};

/// From the ground up.
const ROOMS: [&str; 16] = [
    "geometry",
    "sparse",
    "surface",
    "io",
    "input",
    "quad_graph",
    "laplacian",
    "energy",
    "constraint",
    "distortion",
    "problem",
    "solver",
    "map",
    "report",
    "figure",
    "app",
];

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        match path.is_dir() {
            true => files(&path, found),
            false if path.extension().is_some_and(|e| e == "rs") => found.push(path),
            false => {}
        }
    }
}

/// The code of a file, without comments.
fn code(path: &Path) -> String {
    let text = fs::read_to_string(path).unwrap();
    text.lines().map(|line| line.split("//").next().unwrap_or("")).collect::<Vec<_>>().join("\n")
}

#[test]
fn no_module_imports_one_that_stands_above_it() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut found = Vec::new();
    files(&source, &mut found);
    let mut imports = 0;
    for path in found {
        let first = path.strip_prefix(&source).unwrap().components().next().unwrap();
        let name = Path::new(first.as_os_str()).file_stem().unwrap().to_str().unwrap().to_owned();
        let Some(rank) = ROOMS.iter().position(|room| *room == name) else {
            assert!(["lib", "main"].contains(&name.as_str()), "{} has no place in the order", path.display());
            continue;
        };
        for used in code(&path).split("crate::").skip(1) {
            let room: String = used.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
            if let Some(other) = ROOMS.iter().position(|r| *r == room) {
                imports += 1;
                assert!(other <= rank, "{} imports {room}, which stands above {name}", path.display());
            }
        }
    }
    assert!(imports > 500, "{imports} imports were found: this test reads the wrong folder");
}
