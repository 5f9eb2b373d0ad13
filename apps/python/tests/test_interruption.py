"""Ctrl-C in each long call: it ends as KeyboardInterrupt, soon, and leaves what there was. Each call would take many times as long as
it is given."""

import os
import signal
import threading
import time

import numpy as np
import pytest

import retrace

SOON_S = 3  # of processor time of all threads, as a busy machine gives little of it; signals are looked for ten times a second
RNG = np.random.default_rng(2)


def interrupt(call, after_s=0.2):
    def press():
        pressed.append(time.process_time())
        os.kill(os.getpid(), signal.SIGINT)

    pressed = []
    timer = threading.Timer(after_s, press)
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            call()
        assert time.process_time() - pressed[0] < SOON_S
    finally:
        timer.cancel()
        timer.join()


def folder_of(path, pictures, count):
    """A folder of `count` pictures, the given ones forth and back."""
    path.mkdir()
    for i, picture in enumerate(pictures):
        (path / f"{i}.pgm").write_bytes(b"P5 %d %d 255\n" % picture.shape[::-1] + picture.tobytes())
    n = len(pictures)
    for i in range(n, count):
        at = i % (2 * n - 2)
        os.link(path / f"{min(at, 2 * n - 2 - at)}.pgm", path / f"{i}.pgm")
    return str(path)


@pytest.fixture(scope="module")
def large(tmp_path_factory):
    """An hour of large pictures."""
    pictures = RNG.integers(0, 256, (20, 480, 640), dtype=np.uint8)
    return folder_of(tmp_path_factory.mktemp("large") / "walk", pictures, 5000)


@pytest.fixture(scope="module")
def long(tmp_path_factory):
    """A walk of many keyframes, for a route that compares all of them."""
    pictures = [np.kron(RNG.integers(0, 256, (6, 12), dtype=np.uint8), np.ones((8, 8), np.uint8)) for _ in range(500)]
    folder = folder_of(tmp_path_factory.mktemp("long") / "walk", pictures, 6000)
    return retrace.read_walk(folder, motion="none", every=1, descriptor="thumbnail", preview_width_px=0)


def test_while_a_walk_is_read(large, tmp_path):
    route = retrace.Route()
    interrupt(lambda: retrace.read_walk(large))
    interrupt(lambda: retrace.read_walk(large, route))
    interrupt(lambda: retrace.read_walk(large, motion="none", every=1))
    interrupt(lambda: retrace.build(large))
    interrupt(lambda: retrace.odometry(large))
    interrupt(lambda: retrace.odometry(large, motion="hybrid"))


def test_with_a_callback_of_progress(large):
    seen = []
    interrupt(lambda: retrace.read_walk(large, progress=lambda stage, done, total: seen.append(done)))


def test_while_a_walk_is_sought(long):
    route = retrace.Route(motion="none", every=1, descriptor="thumbnail")
    route.add("a", long)
    for search in ("path", "lines"):
        interrupt(lambda search=search: retrace.localise(route, long, search=search))
    route.add("b", long)  # nothing is left of the calls before


@pytest.mark.parametrize("metric", ["cosine", "l1", "l2"])
def test_while_floats_are_compared(metric):
    rows = RNG.standard_normal((6000, 4096), dtype=np.float32)
    interrupt(lambda: retrace.cost_matrix(rows, rows, metric=metric))


def test_while_bytes_are_compared():
    rows = RNG.integers(0, 256, (8000, 16384), dtype=np.uint8)
    interrupt(lambda: retrace.cost_matrix(rows, rows, metric="sad"))


@pytest.mark.parametrize("method", ["path", "lines", "cone", "hybrid", "graph"])
def test_while_a_matrix_is_searched(method):
    costs = RNG.standard_normal((7000, 7000), dtype=np.float32)
    before = costs[::1000].copy()
    interrupt(lambda: retrace.search(costs, method=method, sequence_length=40))
    assert np.array_equal(costs[::1000], before)


def test_while_samples_are_drawn():
    time_s = np.arange(0, 2000, 0.5)
    run = (time_s, time_s, RNG.uniform(size=len(time_s)), time_s)
    interrupt(lambda: retrace.bootstrap([run, run], 1, resamples=100_000))


def test_while_pictures_are_normalised():
    pictures = np.zeros((400, 1080, 1920), np.uint8)
    interrupt(lambda: retrace.patch_normalise(pictures, shape="window"))


def test_while_a_route_is_written_and_read(long, tmp_path):
    route = retrace.Route(motion="none", every=1, descriptor="thumbnail")
    route.add("a", long)
    path = tmp_path / "route.db"
    route.save(str(path))
    before = path.read_bytes()
    for i in range(8):
        route.add(f"b{i}", long)
    interrupt(lambda: route.save(str(path)), 0.02)
    assert os.listdir(tmp_path) == ["route.db"] and path.read_bytes() == before
    route.save(str(path))
    interrupt(lambda: retrace.Route.open(str(path)), 0.02)
    assert len(retrace.Route.open(str(path)).traverses) == 9


def test_a_handler_that_raises_nothing_ends_nothing():
    calls = []
    before = signal.signal(signal.SIGALRM, lambda *_: calls.append(time.monotonic()))
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.1, 0.1)
        costs = RNG.standard_normal((3000, 3000), dtype=np.float32)
        found = retrace.search(costs, method="hybrid", sequence_length=40)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    assert calls and len(found.reference) == 3000
