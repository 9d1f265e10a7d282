//! Flattens a surface at true size, its boundary free, and reads the distortion of every face.
//!
//! `cargo run --release --example free`

use std::error::Error;

use riemap::{Boundary, MapOptions, Surface, map_surface};

/// A piece of a cylinder of radius 1: the angle 1 around the axis, the length 1 along it, `n × n` quads. It can be unrolled.
fn cylinder(n: u32) -> Result<Surface, riemap::SurfaceError> {
    let place = |i: u32, j: u32| {
        let angle = f64::from(i) / f64::from(n);
        [angle.cos(), angle.sin(), f64::from(j) / f64::from(n)]
    };
    let positions = (0..=n).flat_map(|j| (0..=n).map(move |i| place(i, j))).collect();
    let vertex = |i: u32, j: u32| j * (n + 1) + i;
    let cells = (0..n).flat_map(|j| (0..n).map(move |i| (i, j)));
    let faces = cells.map(|(i, j)| vec![vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)]);
    Surface::new(positions, faces.collect())
}

/// Runs the example.
pub fn main() -> Result<(), Box<dyn Error>> {
    let surface = cylinder(20)?;
    let mapped = map_surface(&surface, &MapOptions { boundary: Boundary::FREE, ..MapOptions::default() })?;

    let distortion = &mapped.distortion;
    println!("flipped faces: {}", distortion.flipped);
    if let (Some(shear), Some(length)) = (&distortion.quasi_conformal, &distortion.length) {
        println!("mean σ1/σ2: {:.6}; lengths change by {:.2e} at most", shear.mean, length.max);
    }
    // The lower edge is an arc of the angle 1: straight now, and as long.
    let uv = mapped.uv();
    if let (Some([x, y]), Some([s, t])) = (uv[0], uv[20]) {
        println!("length of the lower edge: {:.4}", (s - x).hypot(t - y));
    }
    Ok(())
}
