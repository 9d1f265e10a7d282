//! Options of the command line that help with an error. Messages of the library name no options.

use crate::app::compare::verify::VerifyError;
use crate::constraint::ConstraintError;
use crate::energy::EnergyError;
use crate::input::InputError;
use crate::io::{Defect, VolumeError};
use crate::map::periodic::PeriodicError;
use crate::map::{Clash, LengthsError, MapError, OptionsError};
use crate::quad_graph::QuadGraphError;
use crate::solver::boundary::BoundaryError;
use crate::solver::{SolveError, Unsuitable};
use crate::surface::cut::CutError;
use crate::surface::normals::NormalError;
use crate::surface::oriented_mesh::NotADisc;
use crate::surface::topology::diagnosis::Finding;
use crate::surface::topology::homology::HomologyError;

/// Returns advice to append to the message of an error; empty if the message suffices.
pub fn advice(error: &anyhow::Error) -> String {
    match error.chain().find_map(of_cause) {
        Some(lines) if lines.starts_with('\n') => lines,
        Some(advice) => format!("; {advice}"),
        None => String::new(),
    }
}

fn of_cause(cause: &(dyn std::error::Error + 'static)) -> Option<String> {
    if let Some(error) = cause.downcast_ref::<MapError>() {
        return of_map(error);
    }
    if let Some(error) = cause.downcast_ref::<NotADisc>() {
        return Some(of_findings(error));
    }
    if let Some(VerifyError::NotADisc(error)) = cause.downcast_ref::<VerifyError>() {
        return Some(of_findings(error));
    }
    match cause.downcast_ref::<InputError>() {
        Some(InputError::Volume(error)) => of_volume(error),
        _ => cause.downcast_ref::<VolumeError>().and_then(of_volume),
    }
}

fn of_map(error: &MapError) -> Option<String> {
    let advice = match error {
        MapError::Options(error) => return Some(of_options(error)),
        MapError::NoDisc(error) => return of_cut(error),
        MapError::Normals(error) => return of_normals(error).map(str::to_owned),
        MapError::Periodic(error) => return of_periodic(error).map(str::to_owned),
        MapError::Lengths(error) => return of_lengths(error).map(str::to_owned),
        MapError::QuadGraph(error) => return of_quad_graph(error).map(str::to_owned),
        MapError::Constraint(error) => return of_constraint(error).map(str::to_owned),
        MapError::Solve(error) => return of_solve(error).map(str::to_owned),
        MapError::Reduced(error) => return Some(of_boundary(error).to_owned()),
        MapError::Energy(EnergyError::NonPositiveRho(_)) | MapError::NonPositiveRho(_) => NON_POSITIVE_RHO,
        MapError::NoNormal { .. } => "use --rho positions, or --normals auto",
        MapError::NormalsOfTriangles => "--normals and --rho are for quad meshes and digital surfaces: leave them out",
        MapError::SurrogateHeight { .. } => "leave the height of --surrogate out",
        MapError::SurrogateNormals { .. } => "leave --normals and --rho out, or --surrogate",
        MapError::FreeBoundary => "fix the boundary (--boundary fixed), or add C, L or Lb to --energy",
        MapError::PeriodicEnergy { .. } => "leave --energy out, or cut the surface open (--cut)",
        MapError::PeriodicPins => "leave --pin out",
        MapError::PeriodicSolver { .. } => "leave --solver out",
        MapError::PeriodicOpening => "leave --cut and --remove-face out, or choose another --boundary",
        MapError::PinOutside { .. } => "`riemap info --boundary` lists the boundary",
        MapError::NoCircle { .. } => "leave --keep-order out, or add C to --energy",
        MapError::OnTheCut { .. } => "pin another vertex, or open the surface elsewhere (--remove-face)",
        MapError::WeightsOfNothing { clash: Clash::Energy, .. } => "leave --energy out, or --weights",
        MapError::WeightsOfNothing { clash: Clash::Solver, .. } => "leave --solver out, or --weights",
        MapError::NoValidStart { .. } => {
            "cut it open with --cut along a longer line, or take the map as it is (--valid off)"
        }
        MapError::NoConvexQuads { .. } => "merge the two, or take the map as it is (--valid off)",
        MapError::NotConverged { .. } => "try another --solver, or --max-iterations to get the unfinished map",
        MapError::Surface(_)
        | MapError::PlaceCount { .. }
        | MapError::NotADiscMap
        | MapError::UnknownDual { .. }
        | MapError::NotAMinimiser { .. }
        | MapError::Undetermined { .. }
        | MapError::Tolerance { .. }
        | MapError::PinsOutOfOrder { .. }
        | MapError::PinOffCircle { .. }
        | MapError::NotInUse { .. }
        | MapError::Convex(_)
        | MapError::Energy(EnergyError::NoArea { .. })
        | MapError::Minimise(_) => return None,
    };
    Some(advice.to_owned())
}

const NON_POSITIVE_RHO: &str = "use --dual barycentre or --weight unit, or with --boundary fixed pin only the boundary of the mesh (--hold primal)";

const CUT: &str = "cut the surface open (--cut)";

const UNFILLED: &str = "cut it open (--cut without --fill-holes)";

fn of_options(error: &OptionsError) -> String {
    match error {
        OptionsError::OtherBoundary { key: "boundary-lengths", .. } => {
            "boundary lengths are kept by L': use --boundary free, or add Lb to --energy".to_owned()
        }
        OptionsError::OtherBoundary { key, of, .. } => format!("use --{key} with --boundary {}", of.name()),
        OptionsError::Exclusive { first, second } => format!("leave --{first} or --{second} out"),
        OptionsError::FixedPoints { .. } => "use --fix 3, or --fix 2".to_owned(),
        OptionsError::PinnedTwice { .. } => "leave one of the two --pin out".to_owned(),
    }
}

fn of_cut(error: &CutError) -> Option<String> {
    let advice = match error {
        CutError::NotADisc(error) => return Some(of_findings(error)),
        CutError::Pinched { .. } => "let --cut split such vertices",
        CutError::NoDiscLeft { .. } => {
            "cut it open (--cut), or where the genus is 1 map it whole (--boundary periodic)"
        }
        CutError::NotClosed { .. } => "fill the holes (--fill-holes)",
        CutError::OddHole { .. } | CutError::FlatHole { .. } => UNFILLED,
        CutError::NoSuchFace { .. } | CutError::NothingLeft | CutError::Pieces { .. } => return None,
    };
    Some(advice.to_owned())
}

/// Returns the advice on each finding; several findings have one line each.
fn of_findings(error: &NotADisc) -> String {
    match &error.findings[..] {
        [finding] => format!("{} (`riemap info` tells more)", of_finding(finding)),
        findings => findings.iter().map(|finding| format!("\n→ {}", of_finding(finding))).collect(),
    }
}

/// Returns what the user can do about a finding, or what the program did about it.
pub fn of_finding(finding: &Finding) -> &'static str {
    match finding {
        Finding::NoFaces => "give a mesh with faces",
        Finding::NotFinite { .. } => "correct the coordinates",
        Finding::OutOfRange { .. } => "rescale the coordinates: conformal maps do not depend on the unit of length",
        Finding::Polygons { .. } => {
            "triangulate all faces, or make all of them quads: meshes of triangles only or of quads only can be mapped"
        }
        Finding::RepeatedVertex { .. } => "remove the repeated corner, or the face",
        Finding::DuplicateFaces { .. } => "remove all but one of each set",
        Finding::ZeroLengthEdges { fatal: true, .. } => {
            "merge the two end vertices (collapse the edge), or give its faces a shape (--surrogate)"
        }
        Finding::ZeroLengthEdges { .. } => "quads are mapped through their diagonals; nothing need be done",
        Finding::ZeroAreaFaces { .. } => {
            "remove or collapse the face, or move a vertex, or have it mapped by a shape of its own (--surrogate)"
        }
        Finding::Surrogates { .. } => {
            "the output keeps them as they are, and the distortion leaves them out; a smaller height disturbs their neighbours less \
             (--surrogate=HEIGHT)"
        }
        Finding::NonManifoldEdges { .. } => "remove surplus faces, or split the edge into one per pair of faces",
        Finding::NonManifoldVertices { .. } => "split the vertex into one per fan of faces, or let --cut do so",
        Finding::NonOrientable { .. } => {
            "a one-sided surface has no conformal map to the plane, and is not cut: separate faces along a one-sided loop"
        }
        Finding::Reoriented { .. } => "they are reoriented for the map; the output keeps the faces as they were",
        Finding::Components { .. } => "split the mesh, and map one component at a time",
        Finding::Closed { genus: 0 } => "cut it open (--cut), or remove a face of a triangle mesh (--remove-face F)",
        Finding::Closed { genus: 1 } => "map it whole, with periods (--boundary periodic), or cut it open (--cut)",
        Finding::Closed { .. } => "cut it open (--cut)",
        Finding::NotADisc { genus: 0, .. } => {
            "fill all holes but the longest (--fill-holes), or cut the surface open (--cut)"
        }
        Finding::NotADisc { genus: 1, .. } => {
            "cut the surface open (--cut), or fill the holes and map it whole (--fill-holes --boundary periodic)"
        }
        Finding::NotADisc { .. } => CUT,
        Finding::Unreferenced { .. } => "they are ignored, and written with the texture coordinate 0 0",
        Finding::CoincidentVertices { .. } => "if the surface should be connected there, weld the vertices first",
    }
}

