"""Many maps by one factor."""

import numpy as np
import pytest
import riemap
from conftest import lifted_grid


def test_a_flattener_makes_the_maps_that_map_makes(triangles):
    f = riemap.Flattener(*triangles)
    assert np.allclose(f.circle().uv, riemap.map(*triangles).uv, atol=1e-9)
    assert np.allclose(f.free().uv, riemap.map(*triangles, boundary="free").uv, atol=1e-9)
    assert np.array_equal(f.boundary, riemap.map(*triangles).boundary)
    lengths = np.full(len(f.boundary), 0.25)
    prescribed = riemap.map(*triangles, boundary="free", boundary_lengths=lengths)
    assert np.allclose(f.free(lengths).uv, prescribed.uv, atol=1e-9)


@pytest.mark.parametrize("corners", [3, 4])
def test_a_fixed_boundary_is_where_it_was_put_in_any_order(corners):
    f = riemap.Flattener(*lifted_grid(8, corners))
    angle = 2 * np.pi * np.arange(len(f.boundary)) / len(f.boundary)
    xy = np.stack([2 * np.cos(angle), np.sin(angle)], axis=1)
    first = f.fixed(f.boundary, xy)
    assert np.array_equal(first.uv[f.boundary], xy)
    shuffled = np.random.default_rng(0).permutation(len(xy))
    assert np.array_equal(f.fixed(f.boundary[shuffled], xy[shuffled]).uv, first.uv)


def test_a_fixed_boundary_is_the_whole_boundary(triangles):
    f = riemap.Flattener(*triangles)
    b, xy = f.boundary, np.zeros((len(f.boundary), 2))
    with pytest.raises(riemap.OptionError, match="shape"):
        f.fixed(b[1:], xy)
    inner = b.copy()
    inner[0] = 40
    with pytest.raises(riemap.OptionError) as caught:
        f.fixed(inner, xy)
    assert caught.value.kind == "not-the-boundary" and caught.value.vertices.tolist() == [b[0]]
    xy[3, 1] = np.nan
    with pytest.raises(riemap.OptionError, match="NaN"):
        f.fixed(b, xy)
