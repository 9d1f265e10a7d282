"""Meshes that the tests share."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import numpy as np
import pytest


def lifted_grid(n: int, corners: int = 4, seed: int = 1):
    """A jittered n × n grid over the unit square, lifted to a saddle; faces of 3 or 4 corners."""
    random = np.random.default_rng(seed)
    x, y = np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1), indexing="ij")
    xy = np.stack([x, y], axis=-1)
    xy[1:-1, 1:-1] += random.uniform(-0.2 / n, 0.2 / n, (n - 1, n - 1, 2))
    V = np.concatenate([xy, (0.4 * xy[..., :1] * xy[..., 1:])], axis=-1).reshape(-1, 3)
    k = np.arange((n + 1) ** 2).reshape(n + 1, n + 1)
    quads = np.stack([k[:-1, :-1], k[1:, :-1], k[1:, 1:], k[:-1, 1:]], axis=-1).reshape(-1, 4)
    if corners == 4:
        return V, quads
    return V, np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def torus(n: int, m: int, radius: float = 3.0):
    """A torus of n × m quads with the tube radius 1."""
    s, t = np.meshgrid(np.arange(n) * 2 * np.pi / n, np.arange(m) * 2 * np.pi / m, indexing="ij")
    around = radius + np.cos(t)
    V = np.stack([around * np.cos(s), around * np.sin(s), np.sin(t)], axis=-1).reshape(-1, 3)
    k = np.arange(n * m).reshape(n, m)
    right, up = np.roll(k, -1, axis=0), np.roll(k, -1, axis=1)
    F = np.stack([k, right, np.roll(right, -1, axis=1), up], axis=-1).reshape(-1, 4)
    return V, F


@pytest.fixture
def triangles():
    return lifted_grid(8, corners=3)


@pytest.fixture
def quads():
    return lifted_grid(8)


@pytest.fixture(scope="session")
def program():
    """The command line program: $RIEMAP, or the one on PATH."""
    found = os.environ.get("RIEMAP") or shutil.which("riemap")
    if found is None:
        pytest.skip("the command line program is not there; set RIEMAP to it")
    return str(Path(found).resolve())
