#!/usr/bin/env python3
"""What `retrace localise` accepts where a walk is not on the route: a table over the detours that follow_walks.py draws.

    RETRACE=build/release/bin/retrace python3 tests/data/off_route.py [--routes 10] [--length-m 60] [--first-seed 41] [--width 640]

A walk begins a third of the way along a drawn route, leaves at two thirds for 30 m of another street or corridor, and comes
back where it left. Printed: query keyframes on the route, the share of them that is accepted and within 2 m, those accepted
that are not; keyframes off the route, and those accepted there. Needs ffmpeg.
"""

import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from data.follow_walks import on_routes, parser_of  # noqa: E402
from support.retrace_cli import check, rows  # noqa: E402


def counted(matches, truth):
    """Keyframes on the route, accepted ones of them that are right and that are wrong; keyframes off it, and accepted ones."""
    on = right = wrong = off = off_accepted = 0
    for match in matches:
        at, accepted = truth[int(match["query_frame"])], match["accepted"] == "1"
        if at is None:
            off += 1
            off_accepted += accepted
        else:
            near = accepted and abs(float(match["reference_distance_m"]) - at) <= 2
            on += 1
            right += near
            wrong += accepted and not near
    return on, right, wrong, off, off_accepted


def row(name, counts):
    on, right, wrong, off, accepted = counts
    return f"| {name} | {on} | {right / on:.3f} | {wrong} | {off} | {accepted} |"


def main():
    options = parser_of(__doc__).parse_args()
    options.drawn_only = True
    print("| walk | keyframes on the route | accepted, within 2 m | accepted, elsewhere | keyframes off it | accepted |\n" + "|---" * 6 + "|")
    everything = []
    with tempfile.TemporaryDirectory(prefix="retrace-off-route-") as name:
        run = pathlib.Path(name) / "run"
        for title, route, walk, truth, _ in on_routes(options, pathlib.Path(name)):
            if "detour" not in title:
                continue
            check("localise", walk, "--route", route, "-o", run, "--force")
            everything.append(counted(rows(run / "matches.csv"), truth))
            print(row(title, everything[-1]), flush=True)
    print(row("all", map(sum, zip(*everything))))


if __name__ == "__main__":
    sys.exit(main())
