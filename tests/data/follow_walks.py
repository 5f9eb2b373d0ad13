#!/usr/bin/env python3
"""How well `retrace follow` follows: a table over the shared drawn pairs, and over routes drawn here.

    RETRACE_DATA=... python3 tests/data/follow_walks.py [--routes 10] [--length-m 60] [--first-seed 41] [--width 640] [--drawn-only]

A drawn route is a street or a corridor in turn, by day; the walk on it is by night or among passers-by, at another speed, up
to half a metre aside. Of every route: the whole walk, and, for two of four, a walk that begins a third of the way along, leaves
for 30 m of another street and comes back where it left, and one that is carried 20 m on at a third. Printed: metres walked until
found; of the frames said to be on the route after that, the share within 2 m and the median error; metres until leaving and
coming back are said; share of on-route metres that are called off the route; expected calibration error of the probability (to
be within 2 m, ten bins), and share of errors within 1.64 standard deviations. Last, the share of lines that are said to be on
the route while the walker is on another one, by the walks of the two routes of the same kind before it. Needs ffmpeg.
"""

import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.retrace_cli import SOURCE, check, rows  # noqa: E402

DATA = pathlib.Path(os.environ.get("RETRACE_DATA", SOURCE.parent / "shared" / "data"))
SPEEDS = ("slow-fast", "fast-slow", "varied", "steady", "stops")
RATE_HZ = 25


def draw(folder, **options):
    flags = [part for name, value in options.items() for part in (f"--{name.replace('_', '-')}", value)]
    check("simulate", "-o", folder, *flags)
    return folder


def join(folder, name, parts):
    """A video of parts (walk, from_m, to_m, on the route), and where on the route each frame is, None where it is not."""
    files, where = [], []
    for i, (walk, begin_m, end_m, on_route) in enumerate(parts):
        along = [float(row["distance_m"]) for row in rows(walk / "truth.csv")]
        frames = [k for k, at in enumerate(along) if begin_m <= at <= end_m]
        file = folder / f"{name}{i}.mp4"
        subprocess.run(["ffmpeg", "-v", "error", "-y", "-i", walk / "walk.mp4", "-vf",
                        f"trim=start_frame={frames[0]}:end_frame={frames[-1] + 1},setpts=PTS-STARTPTS", "-r", str(RATE_HZ),
                        "-crf", "16", file], check=True)
        files.append(file)
        where += [(along[k] if on_route else None, along[k]) for k in frames]
    (folder / f"{name}.txt").write_text("".join(f"file '{file}'\n" for file in files))
    subprocess.run(["ffmpeg", "-v", "error", "-y", "-f", "concat", "-safe", "0", "-i", folder / f"{name}.txt", "-c", "copy",
                    folder / f"{name}.mp4"], check=True)
    return folder / f"{name}.mp4", [at for at, _ in where], [along for _, along in where]


def walked_m(along):
    """Metres walked up to each frame, whatever was cut out."""
    total, all_of_them = 0, [0]
    for a, b in zip(along, along[1:]):
        total += b - a if 0 <= b - a < 1 else 0
        all_of_them.append(total)
    return all_of_them


def ratio(part, whole):
    return part / whole if whole else float("nan")


class Followed:
    """What came of one walk."""

    def __init__(self, walk, route, truth, along):
        lines = [json.loads(line) for line in check("follow", walk, "--route", route).splitlines()]
        metres = walked_m(along)
        self.told = []  # (probability, error in m, its standard deviation)
        self.found_m = self.left_m = self.back_m = None
        on_route_m = called_off_m = 0
        was_on, left_at, back_at, jumped_at = False, None, None, None
        for k, line in enumerate(lines):
            state, at = line["state"], truth[k]
            if k and truth[k - 1] is not None and at is None:
                left_at = metres[k]
            if k and truth[k - 1] is None and at is not None:
                back_at = metres[k]
            if k and at is not None and truth[k - 1] is not None and abs(at - truth[k - 1]) > 5:
                jumped_at = k
            if state == "on_route" and at is not None and self.found_m is None:
                self.found_m = metres[k]
            if left_at is not None and self.left_m is None and state != "on_route":
                self.left_m = metres[k] - left_at
            right = state == "on_route" and at is not None and abs(line["distance_m"] - at) <= 2
            if back_at is not None and self.back_m is None and right:
                self.back_m = metres[k] - back_at
            if jumped_at is not None and self.back_m is None and right:
                self.back_m = metres[k] - metres[jumped_at]
            returning = (back_at is not None or jumped_at is not None) and self.back_m is None
            if state == "on_route" and at is not None and not returning:
                self.told.append((line["probability"], abs(line["distance_m"] - at), line["sd_m"]))
            if self.found_m is not None and at is not None and not returning and k:
                on_route_m += metres[k] - metres[k - 1]
                called_off_m += metres[k] - metres[k - 1] if state == "off_route" else 0
        self.called_off = ratio(called_off_m, on_route_m)


