//! Maps a torus of revolution to a flat one, ℂ / (ℤ + τℤ), without cutting it.
//!
//! `cargo run --release --example torus`

use std::error::Error;

use riemap::{Boundary, Input, MapOptions, Silent, map_input};

/// Runs the example.
pub fn main() -> Result<(), Box<dyn Error>> {
    // Generated surfaces know the exact ratio of their periods.
    let input = Input::open("torus?R=2&r=0.8&n=32&mesh=triangle")?;
    let mapped = map_input(&input, &MapOptions { boundary: Boundary::Periodic, ..MapOptions::default() }, &mut Silent)?;

    let torus = mapped.torus.as_ref().ok_or("a periodic map has periods")?;
    println!("τ = {:.6} + {:.6} i", torus.tau.re, torus.tau.im);
    if let Some([re, im]) = input.period {
        println!("exact: {re:.6} + {im:.6} i");
    }
    println!("flipped faces: {}", mapped.distortion.flipped);
    Ok(())
}
