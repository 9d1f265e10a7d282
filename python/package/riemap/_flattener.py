"""Many maps of one surface."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._errors import OptionError
from ._mesh import source
from ._options import Options, Progress, encoded, text
from ._result import Map, result

if TYPE_CHECKING:
    from typing_extensions import Unpack


class Flattener:
    """A surface that is mapped many times: the factor of its conformal Laplacian is kept from one map to the next.

    >>> import numpy as np
    >>> V = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.4, 0.5, 0.3]])
    >>> flattener = Flattener(V, [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    >>> flattener.boundary
    array([0, 1, 2, 3])
    >>> flattener.fixed([0, 1, 2, 3], [[0, 0], [1, 0], [1, 1], [0, 1]]).uv[2]
    array([1., 1.])

    Parameters
    ----------
    V, F, **options
        As for `map`; what the options say of the boundary is not looked at.

    Threads may share a flattener.
    """

    def __init__(self, V: Any, F: Any = None, **options: Unpack[Options]) -> None:
        self._source = source(V, F)
        self._native = _native.Flattener(self._source.input, encoded(options))

    @property
    def boundary(self) -> NDArray[np.int64]:
        """The vertices along the boundary, with the surface on the left."""
        return self._native.boundary().astype(np.int64)

    def circle(self, progress: Optional[Progress] = None) -> Map:
        """The map to the unit disc."""
        return result(self._source, self._native.circle(progress))

    def free(self, lengths: Optional[ArrayLike] = None, progress: Optional[Progress] = None) -> Map:
        """The free map.

        Parameters
        ----------
        lengths : sequence of float, or {"factors": …}, optional
            Lengths of the boundary edges, in the order of `boundary` and the unit of V, instead of those on the
            surface; or factors of these.
        """
        given = None if lengths is None else text("lengths", lengths)
        return result(self._source, self._native.free(given, progress))

    def fixed(self, b: ArrayLike, xy: ArrayLike) -> Map:
        """The map whose boundary is at given places.

        Parameters
        ----------
        b : (nb,) array of integers
            All vertices of `boundary`, in any order.
        xy : (nb, 2) array
            Their places, in the same order.
        """
        vertices, places = np.asarray(b), np.asarray(xy, dtype=np.float64)
        boundary = self.boundary
        if places.shape != (len(boundary), 2) or vertices.shape != (len(boundary),):
            raise OptionError(
                f"b has the shape {vertices.shape} and xy {places.shape}; the boundary has {len(boundary)} vertices, and "
                f"({len(boundary)},) and ({len(boundary)}, 2) are needed",
                "shape",
            )
        if not np.isfinite(places).all():
            wrong = vertices[~np.isfinite(places).all(axis=1)]
            raise OptionError(f"the place of vertex {wrong[0]} is NaN or infinite", "value", vertices=wrong[:10].tolist())
        order = np.argsort(vertices, kind="stable")
        ranks = np.argsort(np.argsort(boundary, kind="stable"), kind="stable")
        if not np.array_equal(vertices[order][ranks], boundary):
            missing = np.setdiff1d(boundary, vertices)
            raise OptionError(
                "b is not the boundary: it must have every boundary vertex once",
                "not-the-boundary",
                vertices=missing[:10].tolist(),
            )
        in_order = np.ascontiguousarray(places[order][ranks])
        return result(self._source, self._native.fixed(in_order))
