"""What a map is in Python."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from typing import Any, Union

import numpy as np
from numpy.typing import NDArray

from ._files import write
from ._mesh import Source, scattered


@dataclass(frozen=True, eq=False)
class Distortion:
    """What a map does to every face; arrays of length m, NaN for faces that were left out.

    With σ1 ≥ \\|σ2\\| the singular values of the face's affine map (of a quad: of its diagonals):
    """

    #: σ1/σ2, the quasi-conformal distortion: 1 where the map is conformal, negative where the face is flipped.
    sigma_ratio: NDArray[np.float64]
    #: σ1 σ2, the factor on the face's area, with the image scaled to the area of the surface: 1 where areas are kept.
    area: NDArray[np.float64]
    #: The largest change of an angle, 2 arcsin((σ1 − σ2)/(σ1 + σ2)), in radians; NaN where the face is flipped.
    angle: NDArray[np.float64]
    #: Whether the face is flipped or collapsed, by an exact predicate.
    flipped: NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Map:
    """A map of a surface to the plane."""

    #: The positions that were mapped, (n, 3).
    vertices: NDArray[np.float64]
    #: The faces that were mapped, (m, 3) or (m, 4).
    faces: Any
    #: The image of every vertex, (n, 2). NaN for vertices that no mapped face uses; the first image of those on a cut.
    uv: NDArray[np.float64]
    #: Texture coordinates, (k, 2), as mesh files have them: (0, 0) for what is not mapped.
    uv_corner: NDArray[np.float64]
    #: For every corner of `faces` its row in `uv_corner`; other than `faces` where the surface was cut, faces were left out, or
    #: the map has periods.
    faces_uv: Any
    #: The vertices along the boundary, surface on the left, from the one of lowest index; one on a cut comes once for each of
    #: its images.
    boundary: NDArray[np.int64]
    #: What the map does to every face.
    distortion: Distortion
    #: The record of the map, as ``riemap map --report`` writes it.
    report: dict[str, Any]

    @property
    def energies(self) -> dict[str, float]:
        """The energies of the map by name, without coefficients, and their weighted sum as "total"."""
        return {name: value for name, value in self.report["energy"].items() if value is not None}

    @property
    def valid(self) -> bool:
        """Whether the map is bijective, by exact predicates."""
        return bool(self.report["solver"]["valid"])

    def write(self, path: Union[str, os.PathLike[str]]) -> None:
        """Writes the surface with its texture coordinates: .obj, .ply or .glb, by the extension.

        Raises
        ------
        OSError
            The file cannot be written.
        OptionError
            Another extension.
        """
        write(path, self.vertices, self.faces, self.uv_corner, self.faces_uv)

    def __repr__(self) -> str:
        solver = self.report["solver"]
        return (
            f"<riemap.Map of {len(self.uv)} vertices, {len(self.faces)} faces: {solver['backend']}, {solver['status']}, "
            f"{'one-to-one' if self.valid else 'not one-to-one'}>"
        )


def result(made: Source, arrays: dict[str, Any]) -> Map:
    """A map of the arrays that the extension returns."""
    sigma1, sigma2, area = arrays["sigma1"], arrays["sigma2"], arrays["area"]
    with np.errstate(all="ignore"):
        scale = np.nansum(area) / np.nansum(area * np.abs(sigma1 * sigma2))
        distortion = Distortion(
            sigma_ratio=sigma1 / sigma2,
            area=sigma1 * sigma2 * scale,
            angle=2 * np.arcsin((sigma1 - sigma2) / (sigma1 + sigma2)),
            flipped=arrays["flipped"],
        )
    return Map(
        vertices=made.vertices,
        faces=made.faces,
        uv=arrays["uv"].reshape(-1, 2),
        uv_corner=arrays["uv_corner"].reshape(-1, 2),
        faces_uv=scattered(made.faces, arrays["corners_uv"]),
        boundary=arrays["boundary"].astype(np.int64),
        distortion=distortion,
        report=json.loads(arrays["report"]),
    )
