//! `--solver`: every backend by its name.

use riemap::solver::LINEAR_SOLVERS;

use super::shell::{FIXED, Shell, distance, hill};

/// Problems of every kind that some backend asks for: a new backend must suit one of them.
const PROBLEMS: [&[&str]; 6] = [
    &["t.obj", "--dual", "circumcentre"],
    &["t.obj", "--hold", "primal"],
    &["t.obj"],
    &["t.obj", "--weight", "unit", "--pin", "24=0.2,0.1"],
    &["q.obj", "--shape", "square"],
    &["q.obj", "--weight", "unit"],
];

#[test]
fn every_backend_solves_what_suits_it_and_all_agree() {
    let shell = Shell::new();
    shell.write("t.obj", hill(7, 1.0, false));
    shell.write("q.obj", hill(7, 1.0, true));
    let mut solved = vec![0; LINEAR_SOLVERS.len()];
    for problem in PROBLEMS {
        let reference = shell.uv(problem[0], &problem[1..]);
        for (backend, solved) in LINEAR_SOLVERS.iter().zip(&mut solved) {
            let arguments = [&["map"][..], &FIXED, problem, &["--solver", backend.name(), "-o", "s.obj"]].concat();
            let ran = shell.run(&arguments);
            if ran.code == 1 {
                // Unsuitable, and it says so.
                assert!(ran.err.contains(&format!("`{}`", backend.name())), "{arguments:?}: {}", ran.err);
                continue;
            }
            assert!(ran.out.contains(&format!("\n{}: to a relative residual", backend.name())), "{}", ran.out);
            let uv = super::shell::texture(&shell.read("s.obj"));
            let apart = distance(&uv, &reference);
            // Direct solvers of some hundred unknowns; squared condition numbers stay below 1e6 here.
            assert!(apart < 1e-9, "{arguments:?}: {apart}");
            *solved += 1;
        }
    }
    for (backend, solved) in LINEAR_SOLVERS.iter().zip(solved) {
        assert!(solved > 0, "no problem suits `{}`: add one", backend.name());
    }
}

#[test]
fn auto_says_which_backend_it_took() {
    let shell = Shell::new();
    shell.write("t.obj", hill(7, 1.0, false));
    for (options, backend) in [
        (&["--dual", "circumcentre"][..], "cotan"),
        (&["--hold", "primal"], "laplacian"),
        (&[], "cholesky-real"),
        (&["--weight", "unit"], "cholesky"),
    ] {
        let out = shell.done(&[&["map", "t.obj"], &FIXED, options].concat());
        assert!(out.contains(&format!("\n{backend}: to a relative residual")), "{options:?}: {out}");
    }
}
