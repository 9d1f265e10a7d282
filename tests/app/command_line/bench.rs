//! `riemap bench`: with nobody else, with peers that fail, with none there.

use serde_json::Value;

use super::shell::Shell;

const SMALL: [&str; 6] = ["bench", "grid", "delaunay", "--sizes", "64,144", "--results"];

fn record(shell: &Shell, folder: &str) -> Value {
    serde_json::from_str(&shell.read(&format!("{folder}/bench/bench.json"))).unwrap()
}

fn entries(record: &Value) -> &Vec<Value> {
    record["record"]["entries"].as_array().unwrap()
}

#[test]
fn alone_it_measures_and_writes_tables_and_plots() {
    let shell = Shell::new();
    let out = shell.done(&[&SMALL[..], &["r", "--repeats", "2", "--no-peers"]].concat());
    assert!(out.contains("grid: 64 vertices, 49 faces") && out.contains("wrote r/bench/table.md"), "{out}");
    let record = record(&shell, "r");
    // Two cases, two sizes, four maps.
    assert_eq!(entries(&record).len(), 16);
    for entry in entries(&record) {
        assert_eq!((&entry["outcome"], entry["runs"].as_array().unwrap().len()), (&"done".into(), 2), "{entry}");
        assert!(entry["contestant"].as_str().unwrap().starts_with("riemap-") && entry["ratio"].is_null());
        for run in entry["runs"].as_array().unwrap() {
            let of = |path: &str| run.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("{path}: {run}"));
            let parts = of("/assembly/wall") + of("/factor/wall");
            assert!((parts - of("/solve/wall")).abs() < 1e-9, "{run}");
            // The solve is a part of the process. Its clock is read inside, to a microsecond.
            assert!(of("/solve/wall") > 0.0 && of("/solve/wall") < of("/whole/wall"), "{run}");
            if cfg!(target_os = "linux") {
                // Processor time is counted to some microseconds.
                assert!(of("/solve/cpu") > 0.0 && of("/solve/cpu") < of("/whole/cpu") + 1e-4, "{run}");
                assert!(of("/peak_bytes") > 1e6, "{run}");
            }
        }
        assert!(entry.pointer("/quality/quasi_conformal").and_then(Value::as_f64).unwrap() >= 1.0, "{entry}");
    }
    // No bar is of meshes as small as these.
    let bars = record["bars"].as_array().unwrap();
    assert!(bars.len() > 10 && bars.iter().all(|bar| bar["holds"].is_null()), "{bars:?}");
    assert_eq!(record["record"]["exchange"].as_array().unwrap().len(), 5);
    let (table, csv) = (shell.read("r/bench/table.md"), shell.read("r/bench/bench.csv"));
    assert!(table.contains("## delaunay: 144 vertices") && csv.lines().count() == 1 + 16);
    assert!(csv.lines().all(|line| line.split(',').count() == 21), "{csv}");
    for plot in ["solve", "memory"] {
        assert!(shell.read(&format!("r/bench/{plot}.svg")).contains("riemap-circle"));
    }
    // One size makes no line, and the plots of before would belong to another table.
    shell.done(&["bench", "grid", "--quick", "--sizes", "64", "--results", "r", "--no-peers"]);
    assert!(!shell.path("r/bench/solve.svg").exists() && !shell.path("r/bench/memory.svg").exists());
}

#[test]
fn a_quick_run_leaves_nothing_behind_unless_it_is_told_where() {
    let shell = Shell::new();
    let out = shell.done(&["bench", "grid", "--quick", "--sizes", "64", "--no-peers"]);
    assert!(out.contains("riemap-circle") && !out.contains("wrote"), "{out}");
    assert!(shell.files().is_empty());
}

#[test]
fn what_cannot_be_done_is_refused_before_anything_is_run() {
    let shell = Shell::new();
    shell.write("file", "");
    for (arguments, words) in [
        (&["bench", "frob"][..], &["`frob`", "grid", "delaunay"][..]),
        (&["bench", "--python", "/nowhere/python"], &["/nowhere/python", "--no-peers"]),
        (&["bench", "--python", "./file"], &["file cannot run"]),
        (&["bench", "--bff", "/nowhere/bff"], &["--bff /nowhere/bff"]),
        (&["bench", "split", "--sizes", "1000000", "--no-peers", "--results", "r"], &["split"]),
        (&["bench", "grid", "--sizes", "64", "--no-peers", "--results", "file"], &["file"]),
    ] {
        let message = shell.refused(arguments);
        assert!(words.iter().all(|word| message.contains(word)), "{arguments:?}: {message}");
    }
    for arguments in [
        &["--sizes", "x"][..],
        &["--repeats", "0"],
        &["--limit", "0"],
        &["--python", "a", "--no-peers"],
        &["--bff", "a", "--no-peers"],
    ] {
        assert_eq!(shell.run(&[&["bench"], arguments].concat()).code, 2, "{arguments:?}");
    }
}

/// A stand-in for Python: a shell script that has some packages and does `behaviour` with METHOD, MESH and MAP in $3 to $5.
#[cfg(unix)]
fn stand_in(shell: &Shell, packages: &str, behaviour: &str) {
    let versions = format!("if [ \"$3\" = versions ]; then echo '{{{packages}}}'; exit 0; fi");
    executable(shell, "python", &format!("{versions}\n{behaviour}"));
}

/// A shell script that can be executed.
#[cfg(unix)]
fn executable(shell: &Shell, name: &str, text: &str) {
    shell.write("script", format!("#!/bin/sh\n{text}\n"));
    // By another process: a file this one has open for writing, or a child just forked has, cannot be executed.
    let paths = ["script", name].map(|name| shell.path(name));
    let copy = std::process::Command::new("install").args(["-m", "755"]).args(paths).status();
    assert!(copy.unwrap().success());
}

