"""Sparse matrices, and libigl beside them."""

import numpy as np
import pytest
import riemap
from conftest import lifted_grid


def test_the_similarities_of_a_flat_mesh_solve_system_2(quads):
    V, F = quads
    flat = V * [1, 1, 0]
    A = riemap.system(flat, F)
    assert A.shape == (len(F), len(V)) and A.dtype == np.complex128
    z = flat[:, :2] @ [1 + 2j, -2 + 1j]
    assert np.abs(A @ z).max() < 1e-12
    # Reflections are not conformal.
    assert np.abs(A @ z.conj()).min() > 1e-3


def test_the_quad_graph_of_a_triangle_mesh_has_a_quad_for_each_edge(triangles):
    V, F = triangles
    edges = len(np.unique(np.sort(np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]]), axis=1), axis=0))
    boundary = len(riemap.map(V, F).boundary)
    A = riemap.system(V, F)
    assert A.shape == (edges, len(V) + len(F) + boundary)
    # A similarity of a flat mesh is conformal.
    flat = V * [1, 1, 0]
    L = riemap.laplacian(flat, F)
    z = flat[:, :2] @ [1 + 2j, -2 + 1j]
    inner = np.setdiff1d(np.arange(len(V)), riemap.map(V, F).boundary)
    assert np.abs((L @ z)[inner]).max() < 1e-12


def test_the_conformal_laplacian_is_symmetric_and_a_map_s_kernel(triangles):
    V, F = triangles
    L = riemap.laplacian(V, F)
    assert np.abs((L - L.T).toarray()).max() == 0
    assert np.abs(L @ np.ones(len(V))).max() < 1e-12
    r = riemap.map(V, F)
    inner = np.setdiff1d(np.arange(len(V)), r.boundary)
    assert np.abs((L @ (r.uv @ [1, 1j]))[inner]).max() < 1e-9


def test_with_circumcentres_the_laplacian_is_libigl_s_cotan_matrix(triangles):
    igl = pytest.importorskip("igl")
    V, F = triangles
    ours = riemap.laplacian(V, F, dual="circumcentre").toarray()
    theirs = igl.cotmatrix(V, F.astype(np.int64)).toarray()
    assert np.abs(ours.imag).max() == 0
    inner = np.setdiff1d(np.arange(len(V)), riemap.map(V, F).boundary)
    assert np.allclose(ours.real[inner], -theirs[inner], atol=1e-12)


@pytest.mark.parametrize("n", [16, 64])
def test_with_circumcentres_the_map_is_libigl_s_harmonic_map(n):
    pytest.importorskip("igl")
    assert riemap.verify_cotan(*lifted_grid(n, 3)) < 1e-9
