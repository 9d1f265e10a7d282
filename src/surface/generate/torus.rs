use std::f64::consts::TAU;

use super::random::Random;
use super::{Arguments, Form, GenerateError, Generated, Parameter, SurfaceKind, grid, mesh};
use crate::surface::{Faces, Surface};

/// The torus ((R + r cos θ) cos φ, (R + r cos θ) sin φ, r sin θ), with φ as first direction and τ =
/// i r/√(R² − r²).
pub(super) const TORUS: SurfaceKind = SurfaceKind {
    name: "torus",
    about: "closed torus of revolution, R to the middle of the tube, r its radius; n × n quads; τ = i r/√(R² − r²)",
    parameters: &[&[
        Parameter::real("R", 2.0, 0.1, 100.0, "radius to the middle of the tube"),
        Parameter::real("r", 0.8, 0.1, 100.0, "radius of the tube, at most 0.99 R"),
        Parameter::whole("n", 64, 3, 4096, "cells in each direction: n² vertices"),
        Parameter::choice("mesh", &["quad", "triangle"], "grid, split grid"),
        mesh::DIAGONAL,
        mesh::SEED,
    ]],
    form: Form::Whole(torus),
    exact: true,
};

fn torus(arguments: &Arguments) -> Result<Generated, GenerateError> {
    let (big, small) = radii(arguments)?;
    let n = (arguments.whole("n")? as usize).max(1);
    let angles: Vec<(f64, f64)> = (0..n).map(|i| (TAU * i as f64 / n as f64).sin_cos()).collect();
    let mut positions = Vec::with_capacity(n * n);
    for &(sin_theta, cos_theta) in &angles {
        let distance = big + small * cos_theta;
        positions.extend(angles.iter().map(|&(sin, cos)| [distance * cos, distance * sin, small * sin_theta]));
    }
    let triangles = arguments.choice("mesh")? == "triangle";
    let diagonal = mesh::diagonal(arguments)?;
    let mut random = Random::new(arguments.whole("seed")?);
    let mut faces = Faces::with_capacity(2 * n * n, 6 * n * n);
    let vertex = |i: usize, j: usize| ((j % n) * n + i % n) as u32;
    for j in 0..n {
        for i in 0..n {
            let quad = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
            if triangles {
                grid::push_split(&mut faces, quad, grid::split_along_first(diagonal, i, j, &mut random));
            } else {
                faces.push(&quad);
            }
        }
    }
    let period = [0.0, small / (big * big - small * small).sqrt()];
    let surface = Surface { positions, faces, face_normals: None };
    Ok(Generated { surface, exact: None, period: Some(period), digital: None, name: String::new() })
}

/// Reads R and r and checks that the tube does not meet itself.
pub(super) fn radii(arguments: &Arguments) -> Result<(f64, f64), GenerateError> {
    let (big, small) = (arguments.real("R")?, arguments.real("r")?);
    if small > 0.99 * big {
        return Err(arguments.out_of_range("r", format!(" with R={big}"), format!("at most {}", 0.99 * big)));
    }
    Ok((big, small))
}
