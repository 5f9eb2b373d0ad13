#!/usr/bin/env python3
"""What `retrace localise` accepts where a walk is not on the route: a table over the detours that follow_walks.py draws.

    RETRACE=build/release/bin/retrace python3 tests/data/off_route.py [--routes 10] [--length-m 60] [--first-seed 41] [--width 640]

A walk begins a third of the way along a drawn route, leaves at two thirds for 30 m of another street or corridor, and comes
back where it left. Printed: query keyframes on the route, the share of them that is accepted and within 2 m, those accepted
that are not; keyframes off the route, and those accepted there. Needs ffmpeg.
"""

import argparse
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from data.follow_walks import walks  # noqa: E402
from support.retrace_cli import check, rows  # noqa: E402


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--routes", type=int, default=10)
    parser.add_argument("--length-m", type=float, default=60)
    parser.add_argument("--first-seed", type=int, default=41, help="of the routes drawn")
    parser.add_argument("--width", type=int, default=640, help="pixels, of the pictures drawn")
    options = parser.parse_args()
    options.drawn_only = True
    print("| walk | keyframes on the route | accepted, within 2 m | accepted, elsewhere | keyframes off it | accepted |\n" + "|---" * 6 + "|")
    total = [0] * 5
    with tempfile.TemporaryDirectory(prefix="retrace-off-route-") as name:
        folder = pathlib.Path(name)
        for title, reference, survey, walk, truth, _ in walks(options, folder):
            if "detour" not in title:
                continue
            route, run = folder / "route.db", folder / "run"
            check("build", reference, "-o", route, "--truth", survey, "--force")
            check("localise", walk, "--route", route, "-o", run, "--force")
            route.unlink()
            counts = [0] * 5  # on the route, right, wrong; off it, accepted
            for match in rows(run / "matches.csv"):
                at, accepted = truth[int(match["query_frame"])], match["accepted"] == "1"
                if at is None:
                    counts[3] += 1
                    counts[4] += accepted
                    continue
                right = accepted and abs(float(match["reference_distance_m"]) - at) <= 2
                counts[0] += 1
                counts[1] += right
                counts[2] += accepted and not right
            total = [a + b for a, b in zip(total, counts)]
            print(row(title, counts), flush=True)
    print(row("all", total))


def row(name, counts):
    on, right, wrong, off, accepted = counts
    return f"| {name} | {on} | {right / on:.3f} | {wrong} | {off} | {accepted} |"


if __name__ == "__main__":
    sys.exit(main())
