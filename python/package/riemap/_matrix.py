"""The sparse matrices behind the maps."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from ._map import map
from ._mesh import source
from ._options import Options, encoded

if TYPE_CHECKING:
    from typing_extensions import Unpack


def system(V: Any, F: Any = None, **options: Unpack[Options]) -> Any:
    """System (2) as a matrix A: A z = 0 where the map z is conformal.

    Row q is ``z3 − z1 − iρ (z2 − z0)`` of quad q.

    Parameters
    ----------
    V, F, **options
        As for `map`; ρ is that of the positions.

    Returns
    -------
    scipy.sparse.csc_array, complex, (quads, vertices of the quad graph)
        A quad mesh is its own quad graph. That of a triangle mesh has one quad per edge; its vertices are those of the mesh
        that faces use, in their order, then one dual vertex per face, then one per boundary edge.
    """
    from scipy.sparse import csc_array

    made = source(V, F)
    data, indices, indptr, shape = _native.system(made.input, encoded(options))
    return csc_array((data, indices, indptr), shape=shape)


def laplacian(V: Any, F: Any = None, **options: Unpack[Options]) -> Any:
    """The conformal Laplacian L: ``(L z)_i = Σ_j ρ_ij (z_i − z_j)``, complex symmetric.

    Where z is conformal, L z is 0 at inner vertices. With ``dual="circumcentre"`` L is half the cotan matrix of libigl,
    with the other sign.

    Parameters
    ----------
    V, F, **options
        As for `map`; ρ is that of the positions.

    Returns
    -------
    scipy.sparse.csc_array, complex, (n, n)
        Rows and columns are the vertices that faces use, in their order. On quad meshes L couples one of the two classes of
        vertices that diagonals connect, and the other's rows are 0.
    """
    from scipy.sparse import coo_array

    made = source(V, F)
    data, rows, columns, shape = _native.laplacian(made.input, encoded(options))
    return coo_array((data, (rows, columns)), shape=shape).tocsc()


def verify_cotan(V: Any, F: Any = None) -> float:
    """The largest distance between the map with circumcentres and libigl's harmonic map with the same boundary.

    The boundary is on the unit circle by arc length. libigl must be installed.
    """
    import igl

    ours = map(V, F, boundary="fixed", dual="circumcentre")
    boundary = np.unique(ours.boundary)
    faces = np.ascontiguousarray(ours.faces, dtype=np.int64)
    theirs = igl.harmonic(ours.vertices, faces, boundary, np.ascontiguousarray(ours.uv[boundary]), 1)
    return float(np.nanmax(np.linalg.norm(ours.uv - theirs, axis=1)))
