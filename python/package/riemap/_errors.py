"""The exceptions of the package."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray


class _Located:
    """An error that knows its kind and the first faces and vertices that it is about."""

    def __init__(
        self, message: str, kind: str, faces: Iterable[int] = (), vertices: Iterable[int] = ()
    ) -> None:
        self.kind = kind
        self.faces: NDArray[np.int64] = np.asarray(list(faces), dtype=np.int64)
        self.vertices: NDArray[np.int64] = np.asarray(list(vertices), dtype=np.int64)
        # All of them are arguments, so that the exception can be pickled.
        super().__init__(message, kind, self.faces.tolist(), self.vertices.tolist())  # type: ignore[call-arg]

    def __str__(self) -> str:
        return str(self.args[0])  # type: ignore[attr-defined]


class MeshError(_Located, ValueError):
    """The surface cannot be mapped as it is.

    Attributes
    ----------
    kind : str
        A word for the defect: ``"closed"``, ``"not-a-disc"``, ``"non-manifold-edges"``, ``"zero-area-faces"``, …
    faces, vertices : int64 arrays
        The first faces and vertices concerned, counted from 0; empty where the whole surface is.
    """


class OptionError(_Located, ValueError):
    """The options contradict each other, have a wrong value, or do not suit the surface.

    It has the attributes of `MeshError`.
    """


class ConvergenceError(_Located, RuntimeError):
    """A solver found no map.

    It has the attributes of `MeshError`.
    """


for _class in (MeshError, OptionError, ConvergenceError):
    _class.__module__ = "riemap"