fn of_normals(error: &NormalError) -> Option<&'static str> {
    match error {
        NormalError::NotDigital { .. } => Some("use --normals auto, convolution or hat"),
        NormalError::NotExact { .. } | NormalError::NotGiven => Some("use --normals auto"),
        NormalError::Spec(_) | NormalError::Parameter(_) => None,
        NormalError::NoArea { .. } | NormalError::OtherSurfels { .. } => None,
    }
}

fn of_periodic(error: &PeriodicError) -> Option<&'static str> {
    match error {
        PeriodicError::Homology(HomologyError::Boundary { .. }) => {
            Some("map it with --boundary circle or free, or fill the holes (--fill-holes)")
        }
        PeriodicError::Homology(HomologyError::Sphere) => {
            Some("cut it open (--cut), or remove a face (--remove-face), for a map to the disc")
        }
        PeriodicError::Homology(HomologyError::Genus { .. }) => Some("cut it open to a disc (--cut)"),
        PeriodicError::Homology(_) | PeriodicError::Periods(_) => None,
        PeriodicError::Harmonic(_) | PeriodicError::Differentials(_) | PeriodicError::NotReducible(_) => None,
    }
}

fn of_lengths(error: &LengthsError) -> Option<&'static str> {
    match error {
        LengthsError::NotKept { .. } => Some("use --boundary free, or add Lb to --energy"),
        LengthsError::Count { .. } => Some("`riemap info --boundary` lists the boundary, first vertex first"),
        LengthsError::NoSuchEdge { .. } => Some("`riemap info --boundary` lists the boundary's vertices"),
        LengthsError::Missing { .. } | LengthsError::Ambiguous { .. } | LengthsError::Open { .. } => None,
    }
}