#[cfg(unix)]
#[test]
fn peers_that_fail_are_named_with_their_last_words_and_the_others_go_on() {
    let shell = Shell::new();
    // LSCM takes for ever; SLIM's map has no end; ARAP has none; the harmonic map is a good one, of all vertices at (1, 1) but the first two.
    let behaviour = r#"case "$3" in
libigl-harmonic) vertices=$(grep -c '^v ' "$4")
    { printf '\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0'; k=1; while [ $k -lt $vertices ]; do
        printf '\0\0\0\0\0\0\360?\0\0\0\0\0\0\360?'; k=$((k+1)); done; } > "$5"
    echo '{"solve": {"wall": 2.0, "cpu": 1.0}, "peak_bytes": 5000000000}' ;;
libigl-lscm) exec sleep 60 ;;
libigl-slim) printf 'half' > "$5"; echo '{"solve": {"wall": 2.0, "cpu": 1.0}}' ;;
libigl-arap) echo '{"solve": {"wall": 2.0, "cpu": 1.0}}' ;;
meshlab-lscm) echo 'nothing useful' ;;
*) echo "something broke" >&2; exit 3 ;;
esac"#;
    stand_in(&shell, r#""libigl": "9.9", "pymeshlab": "0.0""#, behaviour);
    let arguments = ["bench", "grid", "--sizes", "64", "--repeats", "1", "--limit", "1", "--results", "r"];
    shell.done(&[&arguments[..], &["--python", "./python"]].concat());
    let record = record(&shell, "r");
    let of = |name: &str| entries(&record).iter().find(|entry| entry["contestant"] == name).unwrap();
    for (name, outcome, words) in [
        ("riemap-circle", "done", ""),
        ("libigl-harmonic", "done", ""),
        ("libigl-lscm", "over-the-limit", ""),
        ("meshlab-harmonic", "failed", "something broke"),
        ("meshlab-lscm", "failed", "nothing useful"),
        ("libigl-slim", "failed", "4 bytes"),
        // The map of whoever was before is not its own.
        ("libigl-arap", "failed", "left no map"),
        ("cholmod-harmonic", "left-out", ""),
        ("bff-disc", "left-out", ""),
        ("bff-free", "left-out", ""),
    ] {
        assert_eq!(of(name)["outcome"], outcome, "{}", of(name));
        assert!(of(name)["reason"].as_str().unwrap_or_default().contains(words), "{}", of(name));
    }
    assert_eq!(of("libigl-harmonic").pointer("/median/peak_bytes"), Some(&5_000_000_000u64.into()));
    assert_eq!(of("cholmod-harmonic")["lacks"], "scikit-sparse");
    assert_eq!(of("bff-free")["lacks"], "bff-command-line");
    if cfg!(target_os = "linux") {
        let ours = of("riemap-circle").pointer("/median/solve/cpu").unwrap();
        // The peer said that it took one second.
        assert_eq!(&of("libigl-harmonic")["ratio"], ours);
    }
    let table = shell.read("r/bench/table.md");
    for words in ["libsuitesparse-dev", "something broke", "over the limit of 1 s"] {
        assert!(table.contains(words), "{words}: {table}");
    }
}

/// A stand-in for the program of Boundary First Flattening, called as it is, which writes what it writes: the mesh with a texture
/// coordinate for every vertex. The map is the mesh seen from below, a mirror image.
#[cfg(unix)]
const BFF: &str = r#"[ $# -le 3 ] || exit 4
[ "${3:---flattenToDisk}" = --flattenToDisk ] || exit 5
awk '$1 == "v" { print; t[++n] = $2 " " (-$3) } $1 == "f" { f[++m] = $2 "/" $2 " " $3 "/" $3 " " $4 "/" $4 }
END { for (k = 1; k <= n; k++) print "vt", t[k]; for (k = 1; k <= m; k++) print "f", f[k] }' "$1" > "$2""#;

#[cfg(unix)]
#[test]
fn the_program_of_bff_is_measured_as_a_whole_and_its_map_read_from_its_obj() {
    let shell = Shell::new();
    stand_in(&shell, "", "exit 1");
    executable(&shell, "bff", BFF);
    let arguments = [
        "bench",
        "grid",
        "--sizes",
        "64",
        "--repeats",
        "1",
        "--results",
        "r",
        "--python",
        "./python",
        "--bff",
        "./bff",
    ];
    shell.done(&arguments);
    let measured = record(&shell, "r");
    let of = |name: &str, path: &str| {
        let entry = entries(&measured).iter().find(|entry| entry["contestant"] == name).unwrap();
        entry.pointer(path).cloned().unwrap_or_else(|| panic!("{path}: {entry}"))
    };
    for (name, ours) in [("bff-disc", "riemap-circle"), ("bff-free", "riemap-free")] {
        assert_eq!((of(name, "/outcome"), of(name, "/median/solve")), ("done".into(), Value::Null));
        assert_eq!(of(name, "/quality/flipped"), 0);
        if cfg!(target_os = "linux") {
            let [its, ours] = [name, ours].map(|name| of(name, "/median/whole/cpu").as_f64().unwrap());
            // A script may take no time that is counted.
            assert_eq!(of(name, "/ratio").as_f64(), Some(ours / its).filter(|ratio| ratio.is_finite()));
        }
    }
    executable(&shell, "bff", "echo 'f 1/1 2/2 3/3' > \"$2\"");
    shell.done(&arguments);
    let table = shell.read("r/bench/table.md");
    assert!(table.contains("bff-disc failed on grid at 64: line 1 of its map has an index out of range"), "{table}");
}
