"""Maps of arrays."""

import copy
import pickle

import numpy as np
import pytest
import riemap
from conftest import lifted_grid, torus


def test_the_boundary_of_a_circle_map_is_on_the_unit_circle(triangles):
    r = riemap.map(*triangles)
    assert np.allclose(np.linalg.norm(r.uv[r.boundary], axis=1), 1, atol=1e-12)
    assert r.valid and not r.distortion.flipped.any()
    assert set(r.energies) == {"total", "H", "C"}


def test_a_free_map_of_a_flat_surface_is_the_surface(quads):
    V, F = quads
    flat = V * [1, 1, 0]
    r = riemap.map(flat, F, boundary="free")
    lengths = [np.linalg.norm(np.roll(x, -1, axis=0) - x, axis=1) for x in (flat[r.boundary], r.uv[r.boundary])]
    assert np.allclose(*lengths, rtol=1e-9)
    assert np.allclose(r.distortion.sigma_ratio, 1, atol=1e-8)
    assert np.allclose(r.distortion.area, 1, atol=1e-8)
    assert np.allclose(r.distortion.angle, 0, atol=1e-8)


def test_the_distortion_is_that_of_the_affine_maps_of_the_faces(triangles):
    V, F = triangles
    r = riemap.map(V, F)
    ratios, factors = [], []
    for face in F:
        a, b = V[face[1]] - V[face[0]], V[face[2]] - V[face[0]]
        e1 = a / np.linalg.norm(a)
        e2 = np.cross(np.cross(a, b), e1)
        e2 /= np.linalg.norm(e2)
        rest = np.array([[a @ e1, b @ e1], [a @ e2, b @ e2]])
        jacobian = (r.uv[face[1:]] - r.uv[face[0]]).T @ np.linalg.inv(rest)
        s = np.linalg.svd(jacobian, compute_uv=False)
        ratios.append(s[0] / s[1])
        factors.append(np.linalg.det(jacobian))
    assert np.allclose(r.distortion.sigma_ratio, ratios, rtol=1e-9)
    areas = 0.5 * np.linalg.norm(np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]]), axis=1)
    scale = areas.sum() / (areas * factors).sum()
    assert np.allclose(r.distortion.area, np.array(factors) * scale, rtol=1e-9)
    assert np.isclose(r.distortion.sigma_ratio.mean(), r.report["distortion"]["quasi_conformal"]["mean"], rtol=1e-12)


@pytest.mark.parametrize("dtype", [np.int8, np.uint8, np.int32, np.uint32, np.int64, np.uint64, ">i4"])
def test_every_integer_type_gives_the_same_map(triangles, dtype):
    V, F = triangles
    assert np.array_equal(riemap.map(V, F.astype(dtype)).uv, riemap.map(V, F).uv)


@pytest.mark.parametrize("order", ["C", "F"])
def test_the_order_in_memory_does_not_matter(quads, order):
    V, F = quads
    r = riemap.map(np.asarray(V, order=order), np.asarray(F, order=order))
    assert np.array_equal(r.uv, riemap.map(V.tolist(), F.tolist()).uv)
    strided = np.repeat(V, 2, axis=0)[::2]
    assert np.array_equal(r.uv, riemap.map(strided, F).uv)


def test_single_precision_is_read_as_the_same_numbers(triangles):
    V, F = triangles
    single = V.astype(np.float32)
    assert np.array_equal(riemap.map(single, F).uv, riemap.map(single.astype(float), F).uv)


def test_arrays_are_left_as_they_are_and_may_be_read_only(triangles):
    V, F = triangles
    before = V.copy(), F.copy()
    V.setflags(write=False), F.setflags(write=False)
    riemap.map(V, F)
    assert np.array_equal(V, before[0]) and np.array_equal(F, before[1])


def test_vertices_that_no_face_uses_have_no_image(triangles):
    V, F = triangles
    r = riemap.map(np.vstack([[[9, 9, 9]], V]), F + 1)
    assert np.isnan(r.uv[0]).all() and np.isfinite(r.uv[1:]).all()
    assert np.array_equal(r.uv[1:], riemap.map(V, F).uv)


