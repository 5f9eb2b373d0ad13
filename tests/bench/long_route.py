#!/usr/bin/python3
"""Makes a route of very many keyframes out of a short one, to measure searches of long routes.

    retrace inspect short.db --export short
    tests/bench/long_route.py short long 1000000
    retrace build --import long -o long.db

The keyframes of the short route are in the middle. All others are as unlike as the real ones are: each has the columns of a
random keyframe in a random order, with noise. Pictures are left out.
"""

import csv
import pathlib
import shutil
import sys

import numpy as np


def main(short, long, count):
    short, long = pathlib.Path(short), pathlib.Path(long)
    shutil.copytree(short, long, ignore=shutil.ignore_patterns("preview-*", "descriptors-*.npy", "keyframes.csv", "thumbnails*"))
    with open(short / "traverse-1/keyframes.csv", newline="") as file:
        keyframes = list(csv.DictReader(file))
    columns = list(keyframes[0])
    at = (count - len(keyframes)) // 2
    with open(long / "traverse-1/keyframes.csv", "w") as file:
        file.write(",".join(columns) + "\n")
        blank = {name: "" for name in columns} | {"displacement": "0", "after_gap": "0"}
        for i in range(count):
            row = blank | {"frame": str(i), "time_s": f"{i / 30:.6f}"}
            file.write(",".join(row[name] for name in columns) + "\n")
    for path in sorted((short / "traverse-1").glob("descriptors-*.npy")):
        real = np.load(path)
        rng = np.random.default_rng(1)
        made = np.lib.format.open_memmap(long / "traverse-1" / path.name, mode="w+", dtype=real.dtype, shape=(count, *real.shape[1:]))
        for first in range(0, count, 4096):
            rows = real[rng.integers(len(real), size=min(4096, count - first))].astype(np.int16)
            if rows.ndim > 2:
                rows = rows[:, rng.permutation(rows.shape[1])]
            rows += rng.integers(-20, 21, size=rows.shape, dtype=np.int16)
            made[first:first + len(rows)] = np.clip(rows, -127 if real.dtype == np.int8 else 0, 127)
        made[at:at + len(real)] = real
    traverses = (short / "traverses.csv").read_text().splitlines()
    header, row = next(csv.reader([traverses[0]])), next(csv.reader([traverses[1]]))
    values = dict(zip(header, row))
    values["frames"] = str(count)
    if "keyframes" in values:
        values["keyframes"] = str(count)
    for name in list(values):
        if name.startswith("thumbnail"):
            values[name] = "0"
    with open(long / "traverses.csv", "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([header, [values[name] for name in header]])


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2], int(sys.argv[3]))