fn of_quad_graph(error: &QuadGraphError) -> Option<&'static str> {
    match error {
        QuadGraphError::NormalOffFace { .. } => Some("take ρ from the positions (--rho positions)"),
        QuadGraphError::FootOutsideEdge { .. } => Some("use the midpoint (--boundary-dual midpoint)"),
        _ => None,
    }
}

fn of_constraint(error: &ConstraintError) -> Option<&'static str> {
    match error {
        ConstraintError::TooFewBoundaryVertices { .. } => Some("use --shape circle"),
        ConstraintError::NoArcLength(..) => Some("merge them, or give the edge a length (--surrogate)"),
        ConstraintError::NoSuchVertex { .. }
        | ConstraintError::NotFinite { .. }
        | ConstraintError::TooFar { .. }
        | ConstraintError::Underdetermined { .. }
        | ConstraintError::Afloat { .. } => None,
    }
}

fn of_solve(error: &SolveError) -> Option<&'static str> {
    Some(match error {
        SolveError::Unsuitable { reason, .. } => match reason {
            Unsuitable::NotSquare { .. } => "use --hold primal",
            Unsuitable::FreeBoundary { .. } => "use --hold whole",
            Unsuitable::UnitWeights => "use --weight integral",
            Unsuitable::NonPositiveRho(_) => NON_POSITIVE_RHO,
            Unsuitable::NotOrthogonal { .. } => "use --dual circumcentre",
            Unsuitable::NotPrimal => "use --hold primal",
        },
        SolveError::NotPositiveDefinite { .. } => "try --solver lu or qr, or another --dual",
        SolveError::Inaccurate { .. } => "try another --solver (qr is the most robust), or another --dual",
        SolveError::Unknown { .. } | SolveError::Singular { .. } | SolveError::TooLarge { .. } => return None,
    })
}

