//! Maps a triangle mesh given by arrays to the unit disc.
//!
//! `cargo run --release --example disc`

use std::error::Error;

use riemap::MapOptions;

/// A hill over the square: `(n + 1)²` vertices, `2n²` triangles.
fn hill(n: u32) -> (Vec<[f64; 3]>, Vec<Vec<u32>>) {
    let place = |i: u32, j: u32| {
        let (x, y) = (f64::from(i) / f64::from(n), f64::from(j) / f64::from(n));
        [x, y, 3.0 * x * (1.0 - x) * y * (1.0 - y)]
    };
    let vertex = |i: u32, j: u32| j * (n + 1) + i;
    let positions = (0..=n).flat_map(|j| (0..=n).map(move |i| place(i, j))).collect();
    let cells = (0..n).flat_map(|j| (0..n).map(move |i| (i, j)));
    let faces = cells.flat_map(|(i, j)| {
        let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
        [vec![a, b, c], vec![a, c, d]]
    });
    (positions, faces.collect())
}

/// Runs the example.
pub fn main() -> Result<(), Box<dyn Error>> {
    let (positions, faces) = hill(40);
    let mapped = riemap::map(&positions, &faces, &MapOptions::default())?;

    println!("{} vertices, {} triangles", positions.len(), faces.len());
    println!("bijective: {}", mapped.validity.is_one_to_one());
    if let Some(shear) = &mapped.distortion.quasi_conformal {
        println!("mean σ1/σ2: {:.4} (1 is conformal)", shear.mean);
    }
    for (v, uv) in mapped.uv().iter().enumerate().step_by(400) {
        if let Some([x, y]) = uv {
            println!("vertex {v}: {x:.4} {y:.4}");
        }
    }
    Ok(())
}
