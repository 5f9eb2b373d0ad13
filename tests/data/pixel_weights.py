#!/usr/bin/env python3
"""Whether alignment error is a better measure of motion if pixels are weighted by how steadily their error grows.

    RETRACE_DATA=... /usr/bin/python3 tests/data/pixel_weights.py [WALK ...]

SSS (section 7) proposes it. For each walk with a truth: the error of the displacement in each second, root mean square over its
mean, after scaling to the true length; with every pixel alike, and with five weights. It repeats the stages of libvo in a few
lines of numpy, without their finer points, so only columns can be compared with each other. Needs numpy and ffmpeg.
"""

import csv
import os
import pathlib
import subprocess
import sys

import numpy as np

DATA = pathlib.Path(os.environ.get("RETRACE_DATA", "."))
WALKS = ("corridor_a", "corridor_b", "run", "stand_walk", "street_day", "street_night", "kitti_03")
SPANS, COMPARED = 10, 5  # frames apart: for learning, and for each frame's motion


def normalised(video):
    """Thumbnails of 64 x 32, every patch of 8 x 8 to mean 0 and deviation 1 (SSS Eq. 2)."""
    pixels = subprocess.run(["ffmpeg", "-loglevel", "error", "-i", video, "-vf", "scale=64:32:flags=area,format=gray", "-f", "rawvideo",
                             "-"], capture_output=True, check=True).stdout
    patches = np.frombuffer(pixels, np.uint8).reshape(-1, 4, 8, 8, 8).astype(np.float32)
    mean, deviation = patches.mean((2, 4), keepdims=True), patches.std((2, 4), keepdims=True)
    return np.where(deviation > 1, (patches - mean) / np.maximum(deviation, 1), 0).reshape(-1, 32, 64)


def true_steps(walk):
    """Metres moved in each frame."""
    if walk == "kitti_03":
        at = np.loadtxt(DATA / walk / "poses_kitti.txt").reshape(-1, 3, 4)[:, :, 3]
        return np.r_[0, np.linalg.norm(np.diff(at, axis=0), axis=1)]
    with open(DATA / "sim" / f"{walk}.csv", newline="") as file:
        return np.r_[0, np.diff([float(row["distance_m"]) for row in csv.DictReader(file)])]


def estimated_steps(errors, moving):
    """Motion of each frame by the learned relation (SSS 3.2), the least over the spans that are compared."""
    means = [0]
    for error in errors:
        mean = error[moving[:len(error)]].mean()
        if mean <= means[-1]:
            break
        means.append(mean)
    frames = len(errors[0]) + 1
    estimates = np.full((COMPARED, frames), np.inf)
    for span in range(1, COMPARED + 1):
        speed = np.interp(errors[span - 1], means, np.arange(len(means))) / span
        known = errors[span - 1] < means[-1] if span > 1 else np.ones(len(speed), bool)
        total, count = np.zeros(frames), np.zeros(frames)
        for frame in range(1, span + 1):
            total[np.flatnonzero(known) + frame] += speed[known]
            count[np.flatnonzero(known) + frame] += 1
        estimates[span - 1, count > 0] = total[count > 0] / count[count > 0]
    least = estimates.min(0)
    return np.minimum(np.where(np.isfinite(least), least, 0), 2)


def relative_error(estimated, true, frames_s=25):
    count = min(len(estimated), len(true)) // frames_s * frames_s
    a, b = (values[:count].reshape(-1, frames_s).sum(1) for values in (estimated, true))
    moving = b > 0.2 * np.median(b)
    a, b = a[moving], b[moving]
    return np.sqrt(np.mean((a * b.sum() / a.sum() - b) ** 2)) / b.mean()


def weights(differences, moving):
    """By name: the share of growth that a straight line explains, and its fourth power; the growth over five frames, in deviations
    of the difference, and its square; the slope."""
    mean = np.array([d[moving[:len(d)]].mean(0) for d in differences])
    span = np.arange(1, SPANS + 1) - (SPANS + 1) / 2
    spread = mean - mean.mean(0)
    slope = (spread * span[:, None, None]).sum(0) / (span ** 2).sum()
    explained = (slope > 0) * slope ** 2 * (span ** 2).sum() / np.maximum((spread ** 2).sum(0), 1e-9)
    deviation = differences[4][moving[:len(differences[4])]].std(0)
    steady = np.maximum(mean[4] - mean[0], 0) / np.maximum(deviation, 1e-6)
    return {"straight": explained, "straight^4": explained ** 4, "steady": steady, "steady^2": steady ** 2, "slope": np.maximum(slope, 0)}


def main():
    print("| walk | alike | straight | straight^4 | steady | steady^2 | slope |\n" + "|---" * 7 + "|")
    for walk in sys.argv[1:] or WALKS:
        video = DATA / walk / "drive.mp4" if walk == "kitti_03" else DATA / "sim" / f"{walk}.mp4"
        images, true = normalised(video), true_steps(walk)
        speed = np.convolve(true, np.ones(25), "same")
        moving = np.ones(len(images), bool)
        moving[:len(true)] = (speed >= 5 * np.median(true[true > 0]))[:len(images)]
        differences = [np.abs(images[span:] - images[:-span]) for span in range(1, SPANS + 1)]
        cells = [relative_error(estimated_steps([d.mean((1, 2)) for d in differences], moving), true)]
        for weight in weights(differences, moving).values():
            errors = [(d * (weight / weight.sum())).sum((1, 2)) for d in differences]
            cells.append(relative_error(estimated_steps(errors, moving), true))
        print(f"| {walk} | " + " | ".join(f"{cell:.3f}" for cell in cells) + " |", flush=True)


if __name__ == "__main__":
    if not DATA.is_dir():
        sys.exit(f"no data folder {DATA}; set RETRACE_DATA")
    main()
