//! Names of normal estimators: what is understood, what is said otherwise, and a new one from outside the crate.

use crate::common::dot;
use riemap::surface::digital::Digital;
use riemap::surface::edges::Edges;
use riemap::surface::generate::generate;
use riemap::surface::normals::{
    Facets, NORMAL_ESTIMATORS, NormalError, NormalEstimator, NormalSpec, NormalSpecError, estimate,
};
use riemap::surface::parameters::{Arguments, Parameter};
use riemap::surface::{Surface, digital::Surfel};

fn attempt(surface: &Surface, digital: Option<&Digital>, spec: &str) -> Result<Vec<[f64; 3]>, NormalError> {
    let edges = Edges::new(surface.faces(), surface.positions().len());
    estimate(spec, &Facets::new(surface, &edges, digital)?)
}

/// A generated digital surface.
#[track_caller]
fn digital(name: &str) -> (Surface, Digital) {
    let generated = generate(name).unwrap_or_else(|error| panic!("{error}"));
    (generated.surface, generated.digital.expect("digital"))
}

#[test]
fn errors_say_what_is_missing_and_what_is_possible() {
    let message = |spec: &str| spec.parse::<NormalSpec>().expect_err(spec).to_string();
    let unknown = message("hut?radius=3");
    assert!(unknown.contains("`hut`") && NORMAL_ESTIMATORS.iter().all(|e| unknown.contains(e.name())), "{unknown}");
    assert!(message("hat?size=3").contains("hat has no parameter `size`; known: radius=0&c="));
    assert!(message("hat?radius=-1").contains("allowed: 0 to 100"));
    assert!(message("hat?radius=3&c=2").contains("c has no effect with radius=3; it needs radius=0"));
    assert!(message("hat?ball=cube").contains("allowed: euclidean, geodesic"));
    assert!(message("surfel?radius=1").contains("no parameter `radius`"));

    let (surface, digital) = digital("digital-ball?R=4");
    let mesh = |spec: &str| attempt(&surface, None, spec).expect_err(spec);
    assert_eq!(mesh("integral-invariant"), NormalError::NotDigital { estimator: "integral-invariant" });
    assert!(mesh("exact").to_string().contains("digital-torus"));
    assert_eq!(mesh("file"), NormalError::NotGiven);
    assert!(matches!(mesh("nothing"), NormalError::Spec(NormalSpecError::Unknown { .. })));
    let fewer = Digital { surfels: digital.surfels[1..].to_vec(), ..digital.clone() };
    let faces = digital.surfels.len();
    assert_eq!(attempt(&surface, Some(&fewer), "auto"), Err(NormalError::OtherSurfels { faces, surfels: faces - 1 }));
    let flat =
        crate::common::surface(vec![[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 0.0, 0.0]], [[0, 1, 2, 3]]);
    assert_eq!(attempt(&flat, None, "auto"), Err(NormalError::NoArea { face: 0 }));
}

#[test]
fn a_name_is_read_back_as_it_is_written() {
    for text in ["auto", "surfel", "hat?radius=4&ball=geodesic", "two-pass?c=2.5", "convolution?radius=1.5"] {
        let spec: NormalSpec = text.parse().unwrap();
        assert_eq!(spec.to_string().parse::<NormalSpec>().unwrap(), spec);
        let json = serde_json::to_string(&spec).unwrap();
        assert_eq!(serde_json::from_str::<NormalSpec>(&json).unwrap(), spec);
    }
    assert_eq!("hat?radius=4".parse::<NormalSpec>().unwrap().to_string(), "hat?radius=4&ball=euclidean");
    assert_eq!(NormalSpec::default(), "auto".parse().unwrap());
    assert!(serde_json::from_str::<NormalSpec>("\"hut\"").unwrap_err().to_string().contains("known: auto"));
}

/// The axis turned by an angle about z: from outside the crate.
struct Turned;

impl NormalEstimator for Turned {
    fn name(&self) -> &'static str {
        "turned"
    }

    fn about(&self) -> &'static str {
        "own normal, turned about z"
    }

    fn parameters(&self) -> &'static [Parameter] {
        const ANGLE: [Parameter; 1] = [Parameter::real("angle", 0.0, -1.0, 1.0, "in radians")];
        &ANGLE
    }

    fn estimate(&self, facets: &Facets, arguments: &Arguments) -> Result<Vec<[f64; 3]>, NormalError> {
        let (sin, cos) = arguments.real("angle")?.sin_cos();
        Ok(facets.normal.iter().map(|&[x, y, z]| [cos * x - sin * y, sin * x + cos * y, z]).collect())
    }
}

#[test]
fn a_new_estimator_is_one_row() {
    let (surface, digital) = digital("digital-ball?R=3");
    let edges = Edges::new(surface.faces(), surface.positions().len());
    let facets = Facets::new(&surface, &edges, Some(&digital)).unwrap();
    let spec = NormalSpec::parse_from(&[&Turned], "turned?angle=0.5").unwrap();
    assert_eq!((spec.name(), spec.to_string()), ("turned", "turned?angle=0.5".to_string()));
    let axis = |surfel: &Surfel| surfel.normal();
    for (n, own) in spec.estimate(&facets).unwrap().iter().zip(digital.surfels.iter().map(axis)) {
        assert!((dot(*n, own) - if own[2] != 0.0 { 1.0 } else { 0.5_f64.cos() }).abs() < 1e-15);
    }
}
