//! libigl in its own environment: it answers what it should, and what fails says why.
//!
//! The first tests need the environment, which is made on the first run (network) and kept in the user's cache folder.

use riemap::app::compare::libigl::{Environment, LibiglError, Settings, harmonic};
use std::path::Path;

/// A triangulated n × n grid in the plane, inner vertices displaced by up to 0.24 cells (many obtuse angles; below
/// a quarter no triangle turns over), and the indices of its boundary.
struct Grid {
    plane: Vec<[f64; 2]>,
    triangles: Vec<[u32; 3]>,
    boundary: Vec<u32>,
}

fn grid(n: usize) -> Grid {
    let mut state = 1_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    let (mut plane, mut triangles, mut boundary) = (Vec::new(), Vec::new(), Vec::new());
    for i in 0..n {
        for j in 0..n {
            let v = (i * n + j) as u32;
            let inner = (1..n - 1).contains(&i) && (1..n - 1).contains(&j);
            let [dx, dy] = if inner { [0.48 * random(), 0.48 * random()] } else { [0.0; 2] };
            plane.push([i as f64 + dx, j as f64 + dy]);
            if !inner {
                boundary.push(v);
            }
            if i + 1 < n && j + 1 < n {
                let m = n as u32;
                triangles.extend([[v, v + m, v + m + 1], [v, v + m + 1, v + 1]]);
            }
        }
    }
    Grid { plane, triangles, boundary }
}

fn values(at: &[[f64; 2]], vertices: &[u32]) -> Vec<[f64; 2]> {
    vertices.iter().map(|&v| at[v as usize]).collect()
}

/// Cotangent of the angle at `a`.
fn cotangent(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
    let [u, v] = [b, c].map(|p| [p[0] - a[0], p[1] - a[1], p[2] - a[2]]);
    let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    (u[0] * v[0] + u[1] * v[1] + u[2] * v[2]) / cross.iter().map(|x| x * x).sum::<f64>().sqrt()
}

#[test]
fn linear_functions_are_reproduced_on_planar_meshes() {
    let environment = Environment::ensure().unwrap();
    let grid = grid(20);
    // The plane through the origin spanned by two orthonormal vectors.
    let (e, f) = ([0.6, 0.0, 0.8], [0.0, 1.0, 0.0]);
    let space: Vec<_> = grid.plane.iter().map(|p| [0, 1, 2].map(|k| p[0] * e[k] + p[1] * f[k])).collect();
    let fixed = values(&grid.plane, &grid.boundary);
    let map = harmonic(&environment, &space, &grid.triangles, &grid.boundary, &fixed).unwrap();

    for (uv, p) in map.uv.iter().zip(&grid.plane) {
        // Rounding of a well-conditioned system of 324 unknowns with values up to 19.
        assert!((uv[0] - p[0]).abs() < 1e-12 && (uv[1] - p[1]).abs() < 1e-12, "{uv:?} {p:?}");
    }
    for (&v, value) in grid.boundary.iter().zip(&fixed) {
        assert_eq!(map.uv[v as usize], *value);
    }
    assert_eq!(map.version, riemap::app::compare::libigl::VERSION);
    assert!(map.seconds_cpu >= 0.0 && map.seconds_cpu < 10.0 && map.seconds_wall > 0.0);
}

#[test]
fn the_map_is_harmonic_for_the_cotangent_weights_and_negative_ones_are_counted() {
    let environment = Environment::ensure().unwrap();
    let grid = grid(15);
    let space: Vec<_> = grid.plane.iter().map(|p| [p[0], p[1], (p[0] * 1.3).sin() + (p[1] * 0.7).cos()]).collect();
    let fixed = values(&grid.plane, &grid.boundary);
    let map = harmonic(&environment, &space, &grid.triangles, &grid.boundary, &fixed).unwrap();

    let mut weights = std::collections::BTreeMap::<(u32, u32), (f64, usize)>::new();
    for &[a, b, c] in &grid.triangles {
        for [i, j, k] in [[a, b, c], [b, c, a], [c, a, b]] {
            let entry = weights.entry((i.min(j), i.max(j))).or_default();
            entry.0 += 0.5 * cotangent(space[k as usize], space[i as usize], space[j as usize]);
            entry.1 += 1;
        }
    }
    let mut sums = vec![[0.0; 2]; space.len()];
    for (&(i, j), &(w, _)) in &weights {
        let [from, to] = [i, j].map(|v| map.uv[v as usize]);
        let flow = [w * (to[0] - from[0]), w * (to[1] - from[1])];
        for (v, sign) in [(i, 1.0), (j, -1.0)] {
            let sum: &mut [f64; 2] = &mut sums[v as usize];
            *sum = [sum[0] + sign * flow[0], sum[1] + sign * flow[1]];
        }
    }
    for &v in &grid.boundary {
        sums[v as usize] = [0.0; 2];
    }
    // Sums of some six terms, each at most 10 × 20, of which rounding leaves 1e-16.
    assert!(sums.as_flattened().iter().all(|s| s.abs() < 1e-11), "{sums:?}");
    let interior: Vec<f64> = weights.values().filter(|(_, count)| *count == 2).map(|(w, _)| *w).collect();
    assert_eq!(map.interior_edges, interior.len());
    assert_eq!(map.negative_weights, interior.iter().filter(|w| **w < -1e-12).count());
    assert!(map.negative_weights > 0);
}