fn of_boundary(error: &BoundaryError) -> &'static str {
    match error {
        BoundaryError::NonPositiveRho(_) => NON_POSITIVE_RHO,
        BoundaryError::Unsuitable { .. }
        | BoundaryError::Factorisation { .. }
        | BoundaryError::Stalled { .. }
        | BoundaryError::Laplacian(_)
        | BoundaryError::TwoCircles(_) => "use --solver levenberg-marquardt",
    }
}

fn of_volume(error: &VolumeError) -> Option<String> {
    match error {
        VolumeError::Superfluous { key, .. } => Some(format!("leave --{key} out")),
        VolumeError::SizeNeeded { .. } => Some("say it with --size XxYxZ".to_owned()),
        VolumeError::Empty { most, .. } if *most > f64::NEG_INFINITY => Some("choose a smaller --threshold".to_owned()),
        VolumeError::Parse { source, .. } if matches!(source.defect, Defect::Length { .. }) => {
            Some("check --size and --type".to_owned())
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_finding_says_what_to_do() {
        use Finding::*;
        for (finding, advice) in [
            (NoFaces, "give a mesh"),
            (NotFinite { vertex: 17, count: 2 }, "correct the coordinates"),
            (Polygons { arities: vec![(3, 8), (5, 1)], first: 17 }, "triangulate"),
            (RepeatedVertex { face: 17, vertex: 4, count: 1 }, "remove"),
            (DuplicateFaces { first: [3, 17], count: 12 }, "remove"),
            (ZeroLengthEdges { edge: [3, 17], count: 1, fatal: true }, "merge"),
            (ZeroLengthEdges { edge: [3, 17], count: 1, fatal: false }, "nothing"),
            (ZeroAreaFaces { face: 17, count: 1 }, "remove or collapse"),
            (NonManifoldEdges { edge: [3, 17], faces: (0..8).collect(), count: 2 }, "split"),
            (NonManifoldVertices { vertex: 17, fans: 3, count: 1 }, "let --cut"),
            (NonOrientable { component: 0, edge: [3, 17] }, "is not cut"),
            (Reoriented { face: 17, count: 5 }, "reoriented for the map"),
            (Components { count: 3, faces: vec![9, 8, 7] }, "one component at a time"),
            (Closed { genus: 0 }, "--remove-face"),
            (Closed { genus: 1 }, "--boundary periodic"),
            (Closed { genus: 2 }, "--cut"),
            (NotADisc { boundary_loops: vec![9, 8], genus: 0 }, "--fill-holes"),
            (NotADisc { boundary_loops: vec![9], genus: 1 }, "--fill-holes --boundary"),
            (NotADisc { boundary_loops: vec![9], genus: 2 }, "--cut"),
            (Unreferenced { vertex: 17, count: 1 }, "ignored"),
            (CoincidentVertices { first: [3, 17], count: 1 }, "weld"),
        ] {
            assert!(of_finding(&finding).contains(advice), "{finding:?}: {}", of_finding(&finding));
        }
    }
}
