"""Digital surfaces: the boundaries of sets of voxels, given by arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._errors import MeshError, OptionError
from ._map import mapped
from ._mesh import Source, of_input
from ._options import Options, Progress
from ._result import Map

if TYPE_CHECKING:
    from typing_extensions import Unpack

__all__ = ["map", "surface"]


def surface(
    volume: ArrayLike, threshold: float = 0, *, adjacency: int = 6, component: int = 0, normals: str = "auto"
) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.float64]]:
    """The boundary of the voxels whose value is above a threshold.

    >>> V, F, N = surface([[[1]]], threshold=0)
    >>> V.shape, F.shape, N.shape
    ((8, 3), (6, 4), (6, 3))

    Parameters
    ----------
    volume : (nx, ny, nz) array of booleans or real numbers
        Values; ``volume[i, j, k]`` is that of the unit cube around the point (i, j, k).
    threshold : float
        Voxels of larger values are inside.
    adjacency : {6, 18}
        Whether inner voxels that share an edge alone are apart (6) or joined (18).
    component : int
        Which component of the boundary, by number of faces, largest first.
    normals : str
        The estimator of normals, as ``"hat?radius=4"``.

    Returns
    -------
    V : (n, 3) array
        Corners of voxels.
    F : (m, 4) array of int64
        Squares, counter-clockwise seen from outside.
    normals : (m, 3) array
        Estimated unit normals, outward.
    """
    made = opened(volume, threshold, adjacency, component)
    return made.vertices, made.faces, made.input.normals(normals).reshape(-1, 3)


def map(
    volume: ArrayLike,
    threshold: float = 0,
    *,
    adjacency: int = 6,
    component: int = 0,
    progress: Optional[Progress] = None,
    **options: Unpack[Options],
) -> Map:
    """Maps the boundary of voxels, with estimated normals: `riemap.map` of what `surface` returns.

    Parameters
    ----------
    volume, threshold, adjacency, component
        As for `surface`.
    progress, **options
        As for `riemap.map`. A boundary of voxels is closed: ``cut=True`` or ``boundary="periodic"`` is needed.
    """
    return mapped(opened(volume, threshold, adjacency, component), dict(options), progress)


def opened(volume: ArrayLike, threshold: float, adjacency: int, component: int) -> Source:
    """The boundary of voxels as an input."""
    values = np.asarray(volume)
    if values.ndim != 3:
        raise MeshError(f"the volume has the shape {values.shape}; (nx, ny, nz) is needed", "shape")
    if values.dtype.kind not in "biuf":
        raise MeshError(f"the volume has the type {values.dtype}; booleans or real numbers are needed", "type")
    if values.dtype.kind == "f" and np.isnan(values).any():
        raise MeshError("the volume has a voxel that is NaN", "not-finite")
    if not np.isfinite(threshold):
        raise OptionError(f"the threshold is {threshold}; it must be finite", "value")
    if adjacency not in (6, 18):
        raise OptionError(f"the adjacency is {adjacency}; 6 and 18 are known", "value")
    if component < 0:
        raise OptionError(f"the component is {component}; components count from 0", "value")
    return of_input(_native.Input.of_voxels(values > threshold, adjacency == 18, component))
