//! The examples run, and do what they say.

#[path = "../../examples/disc.rs"]
mod disc;
#[path = "../../examples/free.rs"]
mod free;
#[path = "../../examples/own_energy.rs"]
mod own_energy;
#[path = "../../examples/torus.rs"]
mod torus;
#[path = "../../examples/voxels.rs"]
mod voxels;

#[test]
fn every_example_runs() {
    for (name, main) in [
        ("disc", disc::main as fn() -> Result<(), Box<dyn std::error::Error>>),
        ("free", free::main),
        ("own_energy", own_energy::main),
        ("torus", torus::main),
        ("voxels", voxels::main),
    ] {
        main().unwrap_or_else(|error| panic!("{name}: {error}"));
    }
}
