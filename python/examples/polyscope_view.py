"""Shows a surface with the checkerboard and the distortion of its map in Polyscope: python polyscope_view.py [MESH]

Needs polyscope and a display.
"""

import sys

import polyscope
import riemap

r = riemap.map(sys.argv[1] if len(sys.argv) > 1 else "sphere?n=32&mesh=delaunay", boundary="free")

polyscope.init()
mesh = polyscope.register_surface_mesh("surface", r.vertices, r.faces)
# One pair for every corner: surfaces that were cut have several at a vertex.
corners = r.uv_corner[r.faces_uv.ravel()]
mesh.add_parameterization_quantity("map", corners, defined_on="corners", coords_type="world", enabled=True)
mesh.add_scalar_quantity("σ1/σ2", r.distortion.sigma_ratio, defined_on="faces")
polyscope.show()
