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


FUNCTIONS = {"harmonic": harmonic, "lscm": lscm}

header, arrays = read(sys.argv[1])
arrays, fields = FUNCTIONS[header["function"]](arrays, header["options"])
write(sys.argv[2], fields, arrays)
