"""Discrete conformal maps of triangle meshes, quad meshes and digital surfaces: NumPy arrays in, NumPy arrays out.

    import riemap

    r = riemap.map(V, F, boundary="free")    # V (n, 3), F (m, 3) or (m, 4)
    r.uv                                     # (n, 2)
    r.distortion.sigma_ratio                 # (m,)

Vertices and faces count from 0. Lengths are in the unit of V.
"""

from importlib.metadata import version as _version

from . import digital
from ._errors import ConvergenceError, MeshError, OptionError
from ._files import read, write
from ._flattener import Flattener
from ._map import Periods, map, periods
from ._matrix import laplacian, system, verify_cotan
from ._options import Options
from ._result import Distortion, Map

__version__ = _version("riemap")

__all__ = [
    "ConvergenceError",
    "Distortion",
    "Flattener",
    "Map",
    "MeshError",
    "OptionError",
    "Options",
    "Periods",
    "digital",
    "laplacian",
    "map",
    "periods",
    "read",
    "system",
    "verify_cotan",
    "write",
]
