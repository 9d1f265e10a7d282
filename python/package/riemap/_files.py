"""Mesh files."""

from __future__ import annotations

import os
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._errors import OptionError
from ._mesh import source


def read(path: Union[str, os.PathLike[str]]) -> tuple[NDArray[np.float64], Any]:
    """The vertices (n, 3) and faces (m, k) of a mesh file, a volume, or a generated surface.

    The extension tells the format: .obj, .off, .ply, .stl; .vol, .longvol, .pgm3d, .npy. The faces are a list of
    lists where they differ in their number of corners.

    >>> V, F = read("sphere?n=8")
    >>> V.shape[1], F.shape[1]
    (3, 4)

    Raises
    ------
    OSError
        The file cannot be read.
    MeshError
        It has no surface.
    """
    made = source(os.fspath(path))
    return made.vertices, made.faces


def write(
    path: Union[str, os.PathLike[str]], V: Any, F: Any, uv: Optional[ArrayLike] = None, faces_uv: Any = None
) -> None:
    """Writes a mesh: .obj, .ply or .glb, by the extension.

    Parameters
    ----------
    path
        The file; one that exists is replaced when the new one is complete.
    V, F
        As for `map`.
    uv : (n, 2) array, optional
        Texture coordinates of the vertices; with `faces_uv` (k, 2), pairs for corners.
    faces_uv : like F, optional
        For every corner its row in `uv`.
    """
    made = source(V, F)
    if uv is None:
        made.input.write(os.fspath(path))
        return
    pairs = np.ascontiguousarray(uv, dtype=np.float64)
    if pairs.ndim != 2 or pairs.shape[1] != 2:
        raise OptionError(f"uv has the shape {pairs.shape}; (n, 2) is needed", "shape")
    corners = None
    if faces_uv is not None and faces_uv is not F:
        corners = np.concatenate([np.asarray(face).ravel() for face in faces_uv])
        if corners.dtype.kind not in "iu" or corners.size and (corners.min() < 0 or corners.max() >= len(pairs)):
            raise OptionError(f"faces_uv has integers from 0 to {len(pairs) - 1}, rows of uv", "shape")
        corners = corners.astype(np.uint32)
    made.input.write(os.fspath(path), pairs, corners)
