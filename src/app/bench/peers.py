"""Maps one mesh by one function of another program, in a process of its own.

    python -c <this> METHOD MESH UV [key=value ...]

MESH is an OBJ file with `v` and triangular `f` lines alone. UV receives the map: two little-endian doubles per vertex, in
order. What it took, and what took part, is printed as one line of JSON. `solve` begins with vertices and faces in memory and
ends with the map there, assembly included. Where the library allows it, `assembly` and `factor` (analysis, factorisation,
solution) are told apart; libigl's and MeshLab's functions assemble inside. The process runs with one thread: its environment says so.

    python -c <this> versions

prints the versions of what is installed.
"""

import json
import sys
import time


def versions():
    import importlib.metadata
    import importlib.util

    found = {"python": "%d.%d.%d" % sys.version_info[:3]}
    packages = [("igl", "libigl"), ("numpy", "numpy"), ("scipy", "scipy"), ("pymeshlab", "pymeshlab"), ("sksparse", "scikit-sparse")]
    for module, package in packages:
        if importlib.util.find_spec(module) is None:
            continue
        try:
            found[package] = importlib.metadata.version(package)
        except importlib.metadata.PackageNotFoundError:
            found[package] = "unknown"
    return found


class Clock:
    """Seconds between its making and `stop`, by the clock and of the processor."""

    def __init__(self):
        self.wall, self.cpu = time.perf_counter(), time.process_time()

    def stop(self):
        cpu, wall = time.process_time() - self.cpu, time.perf_counter() - self.wall
        return {"wall": wall, "cpu": cpu}


def read(path):
    import igl

    # positions n x 3, triangles m x 3
    v, f = igl.read_triangle_mesh(path)
    return v.astype("f8", order="C"), f.astype("i8", order="C")


def circle(v, f):
    """The boundary's vertices, and their places on the unit circle by arc length."""
    import igl
    import numpy as np

    loop = np.asarray(igl.boundary_loop(f)).astype("i8")
    lengths = np.linalg.norm(np.roll(v[loop], -1, axis=0) - v[loop], axis=1)
    angle = 2 * np.pi * np.concatenate([[0], np.cumsum(lengths)[:-1]]) / lengths.sum()
    return loop, np.column_stack([np.cos(angle), np.sin(angle)])


def start(v, f):
    """A valid map to begin with: harmonic, on a disc of the surface's area."""
    import igl
    import numpy as np

    held, places = circle(v, f)
    radius = np.sqrt(igl.doublearea(v, f).sum() / 2 / np.pi)
    return igl.harmonic(v, f, held, places * radius, 1)


def libigl_harmonic(path):
    import igl

    v, f = read(path)
    clock = Clock()
    held, places = circle(v, f)
    uv = igl.harmonic(v, f, held, places, 1)
    return uv, {"solve": clock.stop()}


def libigl_lscm(path):
    import igl
    import numpy as np

    v, f = read(path)
    clock = Clock()
    loop = np.asarray(igl.boundary_loop(f)).astype("i8")
    held = np.array([loop[0], loop[len(loop) // 2]], "i8")
    uv = igl.lscm(v, f, held, np.array([[0.0, 0.0], [1.0, 0.0]]))[0]
    return uv, {"solve": clock.stop()}


def libigl_arap(path, iterations=20):
    import igl
    import numpy as np

    v, f = read(path)
    clock = Clock()
    uv = np.asfortranarray(start(v, f))
    data = igl.ARAPData()
    data.max_iter = iterations
    data.with_dynamics = False
    # one vertex is held: without any, libigl 2.6.3 refuses
    igl.arap_precomputation(v, f, 2, np.zeros(1, "i4"), data)
    uv = igl.arap_solve(uv[:1], data, uv)
    return uv, {"solve": clock.stop(), "iterations": iterations}


def libigl_slim(path, iterations=20):
    import igl
    import numpy as np

    v, f = read(path)
    clock = Clock()
    uv = start(v, f)
    none, nowhere = np.zeros(0, "i4"), np.zeros((0, 2), order="F")
    energy = igl.MappingEnergyType.SYMMETRIC_DIRICHLET
    order = np.asfortranarray
    data = igl.slim_precompute(order(v), order(f.astype("i4")), order(uv), energy, none, nowhere, 0.0)
    uv = igl.slim_solve(data, iterations)
    return uv[:, :2], {"solve": clock.stop(), "iterations": iterations}


def cotangents(v, f):
    """The cotan Laplacian, positive semi-definite, n x n."""
    import numpy as np
    import scipy.sparse as sp

    n, rows, columns, values = len(v), [], [], []
    for k in range(3):
        a, b, c = f[:, k], f[:, (k + 1) % 3], f[:, (k + 2) % 3]
        p, q = v[b] - v[a], v[c] - v[a]
        half = 0.5 * np.einsum("ij,ij->i", p, q) / np.linalg.norm(np.cross(p, q), axis=1)
        rows.append(b)
        columns.append(c)
        values.append(half)
    rows, columns, values = map(np.concatenate, (rows, columns, values))
    w = sp.coo_matrix((values, (rows, columns)), (n, n)).tocsc()
    w = w + w.T
    return (sp.diags(np.asarray(w.sum(axis=1)).ravel()) - w).tocsc()


def cholmod_harmonic(path):
    import numpy as np
    from sksparse.cholmod import analyze

    v, f = read(path)
    clock = Clock()
    held, places = circle(v, f)
    laplacian = cotangents(v, f)
    inside = np.ones(len(v), bool)
    inside[held] = False
    rows = laplacian[inside]
    matrix, right = rows[:, inside].tocsc(), -(rows[:, held] @ places)
    assembly, alone = clock.stop(), Clock()
    factor = analyze(matrix)
    factor.cholesky_inplace(matrix)
    inner = factor.solve_A(right)
    apart = alone.stop()
    uv = np.empty((len(v), 2))
    uv[held], uv[inside] = places, inner
    return uv, {"solve": clock.stop(), "assembly": assembly, "factor": apart}


def meshlab(path, apply):
    import pymeshlab

    meshes = pymeshlab.MeshSet(verbose=False)
    meshes.load_new_mesh(path)
    clock = Clock()
    apply(meshes)
    solve = clock.stop()
    return meshes.current_mesh().vertex_tex_coord_matrix(), {"solve": solve}


def meshlab_harmonic(path):
    return meshlab(path, lambda m: m.compute_texcoord_parametrization_harmonic(harm_function=1))


def meshlab_lscm(path):
    return meshlab(path, lambda m: m.compute_texcoord_parametrization_least_squares_conformal_maps())


METHODS = {
    "libigl-harmonic": libigl_harmonic,
    "libigl-lscm": libigl_lscm,
    "libigl-arap": libigl_arap,
    "libigl-slim": libigl_slim,
    "cholmod-harmonic": cholmod_harmonic,
    "meshlab-harmonic": meshlab_harmonic,
    "meshlab-lscm": meshlab_lscm,
}


def peak():
    """The most memory held at once, in bytes."""
    try:
        with open("/proc/self/status") as status:
            for line in status:
                if line.startswith("VmHWM:"):
                    return 1024 * int(line.split()[1])
    except OSError:
        pass
    return None


if sys.argv[1] == "versions":
    print(json.dumps(versions()))
else:
    method, mesh, target = sys.argv[1:4]
    uv, answer = METHODS[method](mesh)
    import numpy as np

    np.ascontiguousarray(uv, "<f8").tofile(target)
    answer["peak_bytes"] = peak()
    print(json.dumps(answer))
