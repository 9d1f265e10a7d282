"""One surface to one map."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._mesh import Source, source
from ._options import Options, Progress, encoded
from ._result import Map, result

if TYPE_CHECKING:
    from typing_extensions import Unpack


def map(
    V: Any,
    F: Any = None,
    *,
    face_normals: Optional[ArrayLike] = None,
    progress: Optional[Progress] = None,
    **options: Unpack[Options],
) -> Map:
    """Maps a surface to the plane.

    >>> import numpy as np
    >>> V = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.4, 0.5, 0.3]])
    >>> F = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
    >>> r = map(V, F)
    >>> np.allclose(np.hypot(*r.uv[:4].T), 1)
    True
    >>> map(V, F, boundary="free").valid
    True

    Parameters
    ----------
    V : (n, 3) array of real numbers
        Vertex positions. Or, without `F`: a mesh with ``vertices`` and ``faces`` (trimesh), ``points`` and ``faces``
        (PyVista), ``points`` and ``cells`` (meshio); or the name of a file or of a generated surface.
    F : (m, 3) or (m, 4) array of integers, or a list of faces
        Vertices of the triangles or quads, counted from 0.
    face_normals : (m, 3) array, optional
        Unit normals from which ρ of the faces of a quad mesh is taken, in place of the faces' own.
    progress : callable, optional
        Called as ``progress(phase, iteration)``; an exception of it ends the map.
    **options
        See `Options`.

    Returns
    -------
    Map

    Raises
    ------
    MeshError
        Arrays that are no surface; a surface that is not a disc, is not made one by the options, or is too badly formed.
    OptionError
        Options that contradict each other, have a wrong value, or do not suit the surface.
    ConvergenceError
        A solver that does not converge.
    KeyboardInterrupt
        Ctrl-C, between two iterations.
    """
    chosen: dict[str, Any] = dict(options)
    if face_normals is not None and chosen.get("normals") is None and chosen.get("rho") is None:
        chosen["normals"] = "file"
    return mapped(source(V, F, face_normals), chosen, progress)


def mapped(made: Source, options: dict[str, Any], progress: Optional[Progress]) -> Map:
    """The map of what is ready to be mapped."""
    return result(made, _native.map(made.input, encoded(options), progress))


@dataclass(frozen=True, eq=False)
class Periods:
    """The periods of a closed surface of genus 1."""

    #: The ratio of the periods, in the fundamental domain of the modular group: \|Re τ\| ≤ ½, \|τ\| ≥ 1.
    tau: complex
    #: Vertices of two loops of the mesh, with the periods 1 and τ.
    loops: tuple[NDArray[np.int64], NDArray[np.int64]]
    #: The lengths of these loops, in the unit of V.
    lengths: tuple[float, float]
    #: H of the map over the area of its image: 0 for a conformal map.
    h_per_area: float


def periods(V: Any, F: Any = None, **options: Unpack[Options]) -> Periods:
    """The ratio of the periods of a closed surface of genus 1, its conformal type.

    Parameters
    ----------
    V, F, **options
        As for `map`.
    """
    chosen: dict[str, Any] = {**options, "boundary": "periodic"}
    record = mapped(source(V, F), chosen, None).report["periods"]
    first, second = record["loops"]
    return Periods(
        tau=complex(*record["tau"]),
        loops=(np.asarray(first["vertices"], dtype=np.int64), np.asarray(second["vertices"], dtype=np.int64)),
        lengths=(first["length"], second["length"]),
        h_per_area=record["h_per_area"],
    )
