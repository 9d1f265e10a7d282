//! The report as `--report` writes it: the library's record, the program's version, and the options
//! as understood.

use serde::Serialize;
use serde_json::{Value, json};

use crate::io::{BoundaryLengths, LengthUnit, PerEdge};
use crate::map::{Boundary, Hold, Interior, MapOptions, Outline, Pin, Valid};
use crate::report::Report;

/// The report with the program and the request that made it.
#[derive(Serialize)]
pub(super) struct WrittenReport<'a> {
    riemap: Program,
    options: Value,
    #[serde(flatten)]
    report: &'a Report,
}

/// The program that made a report.
#[derive(Serialize)]
struct Program {
    version: &'static str,
}

impl<'a> WrittenReport<'a> {
    /// Completes a report by this program's version and the options.
    pub(super) fn new(report: &'a Report, options: &MapOptions) -> Self {
        WrittenReport { riemap: Program { version: env!("CARGO_PKG_VERSION") }, options: as_keys(options), report }
    }
}

/// Returns the options, defaults included, by the keys of the `[map]` table of an experiment. Keys
/// that the boundary does not have are absent; a key that is null was not given.
fn as_keys(options: &MapOptions) -> Value {
    // No `..`: a new option does not compile before it is in the report.
    let MapOptions {
        cut,
        fill_holes,
        remove_faces,
        surrogate,
        boundary,
        energy,
        pins,
        // The command line has none.
        constraints: _,
        valid,
        start,
        weight,
        dual,
        boundary_dual,
        rho,
        normals,
        rest,
        solver,
        tolerance,
        max_iterations,
    } = options;
    let mut keys = json!({
        "cut": cut, "fill-holes": fill_holes, "remove-faces": remove_faces, "surrogate": surrogate,
        "energy": energy.as_ref().map(ToString::to_string), "pins": places(pins),
        "valid": match valid {
            Valid::Auto => "auto",
            Valid::BestQc => "best-qc",
            Valid::Off => "off",
        },
        "start": start, "weight": weight, "dual": dual, "boundary-dual": boundary_dual, "rho": rho,
        "normals": normals, "rest": rest, "solver": solver.name(), "tolerance": tolerance, "max-iterations": max_iterations,
    });
    match boundary {
        Boundary::Circle { pinned, ordered } => {
            keys["boundary"] = "circle".into();
            keys["fix"] = pinned.count().into();
            keys["keep-order"] = (*ordered).into();
        }
        Boundary::Free { lengths, overlap } => {
            keys["boundary"] = "free".into();
            keys["boundary-lengths"] = lengths.as_ref().map_or(Value::Null, numbers);
            if !overlap {
                keys["valid"] = "one-to-one".into();
            }
        }
        Boundary::Fixed { on, hold, interior } => {
            keys["boundary"] = "fixed".into();
            match on {
                Outline::Shape(shape) => keys["shape"] = json!(shape),
                Outline::Places(pins) => keys["positions"] = places(pins),
            }
            keys["hold"] = match hold {
                None => Value::Null,
                Some(Hold::Whole) => "whole".into(),
                Some(Hold::Primal) => "primal".into(),
            };
            keys["weights"] = match interior {
                Interior::Energy => Value::Null,
                Interior::Weights(name) => name.as_str().into(),
            };
        }
        Boundary::Periodic => keys["boundary"] = "periodic".into(),
    }
    keys
}

/// Returns pins as a list of `{ vertex, place }`.
fn places(pins: &[Pin]) -> Value {
    pins.iter().map(|pin| json!({ "vertex": pin.vertex, "place": pin.place })).collect()
}

/// Returns boundary lengths as `{ lengths: […] }` or `{ factors: […] }`, whose entries are numbers
/// or `[v, w, number]`.
fn numbers(lengths: &BoundaryLengths) -> Value {
    let values: Value = match &lengths.values {
        PerEdge::InOrder(values) => json!(values),
        PerEdge::ByEnds(edges) => edges.iter().map(|([v, w], number)| json!([v, w, number])).collect(),
    };
    match lengths.unit {
        LengthUnit::Lengths => json!({ "lengths": values }),
        LengthUnit::Factors => json!({ "factors": values }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::{FlatOptions, PinnedPoints};

    /// The keys without those that were not given, and those of pins and lengths, as the options
    /// that they stand for.
    fn read(keys: &Value) -> MapOptions {
        let Value::Object(map) = keys else { panic!("an object") };
        let given: serde_json::Map<_, _> =
            map.iter().filter(|(_, value)| !value.is_null()).map(|(key, value)| (key.clone(), value.clone())).collect();
        let flat: FlatOptions = serde_json::from_value(given.into()).expect("the keys of FlatOptions");
        MapOptions::try_from(flat).expect("options that agree")
    }

    #[test]
    fn options_in_the_report_are_read_as_the_same_options() {
        let pin = Pin { vertex: 3, place: [0.5, -1.0] };
        for options in [
            MapOptions::default(),
            MapOptions { boundary: Boundary::FREE, cut: true, max_iterations: Some(7), ..MapOptions::default() },
            MapOptions { boundary: Boundary::Free { lengths: None, overlap: false }, ..MapOptions::default() },
            MapOptions {
                boundary: Boundary::Circle { pinned: PinnedPoints::Two, ordered: true },
                energy: "H + 0.5 L + A".parse().ok(),
                valid: Valid::Off,
                ..MapOptions::default()
            },
            MapOptions {
                boundary: Boundary::Fixed {
                    on: Outline::Places(vec![pin]),
                    hold: Some(Hold::Primal),
                    interior: Interior::Weights("uniform".to_owned()),
                },
                pins: vec![Pin { vertex: 4, ..pin }],
                surrogate: Some(0.1),
                ..MapOptions::default()
            },
            MapOptions { boundary: Boundary::Periodic, dual: "incentre".to_owned(), ..MapOptions::default() },
        ] {
            assert_eq!(read(&as_keys(&options)), options);
        }
    }
}
