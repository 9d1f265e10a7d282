"""The package and the command line program make the same maps, to the bit."""

import json
import subprocess
import sys

import numpy as np
import pytest
import riemap
from conftest import lifted_grid, torus


def written(path, V, F):
    """An OBJ file whose numbers read back as the same doubles."""
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in V.tolist()]
    lines += ["f " + " ".join(str(v + 1) for v in face) for face in F.tolist()]
    path.write_text("\n".join(lines) + "\n")
    return path


def texture(path):
    """The pairs of an OBJ file and the pair of every corner."""
    lines = path.read_text().splitlines()
    pairs = [[float(x) for x in line.split()[1:3]] for line in lines if line.startswith("vt ")]
    corners = [[int(c.split("/")[1]) - 1 for c in line.split()[1:]] for line in lines if line.startswith("f ")]
    return np.array(pairs), np.array(corners)


MESHES = {
    "triangles": lifted_grid(12, 3),
    "quads": lifted_grid(12, 4),
    "torus": torus(16, 10),
}


@pytest.mark.parametrize(
    "mesh, arguments, options",
    [
        ("triangles", [], {}),
        ("quads", [], {}),
        ("triangles", ["--boundary", "free"], {"boundary": "free"}),
        ("quads", ["--boundary", "free"], {"boundary": "free"}),
        ("triangles", ["--boundary", "fixed", "--dual", "circumcentre"], {"boundary": "fixed", "dual": "circumcentre"}),
        ("quads", ["--boundary", "fixed", "--shape", "square"], {"boundary": "fixed", "shape": "square"}),
        ("triangles", ["--energy", "H + 0.5 L"], {"energy": "H + 0.5 L"}),
        ("triangles", ["--pin", "0=1,0.1", "--energy", "H + L"], {"pins": {0: (1, 0.1)}, "energy": "H + L"}),
        ("torus", ["--cut", "--boundary", "free"], {"cut": True, "boundary": "free"}),
        ("torus", ["--boundary", "periodic"], {"boundary": "periodic"}),
    ],
)
def test_the_map_is_that_of_the_program_to_the_bit(program, tmp_path, mesh, arguments, options):
    V, F = MESHES[mesh]
    source = written(tmp_path / "in.obj", V, F)
    out, report = tmp_path / "out.obj", tmp_path / "report.json"
    subprocess.run([program, "map", source, "-o", out, "--report", report, "-q", *arguments], check=True)
    pairs, corners = texture(out)
    r = riemap.map(V, F, **options)
    assert np.array_equal(r.uv_corner, pairs) and np.array_equal(r.faces_uv, corners)
    theirs = json.loads(report.read_text())
    for part in ("energy", "distortion", "quad_graph", "periods", "cut"):
        assert r.report[part] == theirs[part]
    assert r.report.keys() <= theirs.keys()
    # From the file and written again it is the same.
    again = riemap.map(source, **options)
    again.write(tmp_path / "again.obj")
    assert np.array_equal(texture(tmp_path / "again.obj")[0], pairs)


def test_a_volume_is_mapped_as_the_program_maps_its_file(program, tmp_path):
    x, y, z = np.meshgrid(*[np.arange(-6, 7)] * 3, indexing="ij")
    volume = (x**2 + y**2 + 2 * z**2 <= 30).astype(np.uint8)
    np.save(tmp_path / "ball.npy", volume)
    out = tmp_path / "out.obj"
    subprocess.run([program, "map", tmp_path / "ball.npy", "--cut", "--boundary", "free", "-o", out, "-q"], check=True)
    r = riemap.digital.map(volume, cut=True, boundary="free")
    assert np.array_equal(r.uv_corner, texture(out)[0])


def test_python_m_riemap_is_the_program(program, tmp_path):
    (tmp_path / "riemap").symlink_to(program)
    environment = {"PATH": str(tmp_path)}
    ran = subprocess.run(
        [sys.executable, "-m", "riemap", "--version"], env=environment, capture_output=True, text=True, check=True
    )
    assert ran.stdout.startswith("riemap ")


def test_python_m_riemap_says_what_is_missing():
    ran = subprocess.run([sys.executable, "-m", "riemap", "--version"], env={"PATH": ""}, capture_output=True, text=True)
    assert ran.returncode == 1 and "cargo install" in ran.stderr
