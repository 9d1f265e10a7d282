"""Discs out of a folder of OFF meshes, for the study of maps without folds (data.md): python3 discs.py FROM INTO

A component that is a disc is taken as it is. Of another one three discs are grown, face by face in the order of the distance from a face
chosen at random: the whole as far as it goes (cut open along what is met last), a part of it, and the half on one side of a plane. Then the
last disc of the largest component is divided into quads (INTO/quads), every triangle into three. 60 000 faces at most. Needs numpy.
"""

import heapq
import os
import re
import sys

import numpy as np

MOST = 60000


def read(path):
    """Positions and polygons."""
    lines = [words for words in (line.split("#")[0].split() for line in open(path, errors="replace")) if words]
    counts, lines = (lines[1], lines[2:]) if len(lines[0]) == 1 else (lines[0][1:], lines[1:])
    vertices, faces = int(counts[0]), int(counts[1])
    positions = np.array([[float(x) for x in words[:3]] for words in lines[:vertices]])
    return positions, [[int(v) for v in w[1 : 1 + int(w[0])]] for w in lines[vertices : vertices + faces]]


def write(path, positions, faces):
    used = np.unique(faces)
    new = -np.ones(len(positions), int)
    new[used] = np.arange(len(used))
    with open(path, "w") as out:
        out.write(f"OFF\n{len(used)} {len(faces)} 0\n")
        out.writelines("%.17g %.17g %.17g\n" % tuple(p) for p in positions[used])
        out.writelines(f"{len(f)} " + " ".join(map(str, f)) + "\n" for f in new[faces])


def neighbours(triangles):
    """The face across each edge, -1 where there is none, or more than one, or one of the other orientation."""
    sides = {}
    for f, t in enumerate(triangles):
        for k in range(3):
            v, w = t[k], t[(k + 1) % 3]
            sides.setdefault((min(v, w), max(v, w)), []).append((f, k, v < w))
    across = -np.ones((len(triangles), 3), int)
    for pair in sides.values():
        if len(pair) == 2 and pair[0][2] != pair[1][2]:
            (f, i, _), (g, j, _) = pair
            across[f, i], across[g, j] = g, f
    return across


def components(across):
    of = -np.ones(len(across), int)
    count = 0
    for seed in range(len(across)):
        if of[seed] < 0:
            stack, of[seed] = [seed], count
            while stack:
                for g in across[stack.pop()]:
                    if g >= 0 and of[g] < 0:
                        of[g] = count
                        stack.append(g)
            count += 1
    return of, count


def is_disc(triangles, across):
    border = int(np.sum(across < 0))
    edges = (3 * len(triangles) + border) // 2
    if len(np.unique(triangles)) - edges + len(triangles) != 1 or border == 0:
        return False
    after = {}
    for f, k in np.argwhere(across < 0):
        if int(triangles[f, k]) in after:
            return False
        after[int(triangles[f, k])] = int(triangles[f, (k + 1) % 3])
    first = next(iter(after))
    v, n = after[first], 1
    while v != first:
        v, n = after[v], n + 1
    return n == border


def grow(positions, triangles, across, seed, allowed, most, by_hops=False):
    """A disc of at most so many faces round the seed: a face is added where it shares two edges with it, or one and no other vertex."""
    centres = positions[triangles].mean(1)
    inside = np.zeros(len(triangles), bool)
    vertices, faces = set(), []
    distance, heap = {seed: 0.0}, [(0.0, seed)]
    while heap and len(faces) < most:
        here, f = heapq.heappop(heap)
        if inside[f] or here > distance.get(f, 1e300):
            continue
        t = triangles[f]
        shared = [k for k in range(3) if across[f, k] >= 0 and inside[across[f, k]]]
        opposite_is_new = len(shared) == 1 and t[(shared[0] + 2) % 3] not in vertices
        if faces and not (len(shared) == 2 or opposite_is_new):
            continue
        inside[f] = True
        vertices.update(int(v) for v in t)
        faces.append(f)
        for g in across[f]:
            if g >= 0 and allowed[g] and not inside[g]:
                there = here + (1.0 if by_hops else float(np.linalg.norm(centres[f] - centres[g])))
                distance[g] = min(there, distance.get(g, 1e300))
                heapq.heappush(heap, (distance[g], g))
    return triangles[faces]


