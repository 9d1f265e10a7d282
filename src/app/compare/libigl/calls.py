"""Runs one libigl function on the arrays of a request file and writes its answer.

    python -c <this> REQUEST ANSWER

Both files are one line of JSON and then the arrays it lists, in order, little-endian, row after row:
{"function": "harmonic", "options": {}, "arrays": [{"name": "positions", "type": "f8", "columns": 3, "rows": 25}, ...]}
An answer has "fields" in place of the function and its options.
"""

import json
import sys
import time

import igl
import numpy as np
import scipy.sparse
import scipy.sparse.linalg


def read(path):
    with open(path, "rb") as file:
        header = json.loads(file.readline())
        arrays = {}
        for a in header["arrays"]:
            count = a["rows"] * a["columns"]
            flat = np.fromfile(file, "<" + a["type"], count)
            if flat.size != count:
                raise ValueError("the request file ends within the array " + a["name"])
            # libigl takes no other types than these two
            flat = flat.astype(np.float64 if a["type"] == "f8" else np.int64)
            arrays[a["name"]] = flat if a["columns"] == 1 else flat.reshape(a["rows"], a["columns"])
        return header, arrays


def write(path, fields, arrays):
    arrays = {name: np.ascontiguousarray(a, "<f8") for name, a in arrays.items()}
    header = {
        "fields": fields,
        "arrays": [
            {"name": name, "type": "f8", "rows": a.shape[0], "columns": a.shape[1]} for name, a in arrays.items()
        ],
    }
    with open(path, "wb") as file:
        file.write(json.dumps(header).encode() + b"\n")
        for a in arrays.values():
            a.tofile(file)


def timed(function, *arguments):
    """The function's value and what it took, without anything before or after it."""
    wall, cpu = time.perf_counter(), time.process_time()
    value = function(*arguments)
    cpu, wall = time.process_time() - cpu, time.perf_counter() - wall
    return value, {"seconds_cpu": cpu, "seconds_wall": wall}


def interior_weights(positions, triangles):
    """Entries L_ij of libigl's cotangent matrix, one an edge with two triangles: (cot a + cot b)/2, positive when good."""
    n = len(positions)
    a, b = triangles, np.roll(triangles, -1, axis=1)
    keys = np.maximum(a, b) * n + np.minimum(a, b)
    edges, count = np.unique(keys[a != b], return_counts=True)
    weights = igl.cotmatrix(positions, triangles).tocoo()
    upper = weights.row < weights.col
    keys = weights.col[upper].astype(np.int64) * n + weights.row[upper]
    # every edge has an entry, also where it is 0
    order = np.argsort(keys, kind="stable")
    if not np.array_equal(keys[order], edges):
        raise ValueError("igl.cotmatrix has not one entry per edge")
    return weights.data[upper][order][count > 1]


def harmonic(a, options):
    uv, seconds = timed(igl.harmonic, a["positions"], a["triangles"], a["fixed"], a["values"], 1)
    weights = interior_weights(a["positions"], a["triangles"])
    negative = weights < -options["zero_weight"]
    return {"uv": uv}, {**seconds, "interior_edges": weights.size, "negative_weights": int(negative.sum())}


def lscm(a, options):
    # the second value is the matrix of its energy
    (uv, _), seconds = timed(igl.lscm, a["positions"], a["triangles"], a["fixed"], a["values"])
    return {"uv": uv}, seconds


def doubled_areas(uv, triangles):
    a, b, c = (uv[triangles[:, k]] for k in range(3))
    return (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])


def tutte(triangles, count, fixed, values):
    """Every free vertex is the mean of its neighbours."""
    a = np.concatenate([triangles, np.roll(triangles, -1, axis=1)], axis=1).reshape(-1, 2, 3)
    rows, columns = a[:, 0].ravel(), a[:, 1].ravel()
    both = np.concatenate([rows, columns]), np.concatenate([columns, rows])
    adjacency = scipy.sparse.coo_matrix((np.ones(len(both[0])), both), (count, count)).tocsr()
    adjacency.data[:] = 1.0
    laplacian = (scipy.sparse.diags(np.asarray(adjacency.sum(axis=1)).ravel()) - adjacency).tocsc()
    free = np.setdiff1d(np.arange(count), fixed)
    uv = np.zeros((count, 2))
    uv[fixed] = values
    if free.size:
        right = -(laplacian[free][:, fixed] @ values)
        uv[free] = scipy.sparse.linalg.splu(laplacian[free][:, free]).solve(right)
    return uv


def slim(a, options):
    positions, triangles, fixed, values = a["positions"], a["triangles"], a["fixed"], a["values"]
    area = 0.5 * igl.doublearea(positions, triangles).sum()
    values = values * np.sqrt(area / np.pi)
    start = igl.harmonic(positions, triangles, fixed, values, 1)
    uniform = not (np.isfinite(start).all() and (doubled_areas(start, triangles) > 0).all())
    if uniform:
        start = tutte(triangles, len(positions), fixed, values)
    nothing = np.zeros(0, np.int32), np.zeros((0, 2), order="F")

    def solve():
        data = igl.slim_precompute(
            np.asfortranarray(positions),
            np.asfortranarray(triangles, np.int32),
            np.asfortranarray(start),
            igl.SYMMETRIC_DIRICHLET,
            *nothing,
            0.0,
        )
        return igl.slim_solve(data, options["iterations"])

    uv, seconds = timed(solve)
    return {"uv": uv[:, :2]}, {**seconds, "uniform_start": int(uniform)}


FUNCTIONS = {"harmonic": harmonic, "lscm": lscm, "slim": slim}

header, arrays = read(sys.argv[1])
arrays, fields = FUNCTIONS[header["function"]](arrays, header["options"])
write(sys.argv[2], fields, arrays)
