#!/usr/bin/python3
"""Many long routes in one database: is the walk found, how long does it take, and how much memory?

    RETRACE=build/release/bin/retrace /usr/bin/python3 tests/endurance/long_routes.py [--routes 50] [--km 100] [--memory 4G]

A drawn street of 60 m, by day, is the middle of the middle route. Everything else is as unlike as the real places are: each
keyframe has the columns of a random real one in a random order, with noise. The street is walked again by night and localised
with the memory given, and followed on a database of one such route alone. Fails, with exit 1, if fewer than 95 % of the matches
accepted are within 1 m, if fewer than half of the walk's keyframes are accepted, or if `localise` takes more memory than it was
given. Needs numpy, and 1.2 kB of disk for each keyframe, twice.
"""

import argparse
import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.retrace_cli import RETRACE, check, rows  # noqa: E402

BLOCK = 4096  # keyframes drawn at a time
WALKED = ("time_s", "displacement", "distance_m")


def unlike(real, count, noise, rng):
    """Descriptors of `count` places that nobody has seen."""
    made = real[rng.integers(len(real), size=count)].astype(np.int16)
    made = made[:, rng.permutation(made.shape[1])] + np.roll(noise, rng.integers(len(noise)), axis=0)[:count]
    return np.clip(made, -127, 127).astype(real.dtype)


def mean_steps(street):
    """From keyframe to keyframe: frames, and what is WALKED."""
    between = len(street) - 1
    return [int(street[-1]["frame"]) // between + 1] + [float(street[-1][name]) / between for name in WALKED]


def write_keyframes(path, street, count, first):
    """Evenly spaced ones, and those of the street from the keyframe `first` on."""
    frame_step, *steps = mean_steps(street)
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, list(street[0]), restval="", lineterminator="\n")
        writer.writeheader()
        for i in range(count):
            real_one = street[i - first] if 0 <= i - first < len(street) else None
            frame, walked = i * frame_step, [i * step for step in steps]
            if real_one:
                frame = first * frame_step + int(real_one["frame"])
                walked = [first * step + float(real_one[name]) for step, name in zip(steps, WALKED)]
            time_s, displacement, distance_m = (f"{value:.6f}" for value in walked)
            writer.writerow({"frame": frame, "time_s": time_s, "displacement": displacement, "distance_m": distance_m,
                             "x_m": 0, "y_m": distance_m, "heading_rad": 0, "after_gap": 0})


def write_descriptors(path, real, count, first, seed):
    rng = np.random.default_rng(seed)
    noise = rng.integers(-20, 21, size=(BLOCK, *real.shape[1:]), dtype=np.int16)
    made = np.lib.format.open_memmap(path, mode="w+", dtype=real.dtype, shape=(count, *real.shape[1:]))
    for begin in range(0, count, BLOCK):
        made[begin:begin + BLOCK] = unlike(real, min(BLOCK, count - begin), noise, rng)
    if first < count:
        made[first:first + len(real)] = real


