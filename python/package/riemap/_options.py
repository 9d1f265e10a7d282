"""Options of a map: the names and values of the command line, read by the library's own deserialiser."""

from __future__ import annotations

import json
import operator
import os
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Callable, Optional, TypedDict, Union

from ._errors import OptionError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

#: Called as ``progress(phase, iteration)``: the phase is "assemble", "factor", "solve" or "measure"; the iteration is None
#: when a phase begins, then a dict with "number", "energy", "gradient_norm" and "step".
Progress = Callable[[str, Optional[dict[str, float]]], object]


class Options(TypedDict, total=False):
    """The options of a map, those of ``riemap map``; ``None`` is the default of each.

    Attributes
    ----------
    boundary : {"circle", "free", "fixed", "periodic"}
        What the boundary does: it is on the unit circle (H + C), keeps its lengths (H + L'), is fixed (H); closed surfaces
        of genus 1 have two periods (H).
    energy : str
        The energy that is minimised instead: terms H C A L Lb MIPS SD with coefficients, as in ``"H + 0.5 L"``.
    pins : {vertex: (x, y)}
        Vertices held at places in the plane.
    positions : {vertex: (x, y)}
        Fixed boundaries: places of the boundary's vertices, instead of `shape`.
    boundary_lengths : sequence of float, {"lengths": …}, {"factors": …}, or the name of a file
        Free maps: lengths of the boundary edges, in the order of the boundary and the unit of V; or factors of those on
        the surface.
    shape : {"circle", "square"}
        Fixed boundaries: what the boundary is on, by arc length.
    hold : {"whole", "primal"}
        Fixed boundaries: which boundary vertices of the quad graph are held.
    weights : {"mean-value", "uniform", "cotan"}
        Fixed boundaries: every inner vertex is the mean of its neighbours by these weights.
    cut : bool
        Cut a surface that is no disc open.
    fill_holes : bool
        Fill all holes but the longest for the map; for periodic maps all.
    remove_faces : sequence of int
        Faces that are left out.
    surrogate : float
        Map faces without area too, each by a shape of this height over its length (0.01).
    valid : {"auto", "best-qc", "one-to-one", "off"}
        Which map replaces a conformal one that is not injective.
    fix : {2, 3}
        Circle maps: number of boundary points that are pinned.
    keep_order : bool
        Circle maps: keep the boundary points in order.
    start : {"auto", "circle"}
        The map that a minimisation begins with.
    weight : {"integral", "unit"}
        Weights of the energies.
    dual : str
        Dual point of triangle meshes: "barycentre", "circumcentre", "incentre", …
    boundary_dual : {"midpoint", "foot"}
        Dual vertex of boundary edges.
    rho : {"auto", "positions", "normals"}
        What ρ of quad meshes is computed from.
    normals : str
        The estimator of normals for ρ, as ``"hat?radius=4"``; "file" takes those given.
    rest : {"projected", "unit"}
        With normals: which lengths and areas are those at rest.
    solver : str
        Name of the solver, or "auto".
    tolerance : float
        Nonlinear maps have converged when the gradient is at most this times that of the start.
    max_iterations : int
        Stop after so many iterations; the report's ``solver.status`` then is "max-iterations".
    """

    boundary: Optional[str]
    energy: Optional[str]
    pins: Optional[Mapping[int, Sequence[float]]]
    positions: Optional[Mapping[int, Sequence[float]]]
    boundary_lengths: Union[Sequence[float], Mapping[str, Sequence[float]], str, ArrayLike, None]
    shape: Optional[str]
    hold: Optional[str]
    weights: Optional[str]
    cut: Optional[bool]
    fill_holes: Optional[bool]
    remove_faces: Optional[Iterable[int]]
    surrogate: Optional[float]
    valid: Optional[str]
    fix: Optional[int]
    keep_order: Optional[bool]
    start: Optional[str]
    weight: Optional[str]
    dual: Optional[str]
    boundary_dual: Optional[str]
    rho: Optional[str]
    normals: Optional[str]
    rest: Optional[str]
    solver: Optional[str]
    tolerance: Optional[float]
    max_iterations: Optional[int]


def encoded(options: Mapping[str, Any]) -> str:
    """The options as the library reads them."""
    given = {name: value for name, value in options.items() if value is not None}
    for name in ("pins", "positions"):
        if name in given:
            given[name] = places(name, given[name])
    return text("options", {name.replace("_", "-"): value for name, value in given.items()})


def places(name: str, given: Any) -> list[dict[str, Any]]:
    """Vertices and their places."""
    try:
        return [
            {"vertex": operator.index(vertex), "place": [float(x), float(y)]} for vertex, (x, y) in dict(given).items()
        ]
    except (TypeError, ValueError):
        raise OptionError(f"{name}: a dict of vertex: (x, y) is needed, found {given!r}", "value") from None


def text(name: str, value: Any) -> str:
    """JSON, arrays included."""
    try:
        return json.dumps(value, default=plain, allow_nan=False)
    except OptionError:
        raise
    except ValueError:
        raise OptionError(f"{name}: NaN and infinity are no values: {value!r}", "value") from None


def plain(value: Any) -> Any:
    """Arrays, NumPy's numbers, paths and iterables as JSON has them."""
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, Iterable):
        return list(value)
    raise OptionError(f"a value of type {type(value).__name__} is no option: {value!r}", "value")
