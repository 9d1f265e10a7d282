//! Errors of the library as exceptions of the package, with what to do said in Python's words.

use std::io;
use std::path::Path;

use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use riemap::energy::EnergyError;
use riemap::input::InputError;
use riemap::io::{ReadError, VolumeError, WriteError};
use riemap::map::OptionsError;
use riemap::map::periodic::PeriodicError;
use riemap::quad_graph::QuadGraphError;
use riemap::solver::SolveError;
use riemap::surface::cut::CutError;
use riemap::surface::digital::DigitalError;
use riemap::surface::normals::NormalError;
use riemap::surface::topology::diagnosis::Finding;
use riemap::surface::topology::homology::HomologyError;
use riemap::{MapError, SurfaceError};

/// Which exception is raised.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// `MeshError`, a `ValueError`: the surface cannot be mapped as it is.
    Mesh,
    /// `OptionError`, a `ValueError`: the request contradicts itself, or does not suit the surface.
    Option,
    /// `ConvergenceError`, a `RuntimeError`: a solver found no map.
    Convergence,
}

impl Class {
    fn name(self) -> &'static str {
        match self {
            Class::Mesh => "MeshError",
            Class::Option => "OptionError",
            Class::Convergence => "ConvergenceError",
        }
    }
}

/// The exception of a class, which the package defines, with the kind of the error and the first faces and vertices that it is
/// about.
pub fn raise(py: Python<'_>, class: Class, message: &str, kind: &str, faces: &[u32], vertices: &[u32]) -> PyErr {
    let made = py
        .import("riemap._errors")
        .and_then(|errors| errors.getattr(class.name()))
        .and_then(|class| class.call1((message, kind, faces.to_vec(), vertices.to_vec())));
    match made {
        Ok(exception) => PyErr::from_value(exception),
        Err(error) => error,
    }
}

/// What is raised for an error of the library.
struct Raised {
    class: Class,
    kind: &'static str,
    faces: Vec<u32>,
    vertices: Vec<u32>,
    advice: Option<&'static str>,
}

impl Raised {
    fn new(class: Class, kind: &'static str) -> Self {
        Raised { class, kind, faces: Vec::new(), vertices: Vec::new(), advice: None }
    }

    fn faces(self, faces: &[u32]) -> Self {
        Raised { faces: faces.to_vec(), ..self }
    }

    fn vertices(self, vertices: &[u32]) -> Self {
        Raised { vertices: vertices.to_vec(), ..self }
    }

    fn advice(self, advice: &'static str) -> Self {
        Raised { advice: Some(advice), ..self }
    }

    fn exception(&self, py: Python<'_>, message: &str) -> PyErr {
        let message = match self.advice {
            Some(advice) => format!("{message}; {advice}"),
            None => message.to_owned(),
        };
        raise(py, self.class, &message, self.kind, &self.faces, &self.vertices)
    }
}

/// The exception for a map that cannot be made.
pub fn of_map(py: Python<'_>, error: &MapError) -> PyErr {
    match error {
        MapError::NoDisc(CutError::NotADisc(error)) => of_findings(py, &error.findings),
        error => raised(error).exception(py, &error.to_string()),
    }
}

/// The exception for a surface that is not a disc: all findings, one a line, with the kind of the gravest.
fn of_findings(py: Python<'_>, findings: &[Finding]) -> PyErr {
    let all: Vec<Raised> = findings.iter().map(finding).collect();
    let lines: Vec<String> = findings
        .iter()
        .zip(&all)
        .map(|(finding, raised)| format!("{finding}; {}", raised.advice.unwrap_or_default()))
        .collect();
    let message = format!("the surface cannot be mapped: {}", lines.join("\n"));
    let faces: Vec<u32> = all.iter().flat_map(|raised| raised.faces.iter().copied()).collect();
    let vertices: Vec<u32> = all.iter().flat_map(|raised| raised.vertices.iter().copied()).collect();
    raise(py, Class::Mesh, &message, all.first().map_or("not-a-disc", |first| first.kind), &faces, &vertices)
}

