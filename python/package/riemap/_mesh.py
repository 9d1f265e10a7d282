"""Meshes in the forms in which Python has them, checked and brought into one."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._errors import MeshError


@dataclass(frozen=True)
class Source:
    """What is mapped: the extension's input, and the arrays that results refer to."""

    input: _native.Input
    vertices: NDArray[np.float64]
    #: (m, k), or a list of lists where the faces differ in their number of corners.
    faces: Any


def source(mesh: Any, faces: Any = None, face_normals: Any = None) -> Source:
    """The input that a pair of arrays, a mesh object, or the name of a file stands for."""
    if faces is None and isinstance(mesh, (str, os.PathLike)):
        if face_normals is not None:
            raise TypeError("face_normals belong to arrays; a file has its own")
        return opened(os.fspath(mesh), "{}")
    if faces is None:
        mesh, faces = taken_apart(mesh)
    positions = vertices(mesh)
    corners, counts, faces = polygons(faces, len(positions))
    normals = None if face_normals is None else triples(face_normals, "face_normals")
    return Source(_native.Input.of_arrays(positions, corners, counts, normals), positions, faces)


def opened(path: str, options: str) -> Source:
    """The mesh or volume file, or the generated surface, of that name."""
    return of_input(_native.Input.open(path, options))


def of_input(made: _native.Input) -> Source:
    """An input that the extension has made."""
    positions, corners, counts = made.arrays()
    return Source(made, positions.reshape(-1, 3), grouped(corners, counts))


def grouped(corners: NDArray[np.uint32], counts: NDArray[np.uint32]) -> Any:
    """Faces as an array (m, k) of int64, or as lists where they differ in their number of corners."""
    corners = corners.astype(np.int64)
    if len(counts) and (counts == counts[0]).all():
        return corners.reshape(len(counts), int(counts[0]))
    return [face.tolist() for face in np.split(corners, np.cumsum(counts[:-1]))]


def taken_apart(mesh: Any) -> tuple[Any, Any]:
    """Vertices and faces of a mesh object: trimesh, PyVista and meshio, by what they look like."""
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        return mesh.vertices, mesh.faces
    if hasattr(mesh, "points") and hasattr(mesh, "faces"):
        return mesh.points, counted(np.asarray(mesh.faces))
    if hasattr(mesh, "points") and hasattr(mesh, "cells"):
        return mesh.points, cells(mesh.cells)
    raise TypeError(
        f"faces are missing: give arrays V, F, or an object with vertices and faces, or the name of a file; "
        f"found {type(mesh).__name__} alone"
    )


def counted(flat: NDArray[Any]) -> Any:
    """PyVista's faces: each with its number of corners before it."""
    if flat.ndim != 1:
        return flat
    faces: list[list[int]] = []
    at = 0
    if len(flat) and flat[0] > 0 and len(flat) % (flat[0] + 1) == 0:
        rows = flat.reshape(-1, flat[0] + 1)
        if (rows[:, 0] == flat[0]).all():
            return rows[:, 1:]
    while at < len(flat):
        count = int(flat[at])
        if count < 0 or at + count >= len(flat):
            raise MeshError(f"face {len(faces)} has {count} corners and the list ends before", "shape", [len(faces)])
        faces.append(flat[at + 1 : at + 1 + count].tolist())
        at += count + 1
    return faces


def cells(blocks: Any) -> Any:
    """meshio's blocks of triangles, quads and polygons; lines and points are left out."""
    taken = [np.asarray(block.data) for block in blocks if block.type in ("triangle", "quad", "polygon")]
    if not taken:
        found = ", ".join(sorted({block.type for block in blocks})) or "nothing"
        raise MeshError(f"the mesh has no triangles or quads: {found}", "no-faces")
    return taken[0] if len(taken) == 1 else [face for block in taken for face in block.tolist()]


def vertices(given: Any) -> NDArray[np.float64]:
    """Positions (n, 3) as doubles in C order; the array itself where it is that already."""
    return triples(given, "V")


def triples(given: Any, name: str) -> NDArray[np.float64]:
    """An array of three columns as doubles in C order."""
    array = np.asarray(given)
    if array.dtype.kind not in "fiu":
        raise MeshError(f"{name} has the type {array.dtype}; real numbers are needed", "type")
    if array.ndim != 2 or array.shape[1] != 3:
        hint = "; add a column of zeros" if array.ndim == 2 and array.shape[1] == 2 else ""
        raise MeshError(f"{name} has the shape {array.shape}; (n, 3) is needed{hint}", "shape")
    return np.ascontiguousarray(array, dtype=np.float64)


def polygons(given: Any, count: int) -> tuple[NDArray[np.uint32], NDArray[np.uint32], Any]:
    """The vertex of every corner, the number of corners of every face, and the faces as they were given."""
    array = given if hasattr(given, "__array__") else listed(given)
    if isinstance(array, list):
        counts = np.array([len(face) for face in array], dtype=np.uint32)
        flat = np.concatenate([np.asarray(face).ravel() for face in array])
    else:
        array = np.asarray(array)
        if array.size == 0:
            raise MeshError(f"F has the shape {array.shape}: there is no face", "no-faces")
        if array.ndim != 2 or array.shape[1] < 3:
            raise MeshError(f"F has the shape {array.shape}; (m, 3) or (m, 4) is needed", "shape")
        counts = np.full(len(array), array.shape[1], dtype=np.uint32)
        flat = np.ascontiguousarray(array).reshape(-1)
    if flat.dtype.kind not in "iu":
        hint = "; F.astype(int) if they are whole numbers" if flat.dtype.kind == "f" else ""
        raise MeshError(f"F has the type {flat.dtype}; vertex indices are integers{hint}", "type")
    if flat.size and (flat.min() < 0 or flat.max() >= count):
        wrong = np.flatnonzero((flat < 0) | (flat >= count))
        owner = np.repeat(np.arange(len(counts)), counts)[wrong]
        faces, bad = np.unique(owner)[:10], np.unique(flat[wrong])[:10]
        raise MeshError(
            f"face {faces[0]} has the vertex {flat[wrong[0]]}, and there are {count} vertices (they count from 0)",
            "no-such-vertex",
            faces.tolist(),
            [vertex for vertex in bad.tolist() if vertex < 2**63],
        )
    return flat.astype(np.uint32, copy=False), counts, array


def listed(given: Any) -> Any:
    """A list of lists as an array, or as itself where the faces differ in their number of corners."""
    try:
        faces = [list(face) for face in given]
    except TypeError:
        raise MeshError(f"F is {type(given).__name__}; an array (m, 3), (m, 4) or a list of faces is needed", "type") from None
    if len({len(face) for face in faces}) > 1:
        return faces
    return np.asarray(faces) if faces else np.empty((0, 3), dtype=np.int64)


def scattered(faces: Any, corners: Optional[NDArray[np.uint32]]) -> Any:
    """Numbers of corners in the shape of the faces."""
    if corners is None:
        return faces
    if isinstance(faces, np.ndarray):
        return corners.astype(np.int64).reshape(faces.shape)
    return [part.tolist() for part in np.split(corners.astype(np.int64), np.cumsum([len(face) for face in faces])[:-1])]
