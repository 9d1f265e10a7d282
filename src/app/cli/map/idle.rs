//! Options that were given and have no effect.

use crate::io::is_glb;
use crate::map::periodic::Tiling;
use crate::map::{Boundary, BoundaryName, MapOptions, Mapped, SolverChoice, ValidName};
use crate::quad_graph::RestSource;
use crate::quad_graph::dual::BoundaryDual;

use super::arguments::{Arguments, is_linear};

/// Returns the reason why it has no effect for each option that was given and has none.
pub(super) fn without_effect(arguments: &Arguments, options: &MapOptions, mapped: &Mapped) -> Vec<&'static str> {
    let (triangles, opening) = (mapped.domain.is_of_triangles(), &mapped.cut);
    let circle = options.expression().is_on_circle() && !options.boundary.is_fixed();
    let linear = is_linear(options);
    let idle = [
        (arguments.boundary == Some(BoundaryName::Free) && circle, "--boundary free has no effect: the energy has C"),
        (
            arguments.boundary == Some(BoundaryName::Circle) && !circle,
            "--boundary circle has no effect: the energy has no C",
        ),
        (arguments.fix.is_some() && !circle, "--fix has no effect: this is not a circle map"),
        (arguments.fix.is_some() && circle && !options.pins.is_empty(), "--fix has no effect beside --pin"),
        (arguments.tolerance.is_some() && linear, "--tolerance has no effect: the map is solved directly"),
        (arguments.max_iterations.is_some() && linear, "--max-iterations has no effect: the map is solved directly"),
        (options.dual != "barycentre" && !triangles, "--dual has no effect on a quad mesh"),
        (
            options.boundary_dual != BoundaryDual::default() && !triangles,
            "--boundary-dual has no effect on a quad mesh",
        ),
        (
            options.cut && opening.cut_edges == 0 && opening.vertices_split == 0,
            "--cut has no effect: the surface is a disc",
        ),
        (
            options.surrogate.is_some() && mapped.domain.disc.surrogates.faces.is_empty(),
            "--surrogate has no effect: every face has an area",
        ),
        (options.fill_holes && opening.holes_filled == 0, "--fill-holes has no effect: there is no hole to fill"),
        (
            options.rest != RestSource::default() && mapped.domain.planes.is_none(),
            "--rest has no effect: ρ is not taken from normals",
        ),
        (
            arguments.tiling != Tiling::default() && mapped.torus.is_none(),
            "--tiling has no effect: the map has no periods",
        ),
        (
            arguments.tiling != Tiling::default() && arguments.output.as_deref().is_some_and(is_glb),
            "--tiling has no effect on .glb: its checkerboard has the periods already",
        ),
    ];
    let of_valid = valid_without_effect(arguments, options, mapped.map.provenance.is_repaired());
    idle.into_iter().chain(of_valid).filter(|(is_idle, _)| *is_idle).map(|(_, reason)| reason).collect()
}

/// Returns, for `--valid` and for options that a replaced map ignores, whether the option has no
/// effect, and the reason.
fn valid_without_effect(arguments: &Arguments, options: &MapOptions, repaired: bool) -> [(bool, &'static str); 8] {
    let given = arguments.valid.is_some_and(|valid| valid != ValidName::Off);
    let one_to_one = arguments.valid == Some(ValidName::OneToOne);
    let repaired = repaired && options.weights().is_none();
    [
        (
            given && options.energy.is_some(),
            "--valid has no effect: the minimum of --energy is checked, and never replaced",
        ),
        (
            given && !options.pins.is_empty(),
            "--valid has no effect beside pins: the map is checked, and never replaced",
        ),
        (
            given && options.boundary_lengths().is_some(),
            "--valid has no effect beside --boundary-lengths: the map is checked, and never replaced",
        ),
        (
            given && options.boundary.is_fixed() && options.weights().is_none(),
            "--valid has no effect on a fixed boundary without --weights: the map is checked, and never replaced",
        ),
        (
            given && options.boundary == Boundary::Periodic,
            "--valid has no effect: a map with periods is checked, and never replaced",
        ),
        (
            one_to_one && options.boundary.is_circle() && options.promises_valid(),
            "--valid one-to-one is the same as auto here: circle maps do not overlap",
        ),
        (
            repaired && options.is_ordered(),
            "--keep-order has no effect: the map was replaced by one whose boundary is in order",
        ),
        (
            repaired && options.solver != SolverChoice::Auto,
            "--solver has no effect: the map was replaced by one that Newton's method finds",
        ),
    ]
}
