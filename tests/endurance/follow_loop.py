#!/usr/bin/env python3
"""Follows a drawn walk that goes round and round for two million frames, and checks that nothing grows or drifts.

    RETRACE=build/release/bin/retrace python3 tests/endurance/follow_loop.py [--frames 2000000] [--lag-s 3]

A camera of 96x48 looks at a wall as it walks along it, at another speed than when the route was recorded; at the route's end
the walk begins anew (the walker is carried back). Each picture is handed over when the line of the one before has come, so
that the time in between is that line's latency. Printed for each twentieth of the frames: resident memory, CPU time a frame,
latency (median, 99th percentile), share of lines on the route, and error along it. Fails, with exit 1, if after the first
tenth memory differs by more than 5 %, or if CPU time a frame, share on the route or error are worse at the end than at first.
"""

import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.live_follow import grey_y4m  # noqa: E402
from support.retrace_cli import RETRACE, check, draw_walk, street, write_truth  # noqa: E402

GROUPS = 20
LEAST_FRAMES = GROUPS * 2000  # so that each group has several rounds
METRES_PER_PIXEL = 0.01


class Group:
    """A twentieth of the run."""

    def __init__(self):
        self.latency_s, self.errors_m, self.on_route, self.lines = [], [], 0, 0
        self.memory_mb = self.cpu_s = 0

    def add(self, line, at_m, latency_s):
        self.lines += 1
        self.latency_s.append(latency_s)
        if line["state"] == "on_route":
            self.on_route += 1
            self.errors_m.append(abs(line["distance_m"] - at_m))

    def row(self, number):
        late = sorted(self.latency_s)
        return (f"| {number} | {self.memory_mb:.1f} | {1000 * self.cpu_s / self.lines:.3f} | {1000 * statistics.median(late):.3f} | "
                f"{1000 * late[int(0.99 * len(late))]:.3f} | {self.share():.4f} | {self.median_m():.3f} | {self.within():.4f} |")

    def share(self):
        return self.on_route / self.lines

    def median_m(self):
        return statistics.median(self.errors_m) if self.errors_m else float("nan")

    def within(self):
        """Share of the lines on the route that are within half a picture's width."""
        return sum(error <= 0.48 for error in self.errors_m) / max(1, len(self.errors_m))


def memory_mb(pid):
    for line in pathlib.Path(f"/proc/{pid}/status").read_text().splitlines():
        if line.startswith("VmRSS:"):
            return int(line.split()[1]) / 1024
    raise RuntimeError("no VmRSS")


def cpu_s(pid):
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def follow(folder, frames, lag_s):
    """The groups of a run of so many frames."""
    wall, reference_at, walk_at = street(), [1.25 * i for i in range(800)], [i for i in range(1000)]
    truth = write_truth(folder / "truth.csv", reference_at, METRES_PER_PIXEL)
    check("build", draw_walk(folder / "reference", wall, reference_at), "-o", folder / "route.db", "--truth", truth)
    header, pictures = grey_y4m(draw_walk(folder / "walk", wall, walk_at, gain=0.7))
    process = subprocess.Popen([RETRACE, "follow", "-", "--route", folder / "route.db", "--lag-s", str(lag_s), "--threads", "1"],
                               stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    process.stdin.write(header)
    groups, before_s = [], 0.0
    print("| twentieth | memory, MB | CPU, ms a frame | latency, median ms | 99 % | on the route | error, median m | within 0.48 m |")
    print("|---" * 8 + "|", flush=True)
    for g in range(GROUPS):
        group = Group()
        for i in range(g * frames // GROUPS, (g + 1) * frames // GROUPS):
            k = i % len(pictures)
            began = time.perf_counter()
            process.stdin.write(pictures[k])
            process.stdin.flush()
            text = process.stdout.readline()
            group.add(json.loads(text), METRES_PER_PIXEL * walk_at[k], time.perf_counter() - began)
        group.memory_mb, now_s = memory_mb(process.pid), cpu_s(process.pid)
        group.cpu_s, before_s = now_s - before_s, now_s
        groups.append(group)
        print(group.row(g + 1), flush=True)
    process.stdin.close()
    if process.wait() != 0:
        sys.exit("follow_loop: the run failed")
    return groups


def troubles(groups):
    """What grew or drifted: the first tenth is where everything settles."""
    settled = groups[GROUPS // 10 - 1:]
    early, late = groups[1:5], groups[-4:]
    mean = lambda values: statistics.mean(values)
    memory = [group.memory_mb for group in settled]
    if max(memory) > 1.05 * min(memory):
        yield f"memory went from {min(memory):.1f} to {max(memory):.1f} MB"
    # Half as much again: what else the machine does shows in it.
    time_early, time_late = (mean(group.cpu_s / group.lines for group in some) for some in (early, late))
    if time_late > 1.5 * time_early:
        yield f"a frame takes {1000 * time_late:.3f} ms of CPU, after {1000 * time_early:.3f} ms"
    if mean(g.share() for g in late) < mean(g.share() for g in early) - 0.02:
        yield "less of the walk is on the route than at first"
    if mean(g.within() for g in late) < mean(g.within() for g in early) - 0.02:
        yield "places are less right than at first"
    if mean(g.share() for g in late) < 0.5:
        yield "most of the walk is not found"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--frames", type=int, default=2_000_000)
    parser.add_argument("--lag-s", type=float, default=3)
    options = parser.parse_args()
    if options.frames < LEAST_FRAMES:
        parser.error(f"--frames {options.frames}: at least {LEAST_FRAMES} expected")
    with tempfile.TemporaryDirectory(prefix="retrace-follow-loop-") as name:
        found = list(troubles(follow(pathlib.Path(name), options.frames, options.lag_s)))
    for trouble in found:
        print(f"follow_loop: {trouble}", file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
