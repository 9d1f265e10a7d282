//! The defects and peculiarities of a mesh. Each finding names the first offender and counts the
//! rest.
//!
//! Nothing is repaired here except the orientation of whole patches, which is reported.

use std::fmt;

use super::finding;
use crate::surface::Surface;
use crate::surface::topology::Topology;

/// The consequence of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The surface cannot be mapped as it is.
    Fatal,
    /// Repaired before mapping.
    Repaired,
    /// Harmless to the map, but worth knowing.
    Note,
}

/// A kind of defect with its first offender and the number `count` of offenders. Indices of faces
/// and vertices count from 0.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs)]
pub enum Finding {
    /// There is no face.
    NoFaces,
    /// A coordinate is NaN or infinite.
    NotFinite { vertex: u32, count: usize },
    /// The surface is so large or so small that squares of areas overflow or underflow.
    OutOfRange { extent: f64 },
    /// The faces have different or unsupported numbers of corners; `(corners, faces)` in ascending
    /// order.
    Polygons { arities: Vec<(usize, usize)>, first: u32 },
    /// A face contains a vertex twice.
    RepeatedVertex { face: u32, vertex: u32, count: usize },
    /// Two faces have the same vertices.
    DuplicateFaces { first: [u32; 2], count: usize },
    /// An edge joins two vertices at the same position.
    ZeroLengthEdges { edge: [u32; 2], count: usize, fatal: bool },
    /// The area of a face vanishes in double precision.
    ZeroAreaFaces { face: u32, count: usize },
    /// Faces without area that are replaced by surrogates with this ratio of height to length.
    Surrogates { face: u32, count: usize, height: f64 },
    /// An edge has three or more faces.
    NonManifoldEdges { edge: [u32; 2], faces: Vec<u32>, count: usize },
    /// The surface touches itself at a vertex.
    NonManifoldVertices { vertex: u32, fans: u32, count: usize },
    /// A component has no consistent orientation; it fails at `edge`.
    NonOrientable { component: usize, edge: [u32; 2] },
    /// Faces were flipped so that neighbours agree.
    Reoriented { face: u32, count: usize },
    /// There is more than one component.
    Components { count: usize, faces: Vec<usize> },
    /// The (only) component is closed.
    Closed { genus: u64 },
    /// The (only) component is neither closed nor a disc.
    NotADisc { boundary_loops: Vec<usize>, genus: u64 },
    /// Vertices belong to no face.
    Unreferenced { vertex: u32, count: usize },
    /// A vertex in use has the same position as another one.
    CoincidentVertices { first: [u32; 2], count: usize },
}

