//! Maps part of the boundary of a set of voxels, seen along normals that are estimated from the voxels.
//!
//! `cargo run --release --example voxels`

use std::error::Error;

use riemap::num_complex::Complex64;
use riemap::{Boundary, Input, MapOptions, Silent, map_input};

/// The signed area of the image of a quad.
fn image_area(quad: &[u32; 4], z: &[Complex64]) -> f64 {
    let [a, b, c, d] = quad.map(|v| z[v as usize]);
    0.5 * ((c - a).conj() * (d - b)).im
}

/// Runs the example.
pub fn main() -> Result<(), Box<dyn Error>> {
    // A spherical cap of radius 20, digitised: a staircase of unit squares.
    let input = Input::open("digital-cap?R=20")?;
    let options = MapOptions { boundary: Boundary::FREE, ..MapOptions::default() };
    // ρ is measured on estimated tangent planes, the default for voxels, or on the squares themselves.
    let smooth = map_input(&input, &options, &mut Silent)?;
    let stairs = map_input(&Input::of(input.source.clone(), input.surface.clone()), &options, &mut Silent)?;

    println!("{} surfels", input.surface.faces().len());
    for (name, mapped) in [("estimated normals", &smooth), ("the squares' own", &stairs)] {
        let area: f64 = mapped.domain.graph.quads.iter().map(|quad| image_area(quad, &mapped.map.z)).sum();
        println!("{name}: the image has the area {area:.1}, {} faces are flipped", mapped.distortion.flipped);
    }
    Ok(())
}
