#!/usr/bin/python3
"""A walk of many hours through `build`, and another along the same way through `localise`.

    RETRACE=build/release/bin/retrace /usr/bin/python3 tests/endurance/long_walk.py [--hours 10] [--memory 14G]

A camera of 96x48 at 25 frames/s looks at a wall as it walks along it, by day; the second walk is darker and 1.25 times as fast.
Printed: time and resident memory of both commands, that for an hour of walk (with what any walk takes), and matches that are right to
half a picture's width. Fails, with exit 1, if fewer than 95 % of the accepted matches are right, or fewer than half of the keyframes are
accepted. Needs numpy, ffmpeg, and some hundred MB of disk for ten hours.
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from endurance.long_routes import measured  # noqa: E402
from support.retrace_cli import rows  # noqa: E402

RATE_HZ, WIDTH, HEIGHT = 25, 96, 48
SPEED_PX, FASTER, DARKER = 1, 1.25, 0.7  # a frame of the first walk; the second's ratios
FADE_FRAMES = 50  # over which a walker comes to speed, so that walks are not even


def wall(length, seed=1):
    """Random blocks of several sizes: every place looks like itself only."""
    rng = np.random.default_rng(seed)
    grey = np.full((HEIGHT, length), 128, np.int16)
    for size in (48, 24, 12, 6):
        blocks = rng.integers(-45, 46, size=(HEIGHT // size, length // size + 1), dtype=np.int16)
        grey += np.repeat(np.repeat(blocks, size, axis=0), size, axis=1)[:, :length]
    return np.clip(grey, 0, 255).astype(np.uint8)


def places(frames, speed_px):
    """Left edge of every frame, in pixels of the wall: the walker slows down and speeds up by a third, again and again."""
    speed = speed_px * (1 + np.sin(np.arange(frames) / FADE_FRAMES) / 3)
    return np.concatenate([[0], np.cumsum(speed)[:-1]])


def draw(path, seen, at, gain):
    encoder = subprocess.Popen(["ffmpeg", "-v", "error", "-y", "-f", "rawvideo", "-pix_fmt", "gray", "-s", f"{WIDTH}x{HEIGHT}", "-r", str(RATE_HZ),
                                "-i", "-", "-pix_fmt", "yuv420p", "-preset", "ultrafast", "-crf", "18", str(path)], stdin=subprocess.PIPE)
    for x in np.round(at).astype(int):
        encoder.stdin.write((seen[:, x:x + WIDTH] * gain).astype(np.uint8).tobytes())
    encoder.stdin.close()
    if encoder.wait() != 0:
        sys.exit("long_walk: ffmpeg failed")
    return path


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--hours", type=float, default=10)
    parser.add_argument("--memory", help="of `localise`, such as 14G")
    options = parser.parse_args()
    frames = int(3600 * RATE_HZ * options.hours)
    first_at = places(frames, SPEED_PX)
    second_at = places(int(frames / FASTER), SPEED_PX * FASTER)
    second_at = second_at[second_at <= first_at[-1]]
    seen = wall(int(first_at[-1]) + WIDTH + 1)
    with tempfile.TemporaryDirectory(prefix="retrace-long-walk-") as name:
        folder = pathlib.Path(name)
        first = draw(folder / "first.mp4", seen, first_at, 1)
        second = draw(folder / "second.mp4", seen, second_at, DARKER)
        print("| command | frames | keyframes | time, s | memory, MB | MB for an hour of walk |\n" + "|---" * 6 + "|", flush=True)

        def row(command, count, keyframes, seconds, memory):
            hours = count / RATE_HZ / 3600
            print(f"| {command} | {count} | {keyframes} | {seconds:.0f} | {memory:.0f} | {memory / hours:.0f} |", flush=True)

        seconds, memory, said = measured("build", first, "-o", folder / "route.db")
        row("build", frames, said.split(" keyframes")[0].split()[-1], seconds, memory)
        seconds, memory, _ = measured("localise", second, "--route", folder / "route.db", "-o", folder / "run",
                                      *(("--memory", options.memory) if options.memory else ()))
        matches = rows(folder / "run/matches.csv")
        row("localise", len(second_at), len(matches), seconds, memory)
    accepted = [match for match in matches if match["accepted"] == "1"]
    right = sum(abs(first_at[int(match["reference_frame"])] - second_at[int(match["query_frame"])]) <= WIDTH / 2 for match in accepted)
    print(f"{len(matches)} query keyframes, {len(accepted)} accepted, {right} of them right")
    if right < 0.95 * len(accepted) or 2 * len(accepted) < len(matches):
        print("long_walk: the walk is not found", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
