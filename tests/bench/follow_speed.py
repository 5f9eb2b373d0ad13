#!/usr/bin/env python3
"""How long `retrace follow` takes for a frame on a long route, how late its lines come, and what memory it takes.

    RETRACE=build/release/bin/retrace /usr/bin/python3 tests/bench/follow_speed.py [--route-km 10] [--minutes 60] [--cores 2]

A drawn street of 60 m, by day, is the only true part of a route of 10 km, in its middle; the rest are its descriptors turned
into others. A walk on it of 640x360 at 25 frames/s by night, forwards and backwards in turn, comes as Y4M: each picture when the
line of the one before has come, so that the time in between is that line's latency, without waiting for the camera's. Printed:
keyframes of the route, CPU time a frame, latency in the median and at 99 %, and memory at the tenths of the run. Needs numpy
and ffmpeg.
"""

import argparse
import csv
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.live_follow import video_y4m  # noqa: E402
from support.retrace_cli import RETRACE, check, rows  # noqa: E402
from endurance.follow_loop import cpu_s, memory_mb  # noqa: E402

RATE_HZ = 25


def lengthened(folder, out, km):
    """The exported route in `folder`, many times as long, built into `out`; returns its keyframes."""
    table = folder / "traverse-1" / "keyframes.csv"
    keyframes = rows(table)
    last = keyframes[-1]
    shift = {name: float(last[name]) + step for name, step in (("time_s", 1), ("displacement", 0.6), ("distance_m", 0.6), ("y_m", 0.6))}
    frames = int(last["frame"]) + 10
    copies = int(1000 * km / shift["distance_m"]) + 1
    with open(table, "w", newline="") as file:
        writer = csv.DictWriter(file, list(keyframes[0]))
        writer.writeheader()
        for copy in range(copies):
            for row in keyframes:
                writer.writerow({**row, "frame": int(row["frame"]) + copy * frames, "preview": "",
                                 **{name: float(row[name]) + copy * by for name, by in shift.items()}})
    for path in (folder / "traverse-1").glob("*.npy"):
        rows_of = numpy.load(path)
        numpy.save(path, numpy.concatenate([numpy.roll(rows_of, 7 * (copy - copies // 2), axis=1) for copy in range(copies)]))
    traverses = rows(folder / "traverses.csv")
    traverses[0]["frames"] = copies * frames
    traverses[0]["duration_s"] = copies * shift["time_s"]
    with open(folder / "traverses.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, list(traverses[0]))
        writer.writeheader()
        writer.writerows(traverses)
    check("build", "--import", folder, "-o", out)
    return copies * len(keyframes), copies * shift["distance_m"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--route-km", type=float, default=10)
    parser.add_argument("--minutes", type=float, default=60, help="of walk")
    parser.add_argument("--cores", type=int, default=2)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="retrace-follow-speed-") as name:
        folder = pathlib.Path(name)
        for walk, light in (("day", "day"), ("night", "night")):
            check("simulate", "--scene", "street", "--length-m", 60, "--condition", light, "-o", folder / walk)
        check("build", folder / "day/walk.mp4", "-o", folder / "short.db", "--truth", folder / "day/truth.csv")
        check("inspect", folder / "short.db", "--export", folder / "exported")
        keyframes, metres = lengthened(folder / "exported", folder / "long.db", options.route_km)
        header, pictures = video_y4m(folder / "night/walk.mp4")
        pictures += pictures[::-1]
        process = subprocess.Popen(["taskset", "-c", ",".join(map(str, range(options.cores))), RETRACE, "follow", "-", "--route",
                                    folder / "long.db", "--threads", str(options.cores)], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        process.stdin.write(header)
        count = int(60 * options.minutes * RATE_HZ)
        latency_s, memory, started_s, on_route = [], [], 0, 0
        for i in range(count):
            began = time.perf_counter()
            process.stdin.write(pictures[i % len(pictures)])
            process.stdin.flush()
            line = process.stdout.readline()
            if i:
                latency_s.append(time.perf_counter() - began)
            else:  # the route was read before it
                started_s = cpu_s(process.pid)
            on_route += b'"on_route"' in line
            if (i + 1) % max(1, count // 10) == 0:
                memory.append(memory_mb(process.pid))
        used_s = cpu_s(process.pid) - started_s
        process.stdin.close()
        code = process.wait()
    latency_s.sort()
    print(f"route {metres:.0f} m, {keyframes} keyframes; {count} frames of 640x360 on {options.cores} cores, {100 * on_route / count:.0f} % on the route")
    print(f"CPU {1000 * used_s / (count - 1):.2f} ms a frame; latency median {1000 * latency_s[len(latency_s) // 2]:.2f} ms, "
          f"99 % {1000 * latency_s[int(0.99 * len(latency_s))]:.2f} ms, most {1000 * latency_s[-1]:.1f} ms")
    print("memory at the tenths: " + ", ".join(f"{m:.1f}" for m in memory) + " MB")
    return code


if __name__ == "__main__":
    sys.exit(main())
