use crate::surface::generate::random::Random;
use crate::surface::generate::{Form, Parameter, SurfaceKind};

/// The distance from the centre at which a spike has decreased to e^{−1/2} of its height.
const WIDTH: f64 = 0.05;

/// Narrow Gaussian spikes on a plane.
pub(in super::super) const SPIKES: SurfaceKind = SurfaceKind {
    name: "spikes",
    about: "z = height Σ exp(−|p − c|²/0.005) over [−1, 1]², the centres c at random",
    parameters: &[
        SurfaceKind::VERTICES,
        &[
            Parameter::real("height", 2.0, -100.0, 100.0, "of the spikes, which are 0.1 wide"),
            Parameter::whole("count", 12, 1, 1000, "of spikes"),
        ],
        SurfaceKind::MESH,
    ],
    form: Form::Square(|arguments| {
        let (height, count) = (arguments.real("height")?, arguments.whole("count")?);
        let mut random = Random::new(arguments.whole("seed")?);
        let centres: Vec<[f64; 2]> = (0..count).map(|_| random.square_around([0.0, 0.0], 0.85)).collect();
        Ok(Box::new(move |[s, t]| {
            let spike = |c: &[f64; 2]| {
                let (x, y) = (s - c[0], t - c[1]);
                (-0.5 * (x * x + y * y) / (WIDTH * WIDTH)).exp()
            };
            [s, t, height * centres.iter().map(spike).sum::<f64>()]
        }))
    }),
    exact: false,
};

/// A graph with random heights, whose triangles have every quality.
pub(in super::super) const ROUGH: SurfaceKind = SurfaceKind {
    name: "rough",
    about: "z uniform in [−height, height] over [−1, 1]², another at every vertex: needles and obtuse triangles throughout",
    parameters: &[
        SurfaceKind::VERTICES,
        &[Parameter::real(
            "height",
            0.5,
            0.0,
            1000.0,
            "half the range of z; the finer the mesh, the steeper its faces",
        )],
        SurfaceKind::MESH,
    ],
    form: Form::Square(|arguments| {
        let (height, seed) = (arguments.real("height")?, arguments.whole("seed")?);
        Ok(Box::new(move |[s, t]| {
            // The height depends only on the point, whatever the order of evaluation; −0 counts as
            // 0.
            let [s_bits, t_bits] = [s, t].map(|x| (x + 0.0).to_bits());
            let mut random = Random::new(seed ^ s_bits ^ t_bits.rotate_left(32));
            random.bits();
            [s, t, height * random.symmetric()]
        }))
    }),
    exact: false,
};
