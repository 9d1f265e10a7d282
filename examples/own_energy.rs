//! Maps a surface by an energy and a constraint of one's own, handed to the map at run time.
//!
//! `cargo run --release --example own_energy`

use std::error::Error;
use std::sync::Arc;

use riemap::constraint::{ConstraintError, Fixed};
use riemap::energy::{Block, EnergyError, LocalMap, Polynomial, Properties, Rest, SquareSum, Stencils};
use riemap::map::Own;
use riemap::num_complex::Complex64;
use riemap::quad_graph::QuadGraph;
use riemap::surface::oriented_mesh::OrientedMesh;
use riemap::{Boundary, Constraint, Energy, EnergyKind, Expression, Input, MapOptions, Silent, map_input};

/// `Σ |z_v − p_v|²` over some vertices: it draws them to places of the plane.
#[derive(Clone)]
struct Landmarks(Vec<(u32, Complex64)>);

impl EnergyKind for Landmarks {
    fn name(&self) -> &'static str {
        "landmarks"
    }

    fn about(&self) -> &'static str {
        "Σ over landmarks |z − p|²"
    }

    fn properties(&self) -> Properties {
        Properties::default()
    }

    fn make(&self, _rest: Rest) -> Result<Box<dyn Energy>, EnergyError> {
        let vertices: Vec<[u32; 1]> = self.0.iter().map(|&(v, _)| [v]).collect();
        let places = self.0.iter().map(|&(_, place)| place).collect();
        Ok(Box::new(Springs { vertices: Stencils::new(&vertices), places }))
    }
}

/// The same on a surface: two residuals, Re (z − p) and Im (z − p), for each landmark.
struct Springs {
    vertices: Stencils,
    places: Vec<Complex64>,
}

impl SquareSum for Springs {
    fn name(&self) -> &'static str {
        "landmarks"
    }

    fn stencils(&self) -> &Stencils {
        &self.vertices
    }

    fn residuals_per_piece(&self) -> usize {
        2
    }

    fn residuals(&self, e: usize, z: &LocalMap) -> [f64; 2] {
        let d = z[0] - self.places[e];
        [d.re, d.im]
    }

    fn jacobian(&self, _e: usize, _z: &LocalMap) -> [[f64; 8]; 2] {
        let mut rows = [[0.0; 8]; 2];
        (rows[0][0], rows[1][1]) = (1.0, 1.0);
        rows
    }

    fn curvature(&self, _e: usize, _z: &LocalMap) -> Option<Block> {
        None
    }

    fn residuals_along(&self, e: usize, z: &LocalMap, d: &LocalMap) -> [Polynomial; 2] {
        let here = self.residuals(e, z);
        [Polynomial::quadratic(here[0], d[0].re, 0.0), Polynomial::quadratic(here[1], d[0].im, 0.0)]
    }

    fn is_linear(&self) -> bool {
        true
    }
}

/// Holds one vertex at 0 and lets another move along the real axis alone.
struct RealAxis {
    at_zero: u32,
    on_axis: u32,
}

impl Constraint for RealAxis {
    fn hold(&self, _mesh: &OrientedMesh, _graph: &QuadGraph, fixed: &mut Fixed) -> Result<(), ConstraintError> {
        fixed.hold(self.at_zero, Complex64::ZERO);
        fixed.hold_on_line(self.on_axis, Complex64::ZERO, Complex64::ONE);
        Ok(())
    }
}

/// Runs the example.
pub fn main() -> Result<(), Box<dyn Error>> {
    let input = Input::open("graph:cos+cos?n=12&mesh=triangle")?;
    let [first, last] = [0, 12];
    let target = Complex64::new(3.0, 0.5);
    let inner = 6 * 13 + 6;
    for strength in [0.0, 1.0, 100.0] {
        let lengths: Expression = "H + L".parse()?;
        let options = MapOptions {
            boundary: Boundary::FREE,
            energy: Some(lengths.plus(strength, Arc::new(Landmarks(vec![(inner, target)])))?),
            constraints: vec![Own::new(Arc::new(RealAxis { at_zero: first, on_axis: last }))],
            ..MapOptions::default()
        };
        let mapped = map_input(&input, &options, &mut Silent)?;
        let z = |v: u32| mapped.map.z[v as usize];
        println!(
            "strength {strength}: the landmark is {:.4} from its place; the corner is at {:.4} on the axis",
            (z(inner) - target).norm(),
            z(last)
        );
    }
    Ok(())
}
