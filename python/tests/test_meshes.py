"""Mesh objects of other libraries, by what they look like; files; voxels."""

from types import SimpleNamespace

import numpy as np
import pytest
import riemap


def block(kind, data):
    return SimpleNamespace(type=kind, data=np.asarray(data))


def test_meshes_of_other_libraries_are_taken_apart(triangles, quads):
    V, F = triangles
    uv = riemap.map(V, F).uv
    counts = np.full((len(F), 1), 3)
    for mesh in (
        SimpleNamespace(vertices=V, faces=F),
        SimpleNamespace(points=V, faces=np.hstack([counts, F]).ravel()),
        SimpleNamespace(points=V, cells=[block("line", [[0, 1]]), block("triangle", F[:40]), block("triangle", F[40:])]),
    ):
        assert np.array_equal(riemap.map(mesh).uv, uv)
    V, F = quads
    mesh = SimpleNamespace(points=V, cells=[block("quad", F)])
    assert np.array_equal(riemap.Flattener(mesh).boundary, riemap.map(V, F).boundary)


def test_mixed_polygons_are_read_and_refused_by_name(triangles):
    V, F = triangles
    mixed = SimpleNamespace(points=V, faces=np.array([3, 0, 1, 10, 4, 0, 10, 9, 1]))
    with pytest.raises(riemap.MeshError) as caught:
        riemap.map(mixed)
    assert caught.value.kind == "polygons" and caught.value.faces.tolist() == [1]
    torn = SimpleNamespace(points=V, faces=np.array([3, 0, 1, 10, 4, 0, 10]))
    with pytest.raises(riemap.MeshError, match="the list ends"):
        riemap.map(torn)
    with pytest.raises(riemap.MeshError, match="no triangles or quads: line"):
        riemap.map(SimpleNamespace(points=V, cells=[block("line", [[0, 1]])]))


@pytest.mark.parametrize("extension", ["obj", "ply"])
def test_files_hold_the_same_numbers(tmp_path, quads, extension):
    V, F = quads
    path = tmp_path / f"mesh.{extension}"
    riemap.write(path, V, F, riemap.map(V, F).uv)
    read = riemap.read(path)
    assert np.array_equal(read[0], V) and np.array_equal(read[1], F)
    mixed = [[0, 1, 10], [0, 10, 9, 1]]
    riemap.write(path, V, mixed)
    assert riemap.read(path)[1] == mixed


def test_the_boundary_of_a_ball_of_voxels_has_normals_along_its_radii():
    x, y, z = np.meshgrid(*[np.arange(-12, 13)] * 3, indexing="ij")
    V, F, N = riemap.digital.surface(150.5 - (x**2 + y**2 + z**2), threshold=0)
    centres = V[F].mean(axis=1) - 12
    radial = centres / np.linalg.norm(centres, axis=1)[:, None]
    assert V.dtype == float and F.shape[1] == 4 and N.shape == F.shape[:1] + (3,)
    assert (N * radial).sum(axis=1).min() > 0.95
    cap = riemap.digital.map(x**2 + y**2 + z**2 < 150.5, threshold=0.5, cut=True, boundary="free")
    assert len(cap.faces) == len(F)


def test_components_and_adjacency_of_voxels():
    cubes = np.zeros((3, 3, 1), dtype=bool)
    cubes[0, 0, 0] = cubes[1, 1, 0] = True
    assert len(riemap.digital.surface(cubes)[1]) == 6
    assert len(riemap.digital.surface(cubes, adjacency=18)[1]) == 12
    with pytest.raises(riemap.MeshError, match="no component 2"):
        riemap.digital.surface(cubes, component=2)


@pytest.mark.parametrize(
    "volume, threshold, error",
    [
        (np.zeros((3, 3, 3)), 0, riemap.MeshError),
        (np.ones((3, 3)), 0, riemap.MeshError),
        (np.empty((0, 3, 3)), 0, riemap.MeshError),
        (np.full((2, 2, 2), np.nan), 0, riemap.MeshError),
        (np.ones((2, 2, 2), dtype=complex), 0, riemap.MeshError),
        (np.ones((2, 2, 2)), np.nan, riemap.OptionError),
    ],
)
def test_volumes_without_a_surface_are_refused(volume, threshold, error):
    with pytest.raises(error):
        riemap.digital.surface(volume, threshold)
