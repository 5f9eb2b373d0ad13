#!/usr/bin/env python3
"""How many of the errors of corrected trajectories lie in their 90 % ellipses: over ten pairs of walks drawn here.

    python3 tests/data/drift_ellipse.py [--pairs 10] [--length-m 60]

Streets and corridors in turn, by day; the walk on them by night or among passers-by, at another speed, and up to half a metre to
either side, which no match on one line shows. Prints for each pair the root mean square error of the odometry alone and
corrected, and the share of poses within the ellipse; then the mean share. Only needs Python.
"""

import argparse
import pathlib
import statistics
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.retrace_cli import check, read_json  # noqa: E402

SPEEDS = ("slow-fast", "fast-slow", "varied", "steady", "stops")
LATERAL_M = (0.3, -0.2, 0, 0.5, -0.4, 0.15, -0.1, 0.25, -0.3, 0.4)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pairs", type=int, default=10)
    parser.add_argument("--length-m", type=float, default=60)
    options = parser.parse_args()
    inside = []
    print("| pair | odometry alone m | corrected m | within the 90 % ellipse |\n|---|---|---|---|")
    for i in range(options.pairs):
        scene = ("street", "corridor")[i % 2]
        light = ("--condition", "night") if scene == "street" else ("--people", 3)
        with tempfile.TemporaryDirectory(prefix="retrace-ellipse-") as name:
            folder = pathlib.Path(name)
            same = ("--scene", scene, "--length-m", options.length_m, "--seed", 41 + i)
            check("simulate", *same, "--speed", SPEEDS[i % 5], "--gait-seed", 100 + i, "-o", folder / "a")
            check("simulate", *same, *light, "--speed", SPEEDS[(i + 2) % 5], "--gait-seed", 200 + i, "--lateral-m",
                  LATERAL_M[i % 10], "-o", folder / "b")
            route, run = folder / "route.db", folder / "run"
            check("build", folder / "a" / "walk.mp4", "-o", route, "--truth", folder / "a" / "truth.csv")
            check("localise", folder / "b" / "walk.mp4", "--route", route, "-o", run)
            check("evaluate", run, "--query-truth", folder / "b" / "truth.csv", "--reference-truth", folder / "a" / "truth.csv",
                  "--tolerance-m", 4)
            metrics = read_json(run / "metrics.json")
        inside.append(metrics["ape_inside_90"])
        print(f"| {scene} {41 + i}, {LATERAL_M[i % 10]:g} m aside | {metrics['ape_odometry_rmse_m']:.2f} | {metrics['ape_rmse_m']:.2f} | "
              f"{100 * inside[-1]:.0f} % |", flush=True)
    print(f"mean: {100 * statistics.mean(inside):.1f} %")


if __name__ == "__main__":
    sys.exit(main())
