use std::path::Path;

use super::Checkerboard;
use super::picture::{ViewParts, maps};
use crate::figure::{Checker, FigureError};
use crate::input::Input;
use crate::io::glb::Model;
use crate::io::{Staged, WriteError, stage_glb};
use crate::map::Mapped;
use crate::map::periodic::checker;

/// An error in writing the textured surface as binary glTF.
#[derive(Debug, thiserror::Error)]
pub enum ModelError {
    /// The map has no checkerboard.
    #[error(transparent)]
    Figure(#[from] FigureError),
    /// The file cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}

/// Binary glTF of the faces that were mapped, under the checkerboard of
/// [`checkerboard`](super::checkerboard) and lit by the same normals, not yet in its place.
///
/// # Errors
/// [`ModelError`].
pub fn stage_model(path: &Path, input: &Input, mapped: &Mapped, look: Checkerboard) -> Result<Staged, ModelError> {
    let (disc, image) = (&mapped.domain.disc, mapped.image());
    let corners = (0..disc.source_faces()).flat_map(|f| disc.faces.corner_range(f));
    let map: Vec<[f64; 2]> = corners.map(|c| image.corner(disc, c)).map(|z| [z.re, z.im]).collect();
    let board = match &mapped.torus {
        Some(torus) => checker(torus.tau, look.squares as u32).affine(torus.tau),
        None => Checker::across(map.iter().copied(), look.squares)?.affine(),
    };
    let parts = ViewParts::of(mapped, &maps(mapped), look.squares)?;
    let normals = parts.figure(input, mapped, look).corner_normals();
    let model = Model {
        positions: &input.surface.positions,
        faces: &parts.faces,
        z_up: look.up.axis(&input.source) == [0.0, 0.0, 1.0],
        normals: Some(&normals),
        map: Some(&map),
        texture: Checker::TO_TILE.after(&board),
        picture: Some(&Checker::tile()?),
    };
    Ok(stage_glb(path, &model)?)
}
