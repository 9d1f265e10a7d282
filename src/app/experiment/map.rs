use serde::Deserialize;
use serde_json::{Value, json};

use super::convergence::one_or_more;
use super::picture::{Checkerboard, checkerboard_pair, flat_map, maps};
use super::surface::SurfaceSpec;
use super::{
    Caption, ConfigError, Convergence, Document, ExperimentKind, Mark, Marks, Picture, RunError, Task, Yield, trace,
};
use crate::app::measure::stopwatch::Stopwatch;
use crate::figure::Format;
use crate::input::Input;
use crate::map::{self, MapOptions, Mapped};
use crate::quad_graph::dual::DUAL_POINTS;
use crate::report::Report;
use crate::solver::solver_names;

/// The kind of experiment that maps a surface; the result is its [`Report`].
pub(super) struct MapKind;

/// `[solver]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct SolverSpec {
    name: Option<String>,
    tolerance: Option<f64>,
    max_iterations: Option<usize>,
}

/// `[figures]`: pictures of each run.
#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct FigureSpec {
    /// Whether the flat map is drawn, coloured by quasi-conformal distortion.
    flat: bool,
    /// The checkerboard on the surface, drawn beside the flat map.
    checkerboard: Option<Checkerboard>,
    /// The faces of large error that are drawn red.
    mark: Option<Mark>,
    /// The caption below the pair, instead of the title.
    caption: Option<Caption>,
    /// The plots of convergence over all runs.
    #[serde(deserialize_with = "one_or_more")]
    convergence: Vec<Convergence>,
}

struct MapTask {
    title: String,
    /// The config as JSON, for captions.
    config: Value,
    surface: SurfaceSpec,
    options: MapOptions,
    figures: FigureSpec,
}

impl ExperimentKind for MapKind {
    fn name(&self) -> &'static str {
        "map"
    }

    fn description(&self) -> &'static str {
        "one map, measured as `riemap map --report` does"
    }

    fn tables(&self) -> &'static [&'static str] {
        &["surface", "map", "solver", "figures"]
    }

    fn columns(&self) -> &'static [(&'static str, &'static str)] {
        &[
            ("result.input.vertices", "vertices"),
            ("result.input.faces", "faces"),
            ("result.solver.backend", "backend"),
            ("result.solver.iterations", "iterations"),
            ("result.energy.total", "energy"),
            ("result.energy.H", "H"),
            ("result.distortion.quasi_conformal.mean", "σ₁/σ₂, mean"),
            ("result.distortion.quasi_conformal.max", "σ₁/σ₂, max"),
            ("result.distortion.flipped", "flipped"),
            ("timings.total", "seconds"),
        ]
    }

    fn task(&self, config: &Document) -> Result<Box<dyn Task>, ConfigError> {
        let mut options: MapOptions = config.table("map")?;
        let duals: Vec<&str> = DUAL_POINTS.iter().map(|dual| dual.name()).collect();
        config.check_name("map.dual", "dual point", &options.dual, &duals)?;
        if let Some(solver) = config.optional::<SolverSpec>("solver")? {
            options.solver = solver.name.map_or(options.solver, Into::into);
            options.tolerance = solver.tolerance.unwrap_or(options.tolerance);
            options.max_iterations = solver.max_iterations.or(options.max_iterations);
        }
        config.check_name("solver.name", "solver", options.solver.name(), &solver_names())?;
        Ok(Box::new(MapTask {
            title: config.optional("title")?.unwrap_or_default(),
            config: config.to_json()?,
            surface: SurfaceSpec::of(config)?,
            options,
            figures: config.table("figures")?,
        }))
    }
}

impl Task for MapTask {
    fn run(&self) -> Result<Yield, RunError> {
        let traced = !self.figures.convergence.is_empty();
        let mut watch = if traced { Stopwatch::counting() } else { Stopwatch::start() };
        let input = self.surface.open()?;
        let mapped = map::map_input(&input, &self.options, &mut watch)?;
        let cost = watch.cost();
        let mut result = untimed(Report::new(&input, &mapped, cost))?;
        let mut timings = serde_json::to_value(cost.seconds)?;
        if traced {
            let (numbers, times) = trace(watch.trace(), mapped.map.total);
            result["trace"] = numbers;
            timings["trace"] = times;
        }
        let marks = self.figures.mark.map(|mark| Marks::of(&mapped, &maps(&mapped), mark));
        if let (Some(marks), Some(fields)) = (&marks, result.as_object_mut()) {
            fields.insert("marked".to_owned(), marks.record());
        }
        let pictures = self.pictures(&input, &mapped, marks.as_ref(), &result)?;
        Ok(Yield { result, timings, pictures, ..Yield::default() })
    }
}

/// The report as it goes into a record: without times and memory, which have a place of their own
/// there, and without paths along the mesh, which are as long as it is wide; their lengths remain.
pub(super) fn untimed(report: Report) -> Result<Value, serde_json::Error> {
    let mut result = serde_json::to_value(report)?;
    if let Some(solver) = result.get_mut("solver").and_then(Value::as_object_mut) {
        solver.retain(|key, _| !["seconds", "cpu_seconds", "peak_bytes"].contains(&key.as_str()));
    }
    for walk in result.pointer_mut("/periods/loops").and_then(Value::as_array_mut).into_iter().flatten() {
        if let Some(walk) = walk.as_object_mut() {
            walk.remove("vertices");
        }
    }
    Ok(result)
}

impl MapTask {
    fn pictures(
        &self,
        input: &Input,
        mapped: &Mapped,
        marks: Option<&Marks>,
        result: &Value,
    ) -> Result<Vec<Picture>, RunError> {
        let FigureSpec { flat, checkerboard, caption, .. } = &self.figures;
        let mut pictures = Vec::new();
        if *flat {
            // Only two pictures of one run need suffixes.
            let suffix = if checkerboard.is_some() { "-flat" } else { "" };
            for format in [Format::Png, Format::Svg] {
                pictures.push(Picture { suffix, format, bytes: flat_map(mapped, marks, &self.title, format)? });
            }
        }
        if let Some(look) = checkerboard {
            let values = json!({ "config": self.config, "result": result });
            let caption = caption.as_ref().map(|caption| caption.filled(&values)).transpose()?;
            let caption = caption.as_deref().unwrap_or(&self.title);
            let bytes = checkerboard_pair(input, mapped, *look, marks, caption)?;
            let suffix = if *flat { "-checkerboard" } else { "" };
            pictures.push(Picture { suffix, format: Format::Png, bytes });
        }
        Ok(pictures)
    }
}
