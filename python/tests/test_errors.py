"""Bad input: one clear exception each, never an abort."""

import pickle

import numpy as np
import pytest
import riemap
from conftest import torus

V = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.4, 0.5, 0.3]])
F = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])


def changed(array, at, value, dtype=None):
    array = np.array(array, dtype=dtype)
    array[at] = value
    return array


@pytest.mark.parametrize(
    "vertices, faces, kind",
    [
        (changed(V, (2, 1), np.nan), F, "not-finite"),
        (changed(V, (2, 1), np.inf), F, "not-finite"),
        (V[:, :2], F, "shape"),
        (V.ravel(), F, "shape"),
        (V[None], F, "shape"),
        (V.astype(complex), F, "type"),
        (V.astype(str), F, "type"),
        (V.astype(object), F, "type"),
        (V > 0, F, "type"),
        (V, F.astype(float), "type"),
        (V, F > 0, "type"),
        (V, F.astype(str), "type"),
        (V, F[:, :2], "shape"),
        (V, F.ravel(), "shape"),
        (V, F[:0], "no-faces"),
        (V, [], "no-faces"),
        (V, 3, "type"),
        (V, [[0, 1], [0, 1, 4]], "too-few-corners"),
        (np.empty((0, 3)), F, "no-such-vertex"),
        (V, changed(F, (1, 2), 5), "no-such-vertex"),
        (V, changed(F, (1, 2), -1), "no-such-vertex"),
        (V, changed(F, (1, 2), 2**40), "no-such-vertex"),
        (V, changed(F, (1, 2), 2**63, np.uint64), "no-such-vertex"),
        (V, changed(F, (1, 2), 1), "repeated-vertex"),
        (V, F[[0, 1, 2, 3, 3]], "duplicate-faces"),
        (V, [[0, 1, 4], [1, 2, 3, 4], [3, 0, 4]], "polygons"),
        (changed(V, 4, [0.5, 0, 0]), F, "zero-area-faces"),
        (np.vstack([V, V + 9]), np.vstack([F, F + 5]), "components"),
        (*torus(6, 5), "closed"),
        (1e90 * V, F, "out-of-range"),
    ],
)
def test_a_mesh_that_cannot_be_mapped_is_a_mesh_error(vertices, faces, kind):
    with pytest.raises(riemap.MeshError) as caught:
        riemap.map(vertices, faces)
    error = caught.value
    assert isinstance(error, ValueError) and error.kind == kind
    assert error.faces.dtype == error.vertices.dtype == np.int64
    assert "--" not in str(error), "advice is in Python's words"


def test_an_error_names_faces_and_vertices():
    with pytest.raises(riemap.MeshError, match="face 1 has the vertex 7, and there are 5 vertices") as caught:
        riemap.map(V, changed(F, (1, 2), 7))
    assert caught.value.faces.tolist() == [1] and caught.value.vertices.tolist() == [7]
    again = pickle.loads(pickle.dumps(caught.value))
    assert again.kind == "no-such-vertex" and str(again) == str(caught.value)


@pytest.mark.parametrize(
    "options, words",
    [
        ({"boundary": "triangle"}, "boundary: unknown variant"),
        ({"energy": "H + Q"}, "energy"),
        ({"tolerance": "small"}, "tolerance"),
        ({"tolerance": float("nan")}, "NaN"),
        ({"tolerance": -1.0}, "tolerance"),
        ({"pins": [1, 2]}, "pins"),
        ({"pins": {0: (1, 2, 3)}}, "pins"),
        ({"pins": {-1: (1, 2)}}, "pins"),
        ({"pins": {99: (1, 0)}}, "99"),
        ({"pins": {0.5: (1, 2)}}, "pins"),
        ({"shape": "square"}, "shape"),
        ({"dual": "nowhere"}, "nowhere"),
        ({"solver": "magic", "boundary": "fixed"}, "magic"),
        ({"fix": 4}, "4"),
        ({"cut": object()}, "object"),
        ({"boundary": "periodic", "pins": {0: (0, 0)}}, "periodic"),
        ({"remove_faces": [77]}, "77"),
        ({"boundary": "free", "boundary_lengths": [1.0, 2.0]}, "boundary"),
        ({"normals": "file"}, "normals"),
    ],
)
def test_options_that_are_wrong_are_option_errors(options, words):
    with pytest.raises(riemap.OptionError, match=words) as caught:
        riemap.map(V, F, **options)
    assert isinstance(caught.value, ValueError) and "--" not in str(caught.value)


def test_a_solver_that_does_not_converge_is_a_convergence_error():
    # A tolerance that rounding forbids, by a solver that has no other measure.
    angle = np.linspace(0, 2 * np.pi, 400, endpoint=False)
    ring = np.stack([50 * np.cos(angle), np.sin(angle), np.sin(3 * angle)], axis=1)
    fan = np.stack([np.arange(400), np.roll(np.arange(400), -1), np.full(400, 400)], axis=1)
    with pytest.raises(riemap.ConvergenceError) as caught:
        riemap.map(np.vstack([ring, [[0, 0, 0]]]), fan, energy="H + L", solver="fletcher-reeves", tolerance=1e-15)
    assert isinstance(caught.value, RuntimeError) and caught.value.kind == "not-converged"


def test_one_argument_that_is_no_mesh_is_a_type_error():
    with pytest.raises(TypeError, match="faces are missing"):
        riemap.map(V)


def test_files_that_are_not_there_are_os_errors(tmp_path):
    with pytest.raises(FileNotFoundError):
        riemap.read(tmp_path / "none.obj")
    (tmp_path / "bad.obj").write_text("v 0 0 0\nf 1 2 3\n")
    with pytest.raises(riemap.MeshError, match="line 2"):
        riemap.read(tmp_path / "bad.obj")
    with pytest.raises(OSError):
        riemap.write(tmp_path / "no" / "folder.obj", V, F)
    with pytest.raises(riemap.OptionError, match="extension"):
        riemap.write(tmp_path / "mesh.stl", V, F)
    with pytest.raises(riemap.OptionError):
        riemap.map("shpere?n=3")


def test_wrong_texture_coordinates_are_not_written(tmp_path):
    for uv, faces in [(V, None), (V[:3, :2], None), (V[:, :2] * np.nan, None), (V[:3, :2], F), (V[:, :2], F[:2])]:
        with pytest.raises(riemap.OptionError):
            riemap.write(tmp_path / "mesh.obj", V, F, uv, faces)
    assert not (tmp_path / "mesh.obj").exists()