#[test]
fn a_large_mesh_is_handed_over_whole() {
    let environment = Environment::ensure().unwrap();
    let grid = grid(200);
    let space: Vec<_> = grid.plane.iter().map(|p| [p[0], p[1], 0.0]).collect();
    let fixed = values(&grid.plane, &grid.boundary);
    let map = harmonic(&environment, &space, &grid.triangles, &grid.boundary, &fixed).unwrap();
    let worst = map.uv.as_flattened().iter().zip(grid.plane.as_flattened()).map(|(a, b)| (a - b).abs());
    // Relative to the extent of 199, for weights whose condition number is about 1e5.
    assert!(worst.fold(0.0, f64::max) < 1e-9);
}

#[test]
fn input_that_libigl_would_crash_on_is_refused_with_its_place() {
    let environment = Environment::ensure().unwrap();
    let space = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [3.0, 3.0, 3.0]];
    let refuse = |positions: &[[f64; 3]], triangles: &[[u32; 3]], fixed: &[u32]| {
        let values: Vec<_> = fixed.iter().map(|&v| [f64::from(v), 0.0]).collect();
        harmonic(&environment, positions, triangles, fixed, &values).unwrap_err()
    };
    use LibiglError::{FixedIndex, FixedTwice, NotFinite, TriangleIndex, Undetermined};
    assert!(matches!(refuse(&space, &[[0, 1, 4]], &[0]), TriangleIndex { triangle: 0, vertex: 4, count: 4 }));
    assert!(matches!(refuse(&space[..3], &[[0, 1, 2]], &[0, 3]), FixedIndex { vertex: 3, count: 3 }));
    assert!(matches!(refuse(&space[..3], &[[0, 1, 2]], &[0, 1, 0]), FixedTwice { vertex: 0 }));
    assert!(matches!(refuse(&space, &[[0, 1, 2]], &[0, 1]), Undetermined { vertex: 3 }));
    assert!(matches!(refuse(&[[f64::NAN; 3]; 3], &[[0, 1, 2]], &[0]), NotFinite { index: 0, .. }));
}

#[test]
fn an_interpreter_that_is_not_there_is_named() {
    let interpreter = Some("/nowhere/python".into());
    let settings = Settings { interpreter, ..Settings::in_folder(Path::new("unused")) };
    let message = Environment::with(&settings).unwrap_err().to_string();
    assert!(message.contains("/nowhere/python") && message.contains("$RIEMAP_PYTHON"), "{message}");
}

/// Environments made by a stand-in for Python, a shell script that writes down what it is asked.
#[cfg(unix)]
mod stand_in {
    use super::*;
    use std::fs;
    use std::path::PathBuf;
    use std::process::Command;
    use tempfile::TempDir;

    const SCRIPT: &str = r#"#!/bin/sh
case "$*" in
*"-m venv"*)
    echo venv >> LOG
    if [ -e FOLDER/no-venv ]; then echo "ensurepip is not available"; exit 1; fi
    for folder; do :; done
    mkdir -p "$folder/bin" && cp "$0" "$folder/bin/python" && sleep 0.2 ;;
*"-m pip"*)
    echo pip >> LOG
    if [ -e FOLDER/no-network ]; then echo "WARNING: Retrying" >&2; echo "ERROR: no libigl" >&2; exit 1; fi ;;
*importlib.metadata*)
    echo '{"python": "3.11.7", "libigl": "VERSION", "numpy": "2.4.6", "scipy": "1.17.1"}' ;;
*version_info*)
    if [ -e FOLDER/old ]; then echo 3.7.2; else echo 3.11.7; fi ;;
