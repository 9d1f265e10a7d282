//! Opens any connected oriented surface to a disc, or closes it.
//!
//! The steps are: remove faces, fill holes, cut along a short graph.

mod cut_mesh;
mod error;
mod graph;
mod holes;
mod record;

pub(super) use cut_mesh::CutMesh;
pub use error::CutError;
pub use record::CutRecord;

use super::Surface;
use super::edges::Edges;
use crate::surface::cut::holes::fill;
use crate::surface::oriented_mesh::{NotADisc, OrientedMesh};
use crate::surface::topology::diagnosis::{Diagnosis, Finding};
use crate::surface::topology::tree_cotree::EdgeGraph;

/// The steps that turn a surface into a disc.
#[derive(Clone, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct Opening {
    /// Cut a surface that is not a disc along a short graph of edges, and split vertices at which
    /// the surface touches itself.
    pub cut: bool,
    /// Indices of faces that are removed first; they count from 0.
    pub remove_faces: Vec<u32>,
    /// Fill all holes but the longest. The new faces take part in the map, but are neither written
    /// nor measured.
    pub fill_holes: bool,
}

impl OrientedMesh {
    /// Turns `surface` into a disc by the steps that `opening` allows, as far as they are needed.
    ///
    /// The order is `remove_faces`, `fill_holes`, `cut`. Faces that are not removed keep their
    /// shape. A vertex on the cut is duplicated: there is one copy for each fan of faces into which
    /// the cut divides its neighbourhood.
    ///
    /// # Errors
    /// Defects that no step removes; a result that is not a disc; holes that cannot be filled.
    pub fn open(surface: &Surface, diagnosis: &Diagnosis, opening: &Opening) -> Result<(Self, CutRecord), CutError> {
        let whole = opening.remove_faces.is_empty();
        if whole && (diagnosis.fatal().next().is_none() || *opening == Opening::default()) {
            return Ok((OrientedMesh::new(surface, diagnosis)?, CutRecord::default()));
        }
        refuse(diagnosis, |finding| match finding {
            Finding::Closed { .. } | Finding::NonManifoldVertices { .. } => opening.cut || !whole,
            Finding::NotADisc { .. } => opening.cut || opening.fill_holes || !whole,
            _ => false,
        })?;
        let mut record = CutRecord::default();
        let mut sheet = prepare(surface, diagnosis, opening, &mut record)?;
        if opening.fill_holes {
            let loops = sheet.boundary_loops();
            fill(&mut sheet, loops.get(1..).unwrap_or_default(), &mut record)?;
        }
        let mut loops = sheet.boundary_loops();
        let genus = (2 - loops.len() as i64 - sheet.euler()).max(0) as u64 / 2;
        if loops.len() != 1 || genus != 0 {
            record.genus = genus;
            record.boundary_loops = loops.len();
            if !opening.cut {
                let boundary_loops = loops.iter().map(Vec::len).collect();
                return Err(CutError::NoDiscLeft { boundary_loops, genus });
            }
            cut(&mut sheet, genus, &mut record);
            loops = sheet.boundary_loops();
        }
        match loops.as_slice() {
            [only] if sheet.euler() == 1 => Ok((sheet.into_disc(only), record)),
            _ => Err(CutError::NoDiscLeft { boundary_loops: loops.iter().map(Vec::len).collect(), genus }),
        }
    }

    /// Returns `surface` as a closed surface of any genus, with its holes filled if `fill_holes` is
    /// set.
    ///
    /// The [`OrientedMesh::boundary`] of the result is empty.
    ///
    /// # Errors
    /// Other defects of the surface; holes that are not to be filled or cannot be filled.
    pub fn closed(surface: &Surface, diagnosis: &Diagnosis, fill_holes: bool) -> Result<(Self, CutRecord), CutError> {
        refuse(diagnosis, |finding| matches!(finding, Finding::Closed { .. } | Finding::NotADisc { .. }))?;
        let mut record = CutRecord::default();
        let mut sheet = prepare(surface, diagnosis, &Opening::default(), &mut record)?;
        let loops = sheet.boundary_loops();
        if !loops.is_empty() && !fill_holes {
            return Err(CutError::NotClosed { boundary_loops: loops.iter().map(Vec::len).collect() });
        }
        fill(&mut sheet, &loops, &mut record)?;
        Ok((sheet.into_disc(&[]), record))
    }
}

/// Fails if there are fatal findings for which `mended` is false; the error lists them.
fn refuse(diagnosis: &Diagnosis, mended: impl Fn(&Finding) -> bool) -> Result<(), NotADisc> {
    let findings: Vec<Finding> = diagnosis.fatal().filter(|&finding| !mended(finding)).cloned().collect();
    if findings.is_empty() { Ok(()) } else { Err(NotADisc { findings }) }
}

/// Removes faces and splits vertices so that every vertex has one fan of faces; checks that the
/// remaining surface is connected.
fn prepare(
    surface: &Surface,
    diagnosis: &Diagnosis,
    opening: &Opening,
    record: &mut CutRecord,
) -> Result<CutMesh, CutError> {
    let faces = surface.faces.len();
    let mut removed = vec![false; faces];
    for &face in &opening.remove_faces {
        *removed.get_mut(face as usize).ok_or(CutError::NoSuchFace { face, faces })? = true;
    }
    record.faces_removed = removed.iter().filter(|&&gone| gone).count();
    if record.faces_removed == faces {
        return Err(CutError::NothingLeft);
    }
    let mut sheet = CutMesh::new(surface, &diagnosis.topology, &removed);
    if record.faces_removed > 0 {
        let pieces = sheet.pieces();
        if pieces > 1 {
            return Err(CutError::Pieces { pieces });
        }
    }
    let pinches = sheet.split_fans();
    if let (Some((vertex, fans)), false) = (pinches.first, opening.cut) {
        return Err(CutError::Pinched { vertex, fans });
    }
    record.vertices_split = pinches.count;
    Ok(sheet)
}

/// Cuts a surface that is not a disc along a short graph.
fn cut(sheet: &mut CutMesh, genus: u64, record: &mut CutRecord) {
    let faces = sheet.faces();
    let edges = Edges::new(&faces, sheet.positions.len());
    let graph = EdgeGraph::new(&faces, &edges, sheet.positions.len(), sheet.lengths(&edges));
    let along = graph::cut_graph(&graph, genus);
    record.cut_edges = along.len();
    record.cut_length = along.iter().map(|&e| graph.length[e as usize]).sum();
    sheet.part(along.iter().flat_map(|&e| edges.corners(e as usize)).copied());
}
