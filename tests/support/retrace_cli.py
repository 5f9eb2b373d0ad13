"""What tests that call the program share: running it, drawing small walks, reading its files."""

import csv
import json
import os
import pathlib
import random
import subprocess

RETRACE = os.environ.get("RETRACE", "build/release/bin/retrace")
SOURCE = pathlib.Path(os.environ.get("RETRACE_SOURCE_DIR", pathlib.Path(__file__).resolve().parents[2]))

# The columns of matches.csv, and the two after them, of the nearest place with a name.
MATCH_COLUMNS = ["query_frame", "query_time_s", "traverse", "reference_frame", "reference_time_s",
                 "reference_distance_m", "score", "accepted", "probability", "sd_keyframes", "sd_m", "yaw_deg", "lateral_m",
                 "ahead_m"]
NEAREST_COLUMNS = ["nearest_place", "nearest_place_m"]


def run(*arguments, **options):
    """The finished process of `retrace ARGUMENTS`, output as text."""
    return subprocess.run([RETRACE, *map(str, arguments)], capture_output=True, text=True, timeout=600, **options)


def check(*arguments, **options):
    """The standard output of a run that must succeed."""
    done = run(*arguments, **options)
    if done.returncode != 0:
        raise AssertionError(f"retrace {' '.join(map(str, arguments))}\nexit {done.returncode}\n{done.stderr}")
    return done.stdout


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def read_json(path):
    return json.loads(pathlib.Path(path).read_text())


def street(seed=1, length=1200, height=48):
    """A long wall of random blocks of several sizes, row-major bytes: every place looks like itself only."""
    rng = random.Random(seed)
    wall = [bytearray([128]) * length for _ in range(height)]
    for size in (48, 24, 12, 6):
        for y in range(0, height, size):
            for x in range(0, length, size):
                change = rng.randint(-45, 45)
                for row in wall[y:y + size]:
                    for k in range(x, min(x + size, length)):
                        row[k] = max(0, min(255, row[k] + change))
    return wall


def draw_walk(folder, wall, positions, width=96, gain=1.0):
    """A folder of PGM images: the wall seen through a window at each of the positions (pixels, may be fractional)."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True)
    brighter = bytes(min(255, int(gain * grey)) for grey in range(256))
    for i, position in enumerate(positions):
        left, part = int(position), position - int(position)
        pixels = bytearray()
        for row in wall:
            if part == 0:
                pixels += row[left:left + width].translate(brighter)
            else:
                pixels += bytes(min(255, int(gain * ((1 - part) * row[left + x] + part * row[left + x + 1]))) for x in range(width))
        (folder / f"{i}.pgm").write_bytes(b"P5 %d %d 255\n" % (width, len(wall)) + pixels)
    return folder


def write_truth(path, positions, metres_per_pixel=0.01, rate_hz=30):
    """truth.csv of such a walk, straight to the north."""
    lines = ["frame,time_s,x_m,y_m,heading_deg,distance_m,steps"]
    for i, position in enumerate(positions):
        metres = position * metres_per_pixel
        lines.append(f"{i},{i / rate_hz:.6f},0,{metres:.6f},0,{metres:.6f},0")
    pathlib.Path(path).write_text("\n".join(lines) + "\n")
    return path


def video(folder, path, *options, rate=30):
    """Encodes the images of a folder; further options go to ffmpeg before the output."""
    subprocess.run(["ffmpeg", "-v", "error", "-y", "-framerate", str(rate), "-i", str(folder / "%d.pgm"), "-c:v", "mpeg4",
                    "-q:v", "2", "-pix_fmt", "yuv420p", *options, str(path)], check=True)
    return path