def quads(positions, triangles):
    """Every triangle as three quads round its centre."""
    places, middles, faces = list(positions), {}, []
    for t in triangles:
        centre = len(places)
        places.append((places[t[0]] + places[t[1]] + places[t[2]]) / 3)
        for v, w in zip(t, np.roll(t, -1)):
            if (min(v, w), max(v, w)) not in middles:
                middles[min(v, w), max(v, w)] = len(places)
                places.append((places[v] + places[w]) / 2)
        middle = [middles[min(v, w), max(v, w)] for v, w in zip(t, np.roll(t, -1))]
        faces += [[t[k], middle[k], centre, middle[k - 1]] for k in range(3)]
    return np.array(places), np.array(faces)


def discs(name, path, random):
    """Names, positions and faces."""
    positions, polygons = read(path)
    triangles = np.array([[f[0], f[k], f[k + 1]] for f in polygons for k in range(1, len(f) - 1)], int).reshape(-1, 3)
    triangles = triangles[[len(set(t)) == 3 for t in triangles.tolist()]]
    a, b, c = (positions[triangles[:, k]] for k in range(3))
    proper = np.linalg.norm(np.cross(b - a, c - a), axis=1) > 0
    is_quads = all(len(f) == 4 for f in polygons)
    across = neighbours(triangles)
    of, count = components(across)
    last = None
    for place, component in enumerate(np.argsort(-np.bincount(of), kind="stable")[:3] if count else []):
        chosen = np.where(of == component)[0]
        if len(chosen) < 8:
            continue
        new = -np.ones(len(triangles) + 1, int)
        new[chosen] = np.arange(len(chosen))
        faces, beside, ok = triangles[chosen], np.where(across[chosen] >= 0, new[across[chosen]], -1), proper[chosen]
        stem, made = (f"{name}-{component}" if count > 1 else name), []

        def seed():
            while True:
                f = int(random.integers(len(faces)))
                if ok[f]:
                    return f

        if is_disc(faces, beside):
            if ok.all() and len(faces) <= MOST and not is_quads:
                made.append((stem, faces))
            if is_quads and count == 1:
                yield "quads/" + stem, positions, np.array(polygons)
        else:
            whole = grow(positions, faces, beside, seed(), ok, min(MOST, len(faces) - 1))
            made.append((stem + "-whole", whole))
            if len(faces) >= 300:
                start = seed()
                most = min(MOST, int(len(faces) * random.uniform(0.2, 0.7)))
                made.append((stem + "-part", grow(positions, faces, beside, start, ok, most)))
                normal = random.normal(size=3)
                centres = positions[faces].mean(1)
                height = (centres - centres.mean(0)) @ normal
                farthest = int(np.argmax(np.where(ok, height, -1e300)))
                by_hops = len(faces) % 2 == 1
                half = grow(positions, faces, beside, farthest, (height > 0) & ok, MOST, by_hops)
                made.append((stem + "-half", half))
        for label, part in made:
            yield label, positions, part
        if place == 0 and made and not is_quads and 20 <= len(made[-1][1]) <= 15000:
            last = made[-1]
    if last:
        label, part = last
        used, part = np.unique(part, return_inverse=True)
        yield ("quads/" + label, *quads(positions[used], part.reshape(-1, 3)))


def main(source, target):
    os.makedirs(os.path.join(target, "quads"), exist_ok=True)
    random = np.random.default_rng(7)
    for file in sorted(f for f in os.listdir(source) if f.endswith(".off")):
        path = os.path.join(source, file)
        if os.path.getsize(path) <= 2048 or "-shuffled" in file:
            continue
        name = re.sub(r"[^A-Za-z0-9_-]", "_", file.split(".")[0])
        for label, positions, faces in discs(name, path, random):
            write(os.path.join(target, label + ".off"), positions, faces)


if __name__ == "__main__":
    main(*sys.argv[1:3])
