#!/usr/bin/env python3
"""How evenly `retrace build` spaces the keyframes of drawn walks, with slow stretches and pauses: true metres from each to the next.

    RETRACE_DATA=... python3 tests/data/route_gaps.py [--seeds 41,43,45,541,543,545,547,641,643,645] [--width 320]

Streets of 60 m, each with another change of speed, and the shared drawn walks. A slow walk that is taken for a pause leaves a hole.
"""

import argparse
import contextlib
import os
import pathlib
import sqlite3
import statistics
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.retrace_cli import SOURCE, check, rows  # noqa: E402

DATA = pathlib.Path(os.environ.get("RETRACE_DATA", SOURCE.parent / "shared" / "data"))
SPEEDS = ("slow-fast", "fast-slow", "varied", "steady", "stops")


def spacing(name, walk, truth, route):
    route.unlink(missing_ok=True)
    check("build", walk, "-o", route)
    along = [float(row["distance_m"]) for row in rows(truth)]
    with contextlib.closing(sqlite3.connect(route)) as database:
        frames = [frame for frame, in database.execute("SELECT frame FROM keyframe ORDER BY position")]
    gaps = [along[b] - along[a] for a, b in zip(frames, frames[1:])]
    print(f"| {name} | {len(frames)} | {statistics.mean(gaps):.2f} | {statistics.pstdev(gaps) / statistics.mean(gaps):.2f} | "
          f"{max(gaps):.1f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", default="41,43,45,541,543,545,547,641,643,645")
    parser.add_argument("--width", type=int, default=320, help="pixels, of the pictures drawn")
    options = parser.parse_args()
    print("| walk | keyframes | metres apart | deviation / mean | largest |\n" + "|---" * 5 + "|")
    with tempfile.TemporaryDirectory(prefix="retrace-gaps-") as name:
        folder = pathlib.Path(name)
        for seed in map(int, options.seeds.split(",")):
            # As `follow_walks.py`, whose first seeds end in 1.
            order = seed % 100 % 10 - 1
            check("simulate", "-o", folder / str(seed), "--scene", "street", "--seed", seed, "--length-m", 60, "--speed",
                  SPEEDS[order % 5], "--gait-seed", seed + 59, "--width", options.width, "--height", options.width * 9 // 16)
            spacing(f"street {seed}, {SPEEDS[order % 5]}", folder / str(seed) / "walk.mp4", folder / str(seed) / "truth.csv",
                    folder / "route.db")
        for walk in ("street_day", "street_night", "corridor_a", "corridor_b", "run", "stand_walk"):
            if DATA.is_dir():
                spacing(walk, DATA / "sim" / f"{walk}.mp4", DATA / "sim" / f"{walk}.csv", folder / "route.db")


if __name__ == "__main__":
    sys.exit(main())
