"""The example scripts, run as a user runs them, on data that the tests make."""

import pathlib
import re
import subprocess
import sys

import numpy as np
import pytest
from drawn_walls import views, wall, write_walk

import retrace

EXAMPLES = pathlib.Path(__file__).resolve().parents[1] / "examples"


def run(name, *arguments):
    found = subprocess.run([sys.executable, EXAMPLES / name, *map(str, arguments)], capture_output=True, text=True, timeout=300,
                           env={"PYTHONPATH": str(pathlib.Path(retrace.__file__).parents[1]), "PATH": "/usr/bin:/bin"})
    assert found.returncode == 0, found.stderr
    return found.stdout


def test_own_descriptors(tmp_path):
    rng = np.random.default_rng(4)
    places = rng.normal(size=(150, 64)).astype(np.float32)
    truth = np.arange(20, 120)
    query = places[truth] + 2.5 * rng.normal(size=(100, 64)).astype(np.float32)
    for name, array in (("query", query), ("reference", places), ("truth", truth.astype(float))):
        np.save(tmp_path / f"{name}.npy", array)
    out = run("own_descriptors.py", tmp_path / "query.npy", tmp_path / "reference.npy", tmp_path / "truth.npy")
    single, sequences, path = (float(value) for value in re.findall(r"max-F1 ([\d.]+)", out))
    assert single < 0.9 < sequences and path > 0.95
    # Without truth there are counts alone.
    assert "max-F1" not in run("own_descriptors.py", tmp_path / "query.npy", tmp_path / "reference.npy")


def test_a_drawn_sweep(tmp_path):
    image = pytest.importorskip("matplotlib.image")
    texture = wall(seed=5)
    day = write_walk(tmp_path, "day", texture, np.arange(0, 600, 1.0), metres_per_px=0.1)
    night = write_walk(tmp_path, "night", texture, np.arange(60, 540, 2.0), metres_per_px=0.1)
    out = run("sweep_ranges.py", night[0], day[0], night[1], day[1], tmp_path / "heat_map.png")
    best = float(re.search(r"best ([\d.]+)", out)[1])
    assert 0.9 < best <= 1
    picture = image.imread(tmp_path / "heat_map.png")
    assert picture.shape[0] > 300 and len(np.unique(picture.reshape(-1, picture.shape[2]), axis=0)) > 10  # something is drawn


def test_a_live_loop(tmp_path):
    cv2 = pytest.importorskip("cv2")
    texture = wall(seed=6)
    day, truth = write_walk(tmp_path, "day", texture, np.arange(0, 900, 1.0))
    retrace.build(day, truth=truth).save(str(tmp_path / "route.db"))
    positions = np.arange(60, 840, 2.0)
    video = cv2.VideoWriter(str(tmp_path / "night.avi"), cv2.VideoWriter_fourcc(*"MJPG"), 30, (96, 48))
    for picture in views(texture, positions):
        video.write(cv2.cvtColor(picture, cv2.COLOR_GRAY2BGR))
    video.release()
    lines = run("live.py", tmp_path / "route.db", tmp_path / "night.avi").splitlines()
    on_route = [re.fullmatch(r" *([\d.]+) s  on_route ([\d.]+) m, [\d.]+", line) for line in lines]
    on_route = [(float(line[1]), float(line[2])) for line in on_route if line]
    assert len(on_route) >= 4 and len(lines) < len(positions)  # a line where the place changes alone
    for time_s, distance_m in on_route:
        assert abs(distance_m - positions[round(time_s * 30)] / 100) < 0.5