fn finding(finding: &Finding) -> Raised {
    let mesh = |kind| Raised::new(Class::Mesh, kind);
    match finding {
        Finding::NoFaces => mesh("no-faces").advice("give a mesh with faces"),
        Finding::NotFinite { vertex, .. } => mesh("not-finite").vertices(&[*vertex]).advice("correct the coordinates"),
        Finding::OutOfRange { .. } => {
            mesh("out-of-range").advice("scale the coordinates: conformal maps do not depend on the unit of length")
        }
        Finding::Polygons { first, .. } => mesh("polygons")
            .faces(&[*first])
            .advice("triangulate all faces: meshes of triangles only or of quads only can be mapped"),
        Finding::RepeatedVertex { face, vertex, .. } => mesh("repeated-vertex")
            .faces(&[*face])
            .vertices(&[*vertex])
            .advice("remove the repeated corner, or the face"),
        Finding::DuplicateFaces { first, .. } => {
            mesh("duplicate-faces").faces(first).advice("remove all but one of each set")
        }
        Finding::ZeroLengthEdges { edge, .. } => mesh("zero-length-edges")
            .vertices(edge)
            .advice("merge the two end vertices, or give the faces a shape (surrogate=0.01)"),
        Finding::ZeroAreaFaces { face, .. } => mesh("zero-area-faces")
            .faces(&[*face])
            .advice("remove or collapse the face, or have it mapped by a shape of its own (surrogate=0.01)"),
        Finding::Surrogates { face, .. } => mesh("surrogates").faces(&[*face]),
        Finding::NonManifoldEdges { edge, faces, .. } => mesh("non-manifold-edges")
            .faces(faces)
            .vertices(edge)
            .advice("remove surplus faces, or split the edge into one per pair of faces"),
        Finding::NonManifoldVertices { vertex, .. } => mesh("non-manifold-vertices")
            .vertices(&[*vertex])
            .advice("split the vertex into one per fan of faces, or let cut=True do so"),
        Finding::NonOrientable { edge, .. } => mesh("non-orientable")
            .vertices(edge)
            .advice("a one-sided surface has no conformal map to the plane: separate faces along a one-sided loop"),
        Finding::Reoriented { face, .. } => mesh("reoriented").faces(&[*face]),
        Finding::Components { .. } => mesh("components").advice("split the mesh, and map one component at a time"),
        Finding::Closed { genus: 0 } => {
            mesh("closed").advice("cut it open (cut=True), or leave a face of a triangle mesh out (remove_faces=[f])")
        }
        Finding::Closed { genus: 1 } => {
            mesh("closed").advice("map it whole, with periods (boundary=\"periodic\"), or cut it open (cut=True)")
        }
        Finding::Closed { .. } => mesh("closed").advice("cut it open (cut=True)"),
        Finding::NotADisc { genus: 0, .. } => mesh("not-a-disc")
            .advice("fill all holes but the longest (fill_holes=True), or cut the surface open (cut=True)"),
        Finding::NotADisc { .. } => mesh("not-a-disc").advice("cut the surface open (cut=True)"),
        Finding::Unreferenced { vertex, .. } => mesh("unreferenced").vertices(&[*vertex]),
        Finding::CoincidentVertices { first, .. } => mesh("coincident-vertices").vertices(first),
    }
}

