//! The JSON schema of the report, `schema/report.json`, and reports of every kind checked against it.

use serde_json::{Value, json};

use super::shell::{Shell, hill};

/// Describes where `value` does not obey `schema`, or has a field that the schema does not describe. Knows the keywords
/// that the schema uses, and refuses others.
fn faults(schema: &Value, value: &Value, at: &str) -> Vec<String> {
    let mut faults = Vec::new();
    for (keyword, rule) in schema.as_object().unwrap() {
        let obeyed = match keyword.as_str() {
            "$schema" | "title" | "description" => true,
            "type" => match rule {
                Value::Array(types) => types.iter().any(|name| is(value, name.as_str().unwrap())),
                name => is(value, name.as_str().unwrap()),
            },
            "enum" => rule.as_array().unwrap().contains(value),
            "minimum" => value.as_f64().is_none_or(|number| number >= rule.as_f64().unwrap()),
            "exclusiveMinimum" => value.as_f64().is_none_or(|number| number > rule.as_f64().unwrap()),
            "minItems" => value.as_array().is_none_or(|items| items.len() as u64 >= rule.as_u64().unwrap()),
            "maxItems" => value.as_array().is_none_or(|items| items.len() as u64 <= rule.as_u64().unwrap()),
            "items" => {
                for (k, item) in value.as_array().into_iter().flatten().enumerate() {
                    faults.extend(self::faults(rule, item, &format!("{at}/{k}")));
                }
                true
            }
            "required" => value.as_object().is_none_or(|fields| {
                rule.as_array().unwrap().iter().all(|name| fields.contains_key(name.as_str().unwrap()))
            }),
            "properties" => {
                for (name, field) in value.as_object().into_iter().flatten() {
                    match rule.get(name) {
                        Some(rule) => faults.extend(self::faults(rule, field, &format!("{at}/{name}"))),
                        None => faults.push(format!("{at}/{name} is not in the schema: describe it there")),
                    }
                }
                true
            }
            other => panic!("{at}: this test does not know the keyword {other}"),
        };
        if !obeyed {
            faults.push(format!("{at}: {value} breaks {keyword} {rule}"));
        }
    }
    faults
}

fn is(value: &Value, name: &str) -> bool {
    match name {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "boolean" => value.is_boolean(),
        "null" => value.is_null(),
        "number" => value.is_number(),
        "integer" => value.is_i64() || value.is_u64(),
        other => panic!("there is no type {other}"),
    }
}

fn schema() -> Value {
    serde_json::from_str(include_str!("../../../schema/report.json")).unwrap()
}

fn report(shell: &Shell, arguments: &[&str]) -> Value {
    let ran = shell.run(&[&["map", "--quiet", "--report", "r.json"], arguments].concat());
    assert!(ran.code == 0 || ran.code == 3, "{arguments:?}: {}", ran.err);
    serde_json::from_str(&shell.read("r.json")).unwrap()
}

#[test]
fn reports_of_every_kind_obey_the_schema() {
    let (shell, schema) = (Shell::new(), schema());
    shell.write("t.obj", hill(6, 1.0, false));
    shell.write("q.obj", hill(6, 1.0, true));
    shell.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 .5 0\nf 1 2 3\nf 1 3 5\nf 1 5 4\nf 5 3 4\n");
    shell.write("factors.txt", format!("factors\n{}", "1\n".repeat(20)));
    let rim = (0..36).filter(|v| v % 6 == 0 || v % 6 == 5 || v / 6 == 0 || v / 6 == 5);
    shell.write("places.txt", rim.map(|v| format!("{v} {} {}\n", v / 6, v % 6)).collect::<String>());
    for arguments in [
        &["t.obj"][..],
        &["t.obj", "--fix", "2", "--keep-order", "--weight", "unit"],
        &["t.obj", "--boundary", "free", "--boundary-lengths", "factors.txt"],
        &["t.obj", "--boundary", "fixed", "--dual", "circumcentre", "--hold", "primal"],
        &["t.obj", "--boundary", "fixed", "--positions", "places.txt", "--pin", "14=2,2"],
        &["t.obj", "--boundary", "fixed", "--weights", "mean-value"],
        &["t.obj", "--energy", "H + 0.5 L + 0.01 MIPS"],
        &["q.obj", "--max-iterations", "1", "--valid", "off"],
        &["q.obj", "--boundary", "free", "--valid", "one-to-one"],
        &["flat.obj", "--surrogate"],
        &["enneper?n=8"],
        &["rough?n=12&height=2&mesh=delaunay"],
        &["torus?n=9", "--boundary", "periodic"],
        &["torus?n=9", "--cut", "--boundary", "free"],
        &["digital-torus?R=6&r=2.5", "--cut", "--normals", "hat?radius=2"],
    ] {
        let report = report(&shell, arguments);
        assert_eq!(faults(&schema, &report, ""), Vec::<String>::new(), "{arguments:?}");
    }
}

#[test]
fn a_report_without_a_field_or_with_another_type_breaks_the_schema() {
    let (shell, schema) = (Shell::new(), schema());
    let whole = report(&shell, &["enneper?n=8"]);
    for (pointer, field, value) in [
        ("", "solver", None),
        ("/solver", "status", Some(json!("finished"))),
        ("/input", "vertices", Some(json!(-1))),
        ("/input", "euler", Some(json!(0.5))),
        ("/distortion", "flipped", None),
        ("/distortion", "sheared", Some(json!(1))),
        ("/options", "tolerance", Some(json!(0))),
        ("/options", "pins", Some(json!([{ "vertex": 0, "place": [1.0] }]))),
    ] {
        let mut changed = whole.clone();
        let fields = changed.pointer_mut(pointer).and_then(Value::as_object_mut).unwrap();
        match value {
            Some(value) => fields.insert(field.to_owned(), value),
            None => fields.remove(field),
        };
        assert!(!faults(&schema, &changed, "").is_empty(), "{pointer}/{field}");
    }
}

#[test]
fn the_report_has_the_options_as_understood() {
    let shell = Shell::new();
    let options = report(&shell, &["enneper?n=8", "--boundary", "fixed", "--shape", "square", "--pin", "0=1,-0.5"])
        .get("options")
        .unwrap()
        .clone();
    assert_eq!((&options["boundary"], &options["shape"]), (&"fixed".into(), &"square".into()));
    assert_eq!(options["pins"], json!([{ "vertex": 0, "place": [1.0, -0.5] }]));
    // Defaults are given, too; keys of other boundaries are not.
    assert_eq!((&options["dual"], &options["solver"]), (&"barycentre".into(), &"auto".into()));
    assert!(options.get("fix").is_none() && options["max-iterations"].is_null());
}
