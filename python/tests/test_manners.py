"""Threads, interrupts, progress, memory."""

import _thread
import gc
import resource
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
import riemap
from conftest import lifted_grid


def test_threads_map_at_once_and_get_the_same():
    meshes = [lifted_grid(n, corners) for n in (10, 20, 30) for corners in (3, 4)]
    alone = [riemap.map(*mesh).uv for mesh in meshes]
    with ThreadPoolExecutor(6) as pool:
        together = list(pool.map(lambda mesh: riemap.map(*mesh).uv, 3 * meshes))
    assert all(np.array_equal(a, b) for a, b in zip(3 * alone, together))
    shared = riemap.Flattener(*meshes[0])
    with ThreadPoolExecutor(4) as pool:
        maps = list(pool.map(lambda _: shared.circle().uv, range(16)))
    assert all(np.array_equal(maps[0], uv) for uv in maps)


def test_other_threads_run_while_a_map_is_made():
    V, F = lifted_grid(150, 3)
    ticks, done = [], threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    ticking = threading.Thread(target=tick)
    ticking.start()
    begun = time.perf_counter()
    riemap.map(V, F)
    ended = time.perf_counter()
    done.set()
    ticking.join()
    during = [t for t in ticks if begun < t < ended]
    # With the lock held no other thread would come to its turn in between.
    assert len(during) >= 3


def test_progress_hears_of_phases_and_iterations(triangles):
    heard = []
    riemap.map(*triangles, progress=lambda phase, iteration: heard.append((phase, iteration)))
    phases = [phase for phase, iteration in heard if iteration is None]
    assert phases[0] == "assemble" and phases[-1] == "measure" and {"factor", "solve"} <= set(phases)
    numbers = [iteration["number"] for _, iteration in heard if iteration is not None]
    assert numbers and all(np.isfinite(iteration["energy"]) for _, iteration in heard if iteration)


def test_an_exception_of_progress_ends_the_map(triangles):
    class Enough(Exception):
        pass

    def progress(phase, iteration):
        if iteration is not None:
            raise Enough("that will do")

    with pytest.raises(Enough, match="that will do"):
        riemap.map(*triangles, progress=progress)


def test_ctrl_c_ends_a_long_map():
    V, F = lifted_grid(60, 3)
    timer = threading.Timer(0.3, _thread.interrupt_main)
    timer.start()
    begun = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        # Some hundred thousand steps, each short.
        riemap.map(V, F, energy="H + L", solver="fletcher-reeves", tolerance=1e-15, max_iterations=10**7)
        pytest.fail("the map came to its end")
    assert time.perf_counter() - begun < 20


def resident():
    """Bytes of memory that the process holds now."""
    status = Path("/proc/self/statm")
    if not status.exists():
        pytest.skip("no /proc")
    return int(status.read_text().split()[1]) * resource.getpagesize()


def test_a_thousand_maps_leave_no_memory_behind():
    V, F = lifted_grid(12, 3)

    def once():
        riemap.map(V, F, progress=lambda *_: None)
        riemap.Flattener(V, F).circle()
        with pytest.raises(riemap.MeshError):
            riemap.map(V, F + 1)

    for _ in range(100):
        once()
    gc.collect()
    before = resident()
    for _ in range(1000):
        once()
    gc.collect()
    # One map's arrays are 30 kB: a leak of them all would be 30 MB.
    assert resident() - before < 4e6


def test_nothing_is_printed(capfd, triangles):
    riemap.map(*triangles)
    with pytest.raises(riemap.MeshError):
        riemap.map(triangles[0], triangles[1] + 100)
    assert capfd.readouterr() == ("", "")


def test_scipy_is_imported_when_it_is_needed():
    import subprocess

    code = "import sys, riemap; print('scipy' in sys.modules, 'igl' in sys.modules)"
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ran.stdout.split() == ["False", "False"]
