use super::cells::{PARAMETERS, region};
use crate::surface::generate::{Form, Parameter, SurfaceKind};

/// A comb with long teeth: almost all of its circle map is crowded into a few small regions.
pub(in super::super) const COMB: SurfaceKind = SurfaceKind {
    name: "comb",
    about: "flat: teeth of width 1, 1 apart, on a back of width 1; n squares along a unit",
    parameters: &[
        &[
            Parameter::whole("teeth", 6, 1, 1000, "how many"),
            Parameter::whole("length", 6, 1, 1000, "of the teeth, in their widths"),
        ],
        PARAMETERS,
    ],
    form: Form::Whole(|arguments| {
        let [teeth, length] = [arguments.whole("teeth")? as i32, arguments.whole("length")? as i32];
        let back = (0..2 * teeth - 1).map(|x| [x, 0]);
        let teeth = (0..teeth).flat_map(|k| (1..=length).map(move |y| [2 * k, y]));
        region(arguments, &back.chain(teeth).collect::<Vec<_>>())
    }),
    exact: false,
};

/// A strip rolled up to a spiral.
pub(in super::super) const SPIRAL: SurfaceKind = SurfaceKind {
    name: "spiral",
    about: "flat: a strip of width 1 rolled up with square corners, 1 between its rounds; n squares along a unit",
    parameters: &[&[Parameter::whole("rounds", 3, 1, 100, "how many")], PARAMETERS],
    form: Form::Whole(|arguments| {
        let rounds = arguments.whole("rounds")? as i32;
        let mut units = vec![[0, 0]];
        let mut at = [0, 0];
        for leg in 0..4 * rounds {
            let [dx, dy] = [[1, 0], [0, 1], [-1, 0], [0, -1]][(leg % 4) as usize];
            for _ in 0..2 * (leg / 2 + 1) {
                at = [at[0] + dx, at[1] + dy];
                units.push(at);
            }
        }
        region(arguments, &units)
    }),
    exact: false,
};

/// A region whose boundary is a staircase, as in an image of a slanted edge.
pub(in super::super) const STAIRCASE: SurfaceKind = SurfaceKind {
    name: "staircase",
    about: "flat: the unit squares with middles in |x| + |y| < size; n squares along a unit",
    parameters: &[&[Parameter::whole("size", 8, 1, 1000, "half the diagonal")], PARAMETERS],
    form: Form::Whole(|arguments| {
        let size = arguments.whole("size")? as i32;
        let inside = |[x, y]: [i32; 2]| (2 * x + 1).abs() + (2 * y + 1).abs() <= 2 * size;
        let all = (-size..size).flat_map(|y| (-size..size).map(move |x| [x, y]));
        region(arguments, &all.filter(|&unit| inside(unit)).collect::<Vec<_>>())
    }),
    exact: false,
};