impl Finding {
    /// The consequence for mapping.
    pub fn severity(&self) -> Severity {
        match self {
            Finding::Reoriented { .. } | Finding::Surrogates { .. } => Severity::Repaired,
            Finding::Unreferenced { .. } | Finding::CoincidentVertices { .. } => Severity::Note,
            Finding::ZeroLengthEdges { fatal: false, .. } => Severity::Note,
            _ => Severity::Fatal,
        }
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Finding::NoFaces => write!(out, "there is no face"),
            Finding::NotFinite { vertex, count } => {
                write!(
                    out,
                    "{} a coordinate that is NaN or infinite: vertex {vertex}",
                    counted(*count, "vertex has", "vertices have")
                )
            }
            Finding::OutOfRange { extent } => {
                write!(
                    out,
                    "the surface extends over {extent:e}, outside the range 1e-60 to 1e60 in which double precision can \
                     represent squares of areas"
                )
            }
            Finding::Polygons { arities, first } => {
                let parts: Vec<String> = arities.iter().map(|(n, k)| format!("{k} with {n} corners")).collect();
                write!(
                    out,
                    "not all faces are triangles, nor all quads: {}; the first that differs is face {first}",
                    parts.join(", ")
                )
            }
            Finding::RepeatedVertex { face, vertex, count } => {
                write!(
                    out,
                    "{} a vertex twice: face {face} has vertex {vertex}",
                    counted(*count, "face contains", "faces contain")
                )
            }
            Finding::DuplicateFaces { first: [a, b], count } => {
                write!(
                    out,
                    "{} the vertices of an earlier one: faces {a} and {b}",
                    counted(*count, "face has", "faces have")
                )
            }
            Finding::ZeroLengthEdges { edge: [a, b], count, .. } => {
                write!(
                    out,
                    "{} length zero: vertices {a} and {b} are at the same place",
                    counted(*count, "edge has", "edges have")
                )
            }
            Finding::ZeroAreaFaces { face, count } => {
                write!(out, "{} no area: face {face}", counted(*count, "face has", "faces have"))
            }
            Finding::Surrogates { face, count, height } => {
                let faces = counted(*count, "face has", "faces have");
                write!(
                    out,
                    "{faces} no area, the first is face {face}: mapped as if a vertex were lifted off the longest edge \
                     (quads: as a rectangle) to {height} of its length"
                )
            }
            Finding::NonManifoldEdges { edge: [a, b], faces, count } => {
                let listed: Vec<String> = faces.iter().take(6).map(u32::to_string).collect();
                let more = if faces.len() > 6 { ", …" } else { "" };
                write!(
                    out,
                    "{} more than two faces (non-manifold): the edge {a}–{b} has {} faces, {}{more}",
                    counted(*count, "edge has", "edges have"),
                    faces.len(),
                    listed.join(", ")
                )
            }
            Finding::NonManifoldVertices { vertex, fans, count } => {
                write!(
                    out,
                    "{} separate fans of faces (non-manifold): vertex {vertex} has {fans} fans",
                    counted(*count, "vertex joins", "vertices join")
                )
            }
            Finding::NonOrientable { component, edge: [a, b] } => {
                write!(
                    out,
                    "component {component} is not orientable: its faces cannot be oriented consistently across the edge \
                     {a}–{b}"
                )
            }
            Finding::Reoriented { face, count } => {
                write!(
                    out,
                    "{}: face {face}",
                    counted(
                        *count,
                        "face was oriented against its neighbours",
                        "faces were oriented against their neighbours"
                    )
                )
            }
            Finding::Components { count, faces } => {
                let listed: Vec<String> = faces.iter().take(6).map(usize::to_string).collect();
                let more = if faces.len() > 6 { ", …" } else { "" };
                write!(out, "the mesh has {count} connected components, of {}{more} faces", listed.join(", "))
            }
            Finding::Closed { genus } => write!(out, "the surface is closed (genus {genus}, no boundary)"),
            Finding::NotADisc { boundary_loops, genus } => {
                let listed: Vec<String> = boundary_loops.iter().take(6).map(usize::to_string).collect();
                let more = if boundary_loops.len() > 6 { ", …" } else { "" };
                write!(
                    out,
                    "the surface is not a disc: {}, of {}{more} edges, genus {genus}",
                    counted(boundary_loops.len(), "boundary loop", "boundary loops"),
                    listed.join(", ")
                )
            }
            Finding::Unreferenced { vertex, count } => {
                write!(out, "{} to no face: vertex {vertex}", counted(*count, "vertex belongs", "vertices belong"))
            }
            Finding::CoincidentVertices { first: [a, b], count } => {
                write!(
                    out,
                    "{} at the position of another: vertices {a} and {b}",
                    counted(*count, "vertex lies", "vertices lie")
                )
            }
        }
    }
}

/// `1 face has`, `7 faces have`.
fn counted(count: usize, one: &str, many: &str) -> String {
    if count == 1 { format!("1 {one}") } else { format!("{count} {many}") }
}

/// The topology of a surface and all findings, in order of severity.
#[derive(Clone, Debug)]
pub struct Diagnosis {
    /// The combinatorial properties of the faces.
    pub topology: Topology,
    /// All findings, the fatal ones first.
    pub findings: Vec<Finding>,
}

impl Diagnosis {
    /// Examines `surface` in linear time, except for sorting to find duplicates and coincident
    /// vertices.
    pub fn new(surface: &Surface) -> Self {
        let topology = Topology::new(surface);
        let mut findings = finding::of_polygons(surface);
        findings.extend(finding::of_geometry(surface, &topology));
        findings.extend(finding::of_manifoldness(&topology));
        findings.extend(finding::of_shape(&topology));
        findings.extend(finding::of_vertices(surface, &topology));
        findings.sort_by_key(Finding::severity);
        Diagnosis { topology, findings }
    }

    /// Returns the diagnosis in which faces without area are repaired by
    /// [`Surrogates`](crate::surface::Surrogates) of this height.
    #[must_use]
    pub fn with_surrogates(mut self, height: f64) -> Self {
        let mut lifted = false;
        for finding in &mut self.findings {
            if let Finding::ZeroAreaFaces { face, count } = *finding {
                *finding = Finding::Surrogates { face, count, height };
                lifted = true;
            }
        }
        // Edges without length belong to such faces; only in quad meshes are there others.
        self.findings.retain(|f| !(lifted && matches!(f, Finding::ZeroLengthEdges { fatal: true, .. })));
        self.findings.sort_by_key(Finding::severity);
        self
    }

    /// The findings that prevent the surface from being mapped to the plane.
    pub fn fatal(&self) -> impl Iterator<Item = &Finding> {
        self.findings.iter().filter(|f| f.severity() == Severity::Fatal)
    }
}
