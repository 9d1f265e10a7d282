//! What is wrong, or only noteworthy, with a mesh: each finding names its first offender, counts the rest, and says
//! what to do. Nothing is repaired here but the orientation of whole patches, and that is reported.

use std::fmt;

use super::finding;
use crate::surface::Surface;
use crate::surface::topology::Topology;

/// What follows from a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The surface cannot be mapped as it is.
    Fatal,
    /// Mended before mapping.
    Repaired,
    /// Harmless to the map; worth knowing.
    Note,
}

/// One kind of defect: its first offender (faces, vertices and ends of edges count from 0) and `count`, how many there
/// are.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs)]
pub enum Finding {
    /// No face at all.
    NoFaces,
    /// A coordinate is NaN or infinite.
    NotFinite { vertex: u32, count: usize },
    /// The surface is so large or so small that squares of areas leave the range of doubles.
    OutOfRange { extent: f64 },
    /// Faces of different or unsupported numbers of corners: `(corners, faces)` in ascending order.
    Polygons { arities: Vec<(usize, usize)>, first: u32 },
    /// A face runs through a vertex twice.
    RepeatedVertex { face: u32, vertex: u32, count: usize },
    /// Two faces have the same vertices.
    DuplicateFaces { first: [u32; 2], count: usize },
    /// An edge joins two vertices at the same place.
    ZeroLengthEdges { edge: [u32; 2], count: usize, fatal: bool },
    /// A face has no area that doubles can tell from zero.
    ZeroAreaFaces { face: u32, count: usize },
    /// Such faces, each with a shape of this height over its length in its place.
    Surrogates { face: u32, count: usize, height: f64 },
    /// An edge of three or more faces.
    NonManifoldEdges { edge: [u32; 2], faces: Vec<u32>, count: usize },
    /// A vertex where the surface touches itself.
    NonManifoldVertices { vertex: u32, fans: u32, count: usize },
    /// A component that has no consistent orientation; `edge`: one where it fails.
    NonOrientable { component: usize, edge: [u32; 2] },
    /// Faces turned over so that neighbours agree.
    Reoriented { face: u32, count: usize },
    /// More than one component.
    Components { count: usize, faces: Vec<usize> },
    /// The (only) component is closed.
    Closed { genus: u64 },
    /// The (only) component is neither closed nor a disc.
    NotADisc { boundary_loops: Vec<usize>, genus: u64 },
    /// Vertices of no face.
    Unreferenced { vertex: u32, count: usize },
    /// Vertices in use that lie where another one does.
    CoincidentVertices { first: [u32; 2], count: usize },
}

impl Finding {
    /// What follows for mapping.
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
                    "the surface extends over {extent:e}, and outside 1e-60 to 1e60 doubles do not hold squares of areas"
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
                    counted(*count, "face runs through", "faces run through")
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
                    "{faces} no area, face {face} the first: mapped as if a vertex were lifted off the longest edge (quads: as a rectangle) to \
                     {height} of its length"
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
                    "component {component} is not orientable: no choice of sides agrees across the edge {a}–{b}"
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
                    "{} where another one does: vertices {a} and {b}",
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

/// A surface understood: its topology and everything that was found, the gravest first.
#[derive(Clone, Debug)]
pub struct Diagnosis {
    /// What the faces' indices say.
    pub topology: Topology,
    /// All findings, the fatal ones first.
    pub findings: Vec<Finding>,
}

impl Diagnosis {
    /// Examines `surface` in linear time (duplicates and coincidences by sorting).
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

    /// The same where faces without area are mapped by [`Surrogates`](crate::surface::Surrogates) of this height.
    #[must_use]
    pub fn with_surrogates(mut self, height: f64) -> Self {
        let mut lifted = false;
        for finding in &mut self.findings {
            if let Finding::ZeroAreaFaces { face, count } = *finding {
                *finding = Finding::Surrogates { face, count, height };
                lifted = true;
            }
        }
        // Edges without length are those of such faces; of quads alone there are others.
        self.findings.retain(|f| !(lifted && matches!(f, Finding::ZeroLengthEdges { fatal: true, .. })));
        self.findings.sort_by_key(Finding::severity);
        self
    }

    /// The findings that keep the surface from being mapped to the plane.
    pub fn fatal(&self) -> impl Iterator<Item = &Finding> {
        self.findings.iter().filter(|f| f.severity() == Severity::Fatal)
    }
}