def calibration_error(told):
    told, count = sorted(told), min(10, len(told))
    groups = [told[i * len(told) // count:(i + 1) * len(told) // count] for i in range(count)]
    return sum(abs(sum(p - (error <= 2) for p, error, _ in group)) for group in groups) / len(told) if told else float("nan")


def row(name, followed):
    told = followed.told
    metres = [f"{m:.1f}" if m is not None else "-" for m in (followed.found_m, followed.left_m, followed.back_m)]
    return (f"| {name} | {metres[0]} | {ratio(sum(e <= 2 for _, e, _ in told), len(told)):.3f} | "
            f"{statistics.median(e for _, e, _ in told) if told else float('nan'):.2f} | {metres[1]} | {metres[2]} | {followed.called_off:.3f} | "
            f"{calibration_error(told):.3f} | {ratio(sum(e <= 1.64 * sd for _, e, sd in told), len(told)):.3f} |")


def walks(options, folder):
    """(name, route's walk, its truth.csv, walk, where on the route each frame is, metres along)."""
    if DATA.is_dir() and not options.drawn_only:
        for name, a, b in (("street by night", "street_day", "street_night"), ("corridor with people", "corridor_a", "corridor_b")):
            truth = [float(r["distance_m"]) for r in rows(DATA / "sim" / f"{b}.csv")]
            yield name, DATA / "sim" / f"{a}.mp4", DATA / "sim" / f"{a}.csv", DATA / "sim" / f"{b}.mp4", truth, truth
    for i in range(options.routes):
        scene, seed, length = ("street", "corridor")[i % 2], options.first_seed + i, options.length_m
        size, gait = {"width": options.width, "height": options.width * 9 // 16}, options.first_seed + 59 + i
        here = folder / f"route{i}"
        here.mkdir()
        light = {"condition": "night"} if scene == "street" else {"people": 3}
        day = draw(here / "a", scene=scene, seed=seed, length_m=length, speed=SPEEDS[i % 5], gait_seed=gait, **size)
        walk = draw(here / "b", scene=scene, seed=seed, length_m=length, speed=SPEEDS[(i + 2) % 5], gait_seed=gait + 100,
                    lateral_m=(0.3, -0.2, 0, 0.5, -0.4)[i % 5], **light, **size)
        reference = (day / "walk.mp4", day / "truth.csv")
        truth = [float(r["distance_m"]) for r in rows(walk / "truth.csv")]
        yield (f"{scene} {seed}", *reference, walk / "walk.mp4", truth, truth)
        if i % 4 > 1:
            continue
        side = draw(here / "side", scene=scene, seed=seed + 1000, length_m=35, gait_seed=gait + 200, **light, **size)
        yield (f"{scene} {seed}, a detour", *reference,
               *join(here, "detour", [(walk, length / 3, length * 2 / 3, True), (side, 1, 31, False), (walk, length * 2 / 3, length, True)]))
        yield (f"{scene} {seed}, carried on", *reference,
               *join(here, "carried", [(walk, 0, length / 3, True), (walk, length / 3 + 20, length, True)]))


def elsewhere(walk, route):
    """The share of lines on the route, of a walk that is never on it."""
    lines = [json.loads(line) for line in check("follow", walk, "--route", route).splitlines()]
    return ratio(sum(line["state"] == "on_route" for line in lines), len(lines))


def on_routes(options, folder):
    """(name, route database, walk, where on the route each frame is, metres along); the route is there until the next is asked for."""
    route, of = folder / "route.db", None
    for title, reference, survey, walk, truth, along in walks(options, folder):
        if of != reference:
            route.unlink(missing_ok=True)
            check("build", reference, "-o", route, "--truth", survey)
            of = reference
        yield title, route, walk, truth, along


def parser_of(text):
    """Options of the walks."""
    parser = argparse.ArgumentParser(description=text, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--routes", type=int, default=10)
    parser.add_argument("--length-m", type=float, default=60)
    parser.add_argument("--first-seed", type=int, default=41, help="of the routes drawn")
    parser.add_argument("--width", type=int, default=640, help="pixels, of the pictures drawn")
    return parser


def main():
    parser = parser_of(__doc__)
    parser.add_argument("--drawn-only", action="store_true", help="without the shared pairs")
    options = parser.parse_args()
    everything, before, never_on_it = [], [], []
    print("| walk | found after m | within 2 m | median m | leaving said after m | back after m | called off the route | "
          "calibration error | within 1.64 sd |\n" + "|---" * 9 + "|")
    with tempfile.TemporaryDirectory(prefix="retrace-follow-") as name:
        for title, route, walk, truth, along in on_routes(options, pathlib.Path(name)):
            followed = Followed(walk, route, truth, along)
            everything.append(followed)
            print(row(title, followed), flush=True)
            if title.split()[-1].isdigit():  # the whole walk on a route drawn here
                alike = [one for one in before if one[0].split()[0] == title.split()[0]][-2:]
                never_on_it += [(f"{other} on {title}", elsewhere(its_walk, route)) for other, its_walk in alike]
                before.append((title, walk))
    told = [one for followed in everything for one in followed.told]
    print(f"all: within 2 m {ratio(sum(e <= 2 for _, e, _ in told), len(told)):.3f}, median {statistics.median(e for _, e, _ in told):.2f} m, "
          f"calibration error {calibration_error(told):.3f}, within 1.64 sd {ratio(sum(e <= 1.64 * sd for _, e, sd in told), len(told)):.3f}")
    if never_on_it:
        print(f"on another route: said to be on it {statistics.mean(share for _, share in never_on_it):.3f} of the time; "
              + ", ".join(f"{name} {share:.2f}" for name, share in never_on_it))


if __name__ == "__main__":
    sys.exit(main())