fn raised(error: &MapError) -> Raised {
    let option = |kind| Raised::new(Class::Option, kind);
    let convergence = |kind| Raised::new(Class::Convergence, kind);
    match error {
        error if error.is_of_integral_weights() => Raised::new(Class::Mesh, "non-positive-rho")
            .advice("use dual=\"barycentre\" or weight=\"unit\", or with boundary=\"fixed\" hold=\"primal\""),
        MapError::Surface(error) => surface(error),
        MapError::Options(error) => options(error),
        MapError::NoDisc(error) => cut(error),
        MapError::QuadGraph(error) => quad_graph(error),
        MapError::Periodic(error) => periodic(error),
        MapError::NoConvexQuads { vertex, .. } => Raised::new(Class::Mesh, "no-convex-quads")
            .vertices(&[*vertex])
            .advice("merge the two, or take the map as it is (valid=\"off\")"),
        MapError::NoNormal { face } => Raised::new(Class::Mesh, "no-normal").faces(&[*face as u32]),
        MapError::Normals(NormalError::NotGiven) => option("normals").advice("pass them as face_normals"),
        MapError::Normals(_) | MapError::NormalsOfTriangles => option("normals"),
        MapError::PinOffCircle { vertex, .. } | MapError::PinOutside { vertex, .. } => {
            option("pin").vertices(&[*vertex])
        }
        MapError::PinsOutOfOrder { vertex } => option("pins-out-of-order").vertices(&[*vertex]),
        MapError::NotInUse { vertex } => option("not-in-use").vertices(&[*vertex]),
        MapError::OnTheCut { vertex, .. } => option("on-the-cut")
            .vertices(&[*vertex])
            .advice("hold another vertex, or open the surface elsewhere (remove_faces)"),
        MapError::FreeBoundary => {
            option("energy").advice("hold the boundary (boundary=\"fixed\"), or add C, L or Lb to energy")
        }
        MapError::Lengths(_) => option("lengths"),
        MapError::Energy(EnergyError::NoArea { face, .. }) => Raised::new(Class::Mesh, "no-area").faces(&[*face]),
        MapError::Solve(SolveError::Unsuitable { .. } | SolveError::Unknown { .. }) => option("solver"),
        MapError::Solve(_) => convergence("linear-solver").advice("try another solver (\"qr\" is the most robust)"),
        MapError::Minimise(_) => convergence("minimiser"),
        MapError::Reduced(_) => convergence("boundary-solver").advice("try solver=\"levenberg-marquardt\""),
        MapError::NoValidStart { first, .. } => convergence("no-valid-start")
            .faces(&Vec::from_iter(*first))
            .advice("cut it open with cut=True along a longer line, or take the map as it is (valid=\"off\")"),
        MapError::NotConverged { .. } => {
            convergence("not-converged").advice("try another solver, or max_iterations to get the unfinished map")
        }
        MapError::Constraint(_) => option("constraint"),
        // All others are requests that nothing meets.
        _ => option("request"),
    }
}

fn surface(error: &SurfaceError) -> Raised {
    let mesh = |kind| Raised::new(Class::Mesh, kind);
    match error {
        SurfaceError::TooFewCorners { face, .. } => mesh("too-few-corners").faces(&[*face as u32]),
        SurfaceError::NoSuchVertex { face, vertex, .. } => {
            mesh("no-such-vertex").faces(&[*face as u32]).vertices(&[*vertex])
        }
        SurfaceError::TooManyVertices { .. } | SurfaceError::TooManyCorners { .. } => mesh("too-large"),
        SurfaceError::NormalCount { .. } => mesh("normal-count"),
    }
}

fn options(error: &OptionsError) -> Raised {
    match error {
        OptionsError::PinnedTwice { vertex } => Raised::new(Class::Option, "pinned-twice").vertices(&[*vertex]),
        OptionsError::OtherBoundary { .. } => Raised::new(Class::Option, "other-boundary"),
        OptionsError::Exclusive { .. } => Raised::new(Class::Option, "exclusive").advice("leave one of them out"),
        OptionsError::FixedPoints { .. } => Raised::new(Class::Option, "fix"),
    }
}