def test_pins_are_met(triangles):
    V, F = triangles
    corner = riemap.map(V, F).boundary
    pins = {int(corner[0]): (1, 0), np.int64(corner[10]): np.array([0.0, 1.0]), int(corner[20]): [-1, 0]}
    r = riemap.map(V, F, pins=pins)
    for vertex, place in pins.items():
        assert np.allclose(r.uv[vertex], place, atol=1e-12)


def test_boundary_lengths_are_met(triangles):
    V, F = triangles
    lengths = np.full(32, 0.25)
    r = riemap.map(V, F, boundary="free", boundary_lengths=lengths)
    assert r.report["boundary_lengths"]["error"]["max"] < 1e-8


def test_a_closed_surface_is_cut_and_has_texture_coordinates_by_corner():
    V, F = torus(24, 12)
    r = riemap.map(V, F, cut=True, boundary="free")
    assert r.faces_uv.shape == F.shape and len(r.uv_corner) > len(V)
    assert len(r.boundary) > len(np.unique(r.boundary))
    corners = r.uv_corner[r.faces_uv]
    assert np.isfinite(corners).all()
    # Every vertex has one of its images in uv.
    assert np.array_equal(np.unique(F), np.flatnonzero(np.isfinite(r.uv[:, 0])))


def test_faces_that_are_left_out_have_no_distortion(triangles):
    V, F = triangles
    inner = 30
    r = riemap.map(V, F, remove_faces=[inner], fill_holes=True)
    assert np.isnan(r.distortion.sigma_ratio[inner])
    assert np.isfinite(np.delete(r.distortion.sigma_ratio, inner)).all()


def test_the_periods_of_a_torus_are_those_of_its_profile():
    # The torus of radii 3 and 1 is conformally the rectangle with sides 1 and 1/√(3² − 1²).
    errors = []
    for n in (12, 24, 48):
        p = riemap.periods(*torus(3 * n, n))
        errors.append(abs(p.tau.imag - np.sqrt(8)))
        assert abs(p.tau.real) < 1e-9
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert errors[-1] < 0.01 and (orders > 1.8).all()


def test_face_normals_decide_about_rho():
    V, F = lifted_grid(8)
    away = np.cross(V[F[:, 2]] - V[F[:, 0]], V[F[:, 3]] - V[F[:, 1]])
    away /= np.linalg.norm(away, axis=1)[:, None]
    # On edges the normals would also decide about lengths; here all of the boundary is held.
    boundary = riemap.map(V, F).boundary
    held = {"boundary": "fixed", "positions": {v: V[v, :2] for v in boundary.tolist()}}
    own = riemap.map(V, F, face_normals=away, **held)
    assert np.allclose(own.uv, riemap.map(V, F, **held).uv, atol=1e-12)
    tilted = away + V[F].mean(axis=1) - 0.5
    tilted /= np.linalg.norm(tilted, axis=1)[:, None]
    assert not np.allclose(riemap.map(V, F, face_normals=tilted, **held).uv, own.uv, atol=1e-3)


def test_results_can_be_pickled(triangles):
    r = riemap.map(*triangles)
    again = pickle.loads(pickle.dumps(r))
    assert np.array_equal(again.uv, r.uv) and again.report == r.report
    assert "81 vertices" in repr(copy.copy(r))


def test_max_iterations_gives_the_unfinished_map(triangles):
    r = riemap.map(*triangles, solver="levenberg-marquardt", max_iterations=1, valid="off")
    assert r.report["solver"]["status"] == "max-iterations"


def test_the_list_of_options_is_the_library_s(triangles):
    with pytest.raises(TypeError, match="unknown option `bondary`") as caught:
        riemap.map(*triangles, bondary="free")
    known = set(str(caught.value).split("expected one of ")[1].replace("`", "").split(", "))
    assert known == set(riemap.Options.__annotations__)