esac
"#;

    struct StandIn {
        folder: TempDir,
        settings: Settings,
    }

    fn stand_in() -> StandIn {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let script = SCRIPT
            .replace("LOG", path("log").to_str().unwrap())
            .replace("FOLDER", folder.path().to_str().unwrap())
            .replace("VERSION", riemap::app::compare::libigl::VERSION);
        fs::write(path("script"), script).unwrap();
        // By another process: a file this one has open for writing, or a child just forked has, cannot be executed.
        let copy = Command::new("install").args(["-m", "755"]).arg(path("script")).arg(path("python")).status();
        assert!(copy.unwrap().success());
        let settings = Settings { interpreter: None, folder: path("env"), maker: Some(path("python")) };
        StandIn { folder, settings }
    }

    impl StandIn {
        fn calls(&self) -> Vec<String> {
            let log = fs::read_to_string(self.folder.path().join("log")).unwrap_or_default();
            log.lines().map(str::to_string).collect()
        }

        fn set(&self, what: &str) -> PathBuf {
            let path = self.folder.path().join(what);
            fs::write(&path, "").unwrap();
            path
        }

        fn error(&self) -> String {
            Environment::with(&self.settings).unwrap_err().to_string()
        }
    }

    #[test]
    fn a_finished_environment_is_used_again() {
        let python = stand_in();
        assert!(!Environment::is_ready(&python.settings));
        let first = Environment::with(&python.settings).unwrap();
        let second = Environment::with(&python.settings).unwrap();
        assert!(Environment::is_ready(&python.settings));
        assert_eq!(first.python, second.python);
        assert!(first.python.starts_with(&python.settings.folder));
        assert_eq!(python.calls(), ["venv", "pip"]);
    }

    #[test]
    fn an_environment_for_other_requirements_is_made_anew() {
        let python = stand_in();
        Environment::with(&python.settings).unwrap();
        let leftover = python.settings.folder.join("lib");
        fs::write(&leftover, "of the old one").unwrap();
        fs::write(python.settings.folder.join("riemap-finished.txt"), "libigl==2.5.0\n").unwrap();
        Environment::with(&python.settings).unwrap();
        assert_eq!(python.calls(), ["venv", "pip", "venv", "pip"]);
        assert!(!leftover.exists());
    }

    #[test]
    fn an_environment_whose_python_is_gone_is_made_anew() {
        let python = stand_in();
        let environment = Environment::with(&python.settings).unwrap();
        fs::remove_file(environment.python).unwrap();
        Environment::with(&python.settings).unwrap();
        assert_eq!(python.calls(), ["venv", "pip", "venv", "pip"]);
    }

    #[test]
    fn without_a_network_the_message_says_what_failed_and_what_to_do_and_the_next_try_starts_over() {
        let python = stand_in();
        let switch = python.set("no-network");
        let message = python.error();
        for part in ["-m pip install", "exit status: 1", "ERROR: no libigl", "network", "$RIEMAP_PYTHON"] {
            assert!(message.contains(part), "{part} in {message}");
        }
        assert!(!Environment::is_ready(&python.settings));
        fs::remove_file(switch).unwrap();
        Environment::with(&python.settings).unwrap();
        assert_eq!(python.calls(), ["venv", "pip", "venv", "pip"]);
    }

    #[test]
    fn missing_venv_and_old_pythons_are_told_apart() {
        let python = stand_in();
        let switch = python.set("no-venv");
        assert!(python.error().contains("apt install python3-venv"), "{}", python.error());
        fs::remove_file(switch).unwrap();
        python.set("old");
        let message = python.error();
        assert!(message.contains("version 3.7.2") && message.contains("$PYTHON"), "{message}");
    }

    #[test]
    fn a_folder_of_someone_else_is_never_emptied() {
        let python = stand_in();
        fs::create_dir(&python.settings.folder).unwrap();
        let theirs = python.settings.folder.join("thesis.tex");
        fs::write(&theirs, "years of work").unwrap();
        assert!(matches!(Environment::with(&python.settings), Err(LibiglError::ForeignFolder { .. })));
        assert!(theirs.exists());
        assert!(python.calls().is_empty());
    }

    #[test]
    fn of_many_threads_one_makes_the_environment() {
        let python = stand_in();
        std::thread::scope(|scope| {
            let all: Vec<_> = (0..4).map(|_| scope.spawn(|| Environment::with(&python.settings))).collect();
            all.into_iter().for_each(|thread| assert!(thread.join().unwrap().is_ok()));
        });
        assert_eq!(python.calls(), ["venv", "pip"]);
    }

    /// The body of the processes of the next test.
    #[test]
    #[ignore = "run by of_many_processes_one_makes_the_environment"]
    fn ensure_in_a_process() {
        Environment::ensure().unwrap();
    }

    #[test]
    fn of_many_processes_one_makes_the_environment() {
        let python = stand_in();
        let body = ["--exact", "libigl_environment::stand_in::ensure_in_a_process", "--ignored"];
        let start = || {
            Command::new(std::env::current_exe().unwrap())
                .args(body)
                .env("RIEMAP_PYTHON_ENV", &python.settings.folder)
                .env("PYTHON", python.settings.maker.as_ref().unwrap())
                .env_remove("RIEMAP_PYTHON")
                .stdout(std::process::Stdio::null())
                .spawn()
                .unwrap()
        };
        let processes: Vec<_> = (0..3).map(|_| start()).collect();
        processes.into_iter().for_each(|mut process| assert!(process.wait().unwrap().success()));
        assert_eq!(python.calls(), ["venv", "pip"]);
    }
}