fn cut(error: &CutError) -> Raised {
    let mesh = |kind| Raised::new(Class::Mesh, kind);
    match error {
        CutError::NotADisc(_) => mesh("not-a-disc"),
        CutError::NoSuchFace { face, .. } => Raised::new(Class::Option, "no-such-face").faces(&[*face]),
        CutError::NothingLeft => Raised::new(Class::Option, "nothing-left"),
        CutError::Pieces { .. } => Raised::new(Class::Option, "pieces"),
        CutError::Pinched { vertex, .. } => {
            mesh("pinched").vertices(&[*vertex]).advice("let cut=True split such vertices")
        }
        CutError::NoDiscLeft { .. } => mesh("no-disc-left")
            .advice("cut it open (cut=True), or where the genus is 1 map it whole (boundary=\"periodic\")"),
        CutError::NotClosed { .. } => mesh("not-closed").advice("fill the holes (fill_holes=True)"),
        CutError::OddHole { vertex, .. } => {
            mesh("odd-hole").vertices(&[*vertex]).advice("cut it open (cut=True without fill_holes)")
        }
        CutError::FlatHole { vertex, .. } => {
            mesh("flat-hole").vertices(&[*vertex]).advice("cut it open (cut=True without fill_holes)")
        }
    }
}

fn quad_graph(error: &QuadGraphError) -> Raised {
    let mesh = |kind| Raised::new(Class::Mesh, kind);
    match error {
        QuadGraphError::DegenerateQuad { face, vertices } => {
            mesh("degenerate-face").faces(&[*face as u32]).vertices(vertices)
        }
        QuadGraphError::DegenerateTriangle { face, vertices } => {
            mesh("degenerate-face").faces(&[*face as u32]).vertices(vertices)
        }
        QuadGraphError::NormalOffFace { face, .. } => mesh("normal-off-face").faces(&[*face as u32]),
        QuadGraphError::FootOutsideEdge { face, edge } => {
            mesh("foot-outside-edge").faces(&[*face as u32]).vertices(edge).advice("use boundary_dual=\"midpoint\"")
        }
        QuadGraphError::Corners { .. } => mesh("polygons"),
        QuadGraphError::TooLarge { .. } => mesh("too-large"),
    }
}

fn periodic(error: &PeriodicError) -> Raised {
    match error {
        PeriodicError::Homology(HomologyError::Boundary { .. }) => Raised::new(Class::Mesh, "not-closed")
            .advice("map it with boundary=\"circle\" or \"free\", or fill the holes (fill_holes=True)"),
        PeriodicError::Homology(_) => Raised::new(Class::Mesh, "genus").advice("cut it open to a disc (cut=True)"),
        PeriodicError::Periods(_) => Raised::new(Class::Mesh, "periods"),
        PeriodicError::Harmonic(_) | PeriodicError::Differentials(_) | PeriodicError::NotReducible(_) => {
            Raised::new(Class::Convergence, "periods")
        }
    }
}

/// The exception for a file or a name that gives no surface: `OSError` where the system refuses.
pub fn of_input(py: Python<'_>, error: &InputError) -> PyErr {
    match error {
        InputError::Read(ReadError::Io { path, source }) | InputError::Volume(VolumeError::Io { path, source }) => {
            of_system(source, path)
        }
        InputError::Read(_) | InputError::Volume(_) => raise(py, Class::Mesh, &error.to_string(), "file", &[], &[]),
        InputError::Digital { path, source } => {
            raise(py, Class::Mesh, &format!("{path}: {source}"), "voxels", &[], &[])
        }
        InputError::Generate(_) | InputError::NotAVolume { .. } => {
            raise(py, Class::Option, &error.to_string(), "source", &[], &[])
        }
    }
}

/// The exception for voxels that bound no surface.
pub fn of_digital(py: Python<'_>, error: &DigitalError) -> PyErr {
    raise(py, Class::Mesh, &error.to_string(), "voxels", &[], &[])
}

/// The exception for a file that cannot be written.
pub fn of_write(py: Python<'_>, error: &WriteError) -> PyErr {
    match error {
        WriteError::Io { path, source } => of_system(source, path),
        error => raise(py, Class::Option, &error.to_string(), "write", &[], &[]),
    }
}

/// `FileNotFoundError`, `PermissionError` and so on, as Python chooses by the number of the error.
fn of_system(error: &io::Error, path: &Path) -> PyErr {
    let path = path.display().to_string();
    match error.raw_os_error() {
        Some(number) => PyOSError::new_err((number, io::Error::from(error.kind()).to_string(), path)),
        None => PyOSError::new_err(format!("{path}: {error}")),
    }
}