def write_routes(short, folder, routes, km):
    """An exported route of so many traverses; returns the name of the one with the street, where it begins, and keyframes."""
    keyframes = rows(short / "traverse-1/keyframes.csv")
    frame_step, step_s, _, step_m = mean_steps(keyframes)
    count = int(1000 * km / step_m)
    folder.mkdir()
    for path in short.iterdir():
        if path.is_file() and path.name != "traverses.csv":
            (folder / path.name).write_bytes(path.read_bytes())
    settings = rows(folder / "settings.csv")
    one = [row for row in settings if row["traverse"] == "1"]
    rest = [row for row in settings if row["traverse"] != "1"]
    with open(folder / "settings.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, list(settings[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rest + [{**row, "traverse": t} for t in range(1, routes + 1) for row in one])
    traverse = rows(short / "traverses.csv")[0]
    middle, first = (routes + 1) // 2, (count - len(keyframes)) // 2
    real = np.load(short / "traverse-1/descriptors-1.npy")
    with open(folder / "traverses.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, list(traverse), lineterminator="\n")
        writer.writeheader()
        for t in range(1, routes + 1):
            writer.writerow({**traverse, **{name: 0 for name in traverse if name.startswith("thumbnail")}, "traverse": t, "name": f"route {t}",
                             "frames": frame_step * count, "duration_s": step_s * count})
            into = folder / f"traverse-{t}"
            into.mkdir()
            if t == middle or t == 1:
                write_keyframes(into / "keyframes.csv", keyframes, count, first if t == middle else count)
            else:
                (into / "keyframes.csv").write_bytes((folder / "traverse-1/keyframes.csv").read_bytes())
            write_descriptors(into / "descriptors-1.npy", real, count, first if t == middle else count, t)
    return f"route {middle}", first * step_m, routes * count


def measured(*arguments):
    """Seconds and resident memory in MB of a run that must succeed."""
    began = time.perf_counter()
    done = subprocess.run(["/usr/bin/time", "-f", "%M", RETRACE, *map(str, arguments)], capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"retrace {' '.join(map(str, arguments))}\nexit {done.returncode}\n{done.stderr}")
    return time.perf_counter() - began, int(done.stderr.split()[-1]) / 1024, done.stdout


def megabytes(text):
    return float(text[:-1]) * {"M": 1, "G": 1024}[text[-1]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--routes", type=int, default=50)
    parser.add_argument("--km", type=float, default=100)
    parser.add_argument("--memory", default="4G", help="of `localise`, such as 4G or 500M")
    options = parser.parse_args()
    troubles = []
    with tempfile.TemporaryDirectory(prefix="retrace-long-routes-") as name:
        folder = pathlib.Path(name)
        for walk in ("day", "night"):
            check("simulate", "--scene", "street", "--length-m", 60, "--condition", walk, "-o", folder / walk)
        check("build", folder / "day/walk.mp4", "-o", folder / "short.db", "--truth", folder / "day/truth.csv")
        check("inspect", folder / "short.db", "--export", folder / "short")

        route, begins_m, keyframes = write_routes(folder / "short", folder / "long", options.routes, options.km)
        seconds, memory, _ = measured("build", "--import", folder / "long", "-o", folder / "long.db")
        size_gb = (folder / "long.db").stat().st_size / 1e9
        print(f"{options.routes} routes of {options.km:g} km: {keyframes} keyframes, {size_gb:.1f} GB; import {seconds:.0f} s, {memory:.0f} MB", flush=True)
        subprocess.run(["rm", "-r", folder / "long"], check=True)

        seconds, memory, _ = measured("localise", folder / "night/walk.mp4", "--route", folder / "long.db", "-o", folder / "run",
                                      "--memory", options.memory, "--fuse-traverses", "false")
        truth = {int(row["frame"]): float(row["distance_m"]) for row in rows(folder / "night/truth.csv")}
        matches = rows(folder / "run/matches.csv")
        accepted = [row for row in matches if row["accepted"] == "1"]
        right = sum(row["traverse"] == route and
                    abs(float(row["reference_distance_m"]) - begins_m - truth[int(row["query_frame"])]) <= 1 for row in accepted)
        print(f"localise --memory {options.memory}: {seconds:.0f} s, {memory:.0f} MB; {len(matches)} keyframes, {len(accepted)} accepted, "
              f"{right} of them within 1 m", flush=True)
        if memory > megabytes(options.memory):
            troubles.append(f"localise took {memory:.0f} MB of {options.memory}")
        if right < 0.95 * len(accepted) or 2 * len(accepted) < len(matches):
            troubles.append("the walk is not found")
        (folder / "long.db").unlink()

        _, begins_m, keyframes = write_routes(folder / "short", folder / "one", 1, options.km)
        check("build", "--import", folder / "one", "-o", folder / "one.db")
        seconds, memory, output = measured("follow", folder / "night/walk.mp4", "--route", folder / "one.db")
        lines = [json.loads(line) for line in output.splitlines()]
        found = [line for line in lines if line["state"] == "on_route"]
        right = sum(abs(line["distance_m"] - begins_m - truth[line["frame"]]) <= 4 for line in found)
        print(f"follow on one of them, {keyframes} keyframes: {len(lines)} frames in {seconds:.0f} s, {memory:.0f} MB; "
              f"{len(found)} lines on the route, {right} of them within 4 m")
        if right < 0.95 * len(found) or 2 * len(found) < len(lines):
            troubles.append("the walk is not followed")
    for trouble in troubles:
        print(f"long_routes: {trouble}", file=sys.stderr)
    return 1 if troubles else 0


if __name__ == "__main__":
    sys.exit(main())
