"""Flattens a surface, compares the map with libigl's LSCM and draws both: python flatten.py [MESH]

Needs libigl and matplotlib.
"""

import sys

import igl
import matplotlib.pyplot as plt
import numpy as np
import riemap

V, F = riemap.read(sys.argv[1] if len(sys.argv) > 1 else "sphere?n=32&mesh=delaunay")
ours = riemap.map(V, F, boundary="free")
ends = ours.boundary[[0, len(ours.boundary) // 2]]
lscm = igl.lscm(V, F, ends, np.ascontiguousarray(ours.uv[ends]))
lscm = lscm[0] if isinstance(lscm, tuple) else lscm
print(f"{ours!r}\nmean σ1/σ2: {np.nanmean(ours.distortion.sigma_ratio):.6f}")
print(f"largest distance to LSCM: {np.nanmax(np.linalg.norm(ours.uv - lscm, axis=1)):.3e}")
for axes, uv, title in zip(plt.subplots(1, 2)[1], (ours.uv, lscm), ("riemap", "LSCM")):
    axes.triplot(*uv.T, F, linewidth=0.3)
    axes.set(title=title, aspect="equal")
plt.savefig("flat.png", dpi=200)
