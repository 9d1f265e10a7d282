//! Names of generated surfaces: what is understood, and what is said otherwise.

use proptest::prelude::*;
use riemap::surface::generate::{
    Form, GenerateError, Immersion, Parameter, SURFACES, SurfaceKind, Values, generate, generate_from,
    is_generated_name,
};
use riemap::surface::parameters::ParameterError;

fn message(source: &str) -> String {
    generate(source).expect_err(source).to_string()
}

#[test]
fn errors_say_what_is_possible() {
    let unknown = message("spheer?n=3");
    assert!(unknown.contains("spheer"));
    assert!(SURFACES.iter().all(|row| unknown.contains(row.name)), "{unknown}");
    assert!(
        message("sphere?m=3").contains("no parameter `m`") && message("sphere?m=3").contains("n=32&scale=1&mesh=quad")
    );
    assert!(message("sphere?n=4097").contains("allowed: 2 to 4096"));
    assert!(message("sphere?n=99999999999999999999999").contains("allowed: 2 to 4096"));
    assert!(message("sphere?n=2.5").contains("not a whole number"));
    assert!(message("sphere?n=-1").contains("not a whole number"));
    assert!(message("sphere?n=").contains("not a whole number"));
    assert!(message("sphere?scale=NaN").contains("allowed: 0.01 to 10"));
    assert!(message("sphere?scale=x").contains("not a number"));
    assert!(message("sphere?mesh=hexagon").contains("allowed: quad, triangle, delaunay"));
    assert!(message("sphere?n").contains("not of the form parameter=value"));
    assert!(message("sphere?n=3&n=3").contains("given twice"));
    assert!(message("sphere?diagonal=same").contains("no effect with mesh=quad; it needs mesh=triangle"));
    assert!(message("sphere?n=3000&mesh=delaunay").contains("with mesh=delaunay; allowed: at most 2048"));
    assert!(message("torus?R=1&r=1").contains("r=1 is not allowed with R=1; allowed: at most 0.99"));
    assert!(message("pseudosphere?scale=3").contains("at least 4.05"));
    assert!(message("torus-patch?scale=2").contains("at most 1.7"));
}

#[test]
fn a_name_is_a_file_when_it_exists_or_looks_like_a_path() {
    for name in ["sphere", "graph:cos+cos?n=33", "sphere?scale=0.5", "spheer?n=3", "nothing"] {
        assert!(is_generated_name(name), "{name}");
    }
    for name in ["", "?", "sphere.obj", "a/sphere", "a\\b", "./sphere", "mesh.off?x", "LICENCE.txt"] {
        assert!(!is_generated_name(name), "{name}");
    }
    let folder = std::env::temp_dir().join(format!("riemap-generate-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let file = folder.join("sphere");
    std::fs::write(&file, "OFF").unwrap();
    assert!(!is_generated_name(file.to_str().unwrap()));
    std::fs::remove_dir_all(&folder).unwrap();
}

/// A kind of surface from outside the crate.
const PARABOLOID: SurfaceKind = SurfaceKind {
    name: "paraboloid",
    about: "z = a (s² + t²) over [−1, 1]²",
    parameters: &[SurfaceKind::VERTICES, &[Parameter::real("a", 1.0, 0.0, 5.0, "steepness")], SurfaceKind::MESH],
    form: Form::Square(|arguments| {
        let a = arguments.real("a")?;
        let immersion: Immersion = Box::new(move |[s, t]| [s, t, a * (s * s + t * t)]);
        Ok(immersion)
    }),
    exact: false,
};

#[test]
fn a_new_surface_is_one_row() {
    let g = generate_from(&[PARABOLOID], "paraboloid?n=3&a=2&mesh=triangle").unwrap();
    assert_eq!(g.surface.positions()[0], [-1.0, -1.0, 4.0]);
    assert_eq!(g.name, "paraboloid?n=3&a=2&mesh=triangle&diagonal=alternate&jitter=0&seed=0");
    let error = generate_from(&[PARABOLOID], "sphere").unwrap_err();
    assert!(matches!(&error, GenerateError::UnknownSurface { known, .. } if known == "paraboloid"));
    let wrong =
        SurfaceKind { form: Form::Square(|a| Err(a.real("b").expect_err("not declared").into())), ..PARABOLOID };
    let undeclared = generate_from(&[wrong], "paraboloid").unwrap_err();
    assert_eq!(undeclared, ParameterError::Undeclared { subject: "paraboloid", parameter: "b" }.into());
}

#[test]
fn the_table_is_consistent() {
    for (i, row) in SURFACES.iter().enumerate() {
        assert!(SURFACES[..i].iter().all(|other| other.name != row.name), "{} stands twice", row.name);
        assert!(is_generated_name(row.name) && !row.about.is_empty());
        let g = generate(row.name).unwrap();
        assert_eq!(row.exact, g.exact.is_some() || g.period.is_some(), "{}", row.name);
        // parameter types and conditions are declared as used: both ends of every range either work or say why not
        for p in row.all_parameters().filter(|p| p.name != "n") {
            let ends = match p.values {
                Values::Whole { min, max, .. } => vec![min.to_string(), max.to_string()],
                Values::Real { min, max, .. } => vec![min.to_string(), max.to_string()],
                Values::Choice(words) => words.iter().map(|w| w.to_string()).collect(),
            };
            let condition = p.only_with.map(|(name, values)| format!("{name}={}&", values[0])).unwrap_or_default();
            for end in ends {
                let small = if row.all_parameters().any(|p| p.name == "n") { "n=4&" } else { "" };
                match generate(&format!("{}?{small}{condition}{}={end}", row.name, p.name)) {
                    Ok(_) => {}
                    Err(GenerateError::Parameters(ParameterError::OutOfRange { circumstance, .. }))
                        if !circumstance.is_empty() => {}
                    Err(error) => panic!("{error}"),
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_text_makes_the_parser_panic(text in ".*") {
        let _ = is_generated_name(&text);
        prop_assert!(generate(&text).is_err());
    }

    #[test]
    fn no_parameters_make_the_generator_panic(
        row in 0..SURFACES.len(),
        pairs in prop::collection::vec(
            ("(n|mesh|diagonal|jitter|points|seed|c|k|scale|R|r|angle|x|)", "=?", "(quad|triangle|delaunay|random|same|nan|-?inf|-?[0-9]{1,2}(\\.[0-9]{1,2})?|1e[0-9]{1,3}|.*)"),
            0..5,
        ),
    ) {
        let query: Vec<String> = pairs.iter().map(|(a, b, c)| format!("{a}{b}{c}")).collect();
        if let Ok(g) = generate(&format!("{}?{}", SURFACES[row].name, query.join("&"))) {
            prop_assert!(g.surface.positions().iter().flatten().all(|x| x.is_finite()));
        }
    }
}
