use crate::surface::generate::{Form, Immersion, SURFACES, name};

/// Names with parameters other than the defaults, tested beside the defaults of every row.
const MORE: &[&str] = &[
    "plane?c=-0.49",
    "plane?c=0",
    "plane-power?c=-0.9&k=7",
    "plane-exp?c=3",
    "plane-exp?c=0.01",
    "cylinder?c=0.4&radius=0.5",
    "sphere?scale=3",
    "enneper?scale=1.7",
    "catenoid?angle=90&scale=2",
    "catenoid?angle=37.5",
    "pseudosphere?scale=2&height=3.5",
    "torus-patch?R=3&r=0.7&scale=0.4",
];

fn immersion(source: &str) -> Option<Immersion> {
    let (row, arguments) = name::parse(SURFACES, source).unwrap();
    match row.form {
        Form::Disc(form) => Some(form(&arguments).unwrap()),
        _ => None,
    }
}

fn all_immersions() -> Vec<(&'static str, Immersion)> {
    let names = SURFACES.iter().map(|row| row.name).chain(MORE.iter().copied());
    names.filter_map(|name| Some((name, immersion(name)?))).collect()
}

fn sample() -> impl Iterator<Item = [f64; 2]> {
    (0..60).map(|k| {
        let (radius, angle) = (((f64::from(k) + 0.5) / 60.0).sqrt() * 0.93, f64::from(k) * 2.399_963);
        [radius * angle.cos(), radius * angle.sin()]
    })
}

/// ∂X along `direction` by central differences of order 8. With step 0.008 truncation and rounding
/// are both about 1e-13 of the largest values that occur.
fn derivative(x: &Immersion, [u, v]: [f64; 2], direction: [f64; 2]) -> [f64; 3] {
    let step = 0.008;
    let weights = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    let mut sum = [0.0; 3];
    for (k, weight) in (1..).zip(weights) {
        let t = step * f64::from(k);
        let ahead = x([u + t * direction[0], v + t * direction[1]]);
        let behind = x([u - t * direction[0], v - t * direction[1]]);
        for i in 0..3 {
            sum[i] += weight * (ahead[i] - behind[i]) / step;
        }
    }
    sum
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

#[test]
fn every_immersion_of_the_disc_is_conformal() {
    for (name, x) in all_immersions() {
        for w in sample() {
            let (xu, xv) = (derivative(&x, w, [1.0, 0.0]), derivative(&x, w, [0.0, 1.0]));
            let (e, f, g) = (dot(xu, xu), dot(xu, xv), dot(xv, xv));
            assert!(e > 1e-6, "{name}: X_u vanishes at {w:?}");
            let error = ((e - g).abs() + f.abs()) / (e + g);
            assert!(error < 1e-10, "{name}: not conformal at {w:?}: E {e}, F {f}, G {g}");
        }
    }
}

#[test]
fn the_cylinder_is_isometric_to_its_plane() {
    let (rolled, flat) = (immersion("cylinder?c=0.3&radius=0.6").unwrap(), immersion("plane?c=0.3").unwrap());
    for w in sample() {
        for direction in [[1.0, 0.0], [0.0, 1.0], [0.6, 0.8]] {
            let (a, b) = (derivative(&rolled, w, direction), derivative(&flat, w, direction));
            assert!((dot(a, a) - dot(b, b)).abs() < 1e-10, "at {w:?} along {direction:?}");
        }
    }
}

#[test]
fn surfaces_lie_on_their_quadric_or_solve_their_equation() {
    let (sphere, enneper) = (immersion("sphere?scale=2").unwrap(), immersion("enneper?scale=0.5").unwrap());
    let (catenoid, helicoid) = (immersion("catenoid").unwrap(), immersion("catenoid?angle=90").unwrap());
    let tube = immersion("torus-patch?R=3&r=0.7&scale=0.4").unwrap();
    for w in sample() {
        let p = sphere(w);
        assert!((dot(p, p) - 1.0).abs() < 1e-14);
        let [x, y, z] = catenoid(w);
        assert!((x.hypot(y) - z.cosh()).abs() < 1e-14);
        let [x, y, z] = helicoid(w);
        assert!((x * z.cos() + y * z.sin()).abs() < 1e-14, "the axis and a ruling at height z: x : y = sin z : −cos z");
        let [x, y, z] = tube(w);
        assert!(((x.hypot(y) - 3.0).hypot(z) - 0.7).abs() < 1e-14);
        // Enneper's formula u − u³/3 + uv², −(−v + v³/3 − vu²), u² − v² at u + iv = w/2.
        let [u, v] = w.map(|x| x / 2.0);
        let expected = [u - u.powi(3) / 3.0 + u * v * v, v - v.powi(3) / 3.0 + v * u * u, u * u - v * v];
        assert!((0..3).all(|i| (enneper(w)[i] - expected[i]).abs() < 1e-15));
    }
}
