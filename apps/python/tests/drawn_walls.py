"""Walks that tests draw: a wall of random blocks seen through a moving window."""

import numpy as np


def wall(length=1200, height=48, seed=1):
    rng = np.random.default_rng(seed)
    texture = np.full((height, length), 128.0)
    for size in (48, 24, 12, 6):
        blocks = rng.uniform(-45, 45, (-(-height // size), -(-length // size)))
        texture += np.kron(blocks, np.ones((size, size)))[:height, :length]
    return np.clip(texture, 0, 255).astype(np.uint8)


def views(texture, positions, width=96):
    return [np.ascontiguousarray(texture[:, int(p):int(p) + width]) for p in positions]


def write_walk(folder, name, texture, positions, metres_per_px=0.01):
    """A folder of PGM pictures, `name`, and its truth, `name.csv`, at 30 pictures a second; returns the paths of both."""
    (folder / name).mkdir()
    for i, picture in enumerate(views(texture, positions)):
        (folder / name / f"{i}.pgm").write_bytes(b"P5 %d %d 255\n" % picture.shape[::-1] + picture.tobytes())
    rows = [f"{i},{i / 30:.4f},0,{p * metres_per_px:.4f},0,{p * metres_per_px:.4f},0" for i, p in enumerate(positions)]
    (folder / f"{name}.csv").write_text("frame,time_s,x_m,y_m,heading_deg,distance_m,steps\n" + "\n".join(rows) + "\n")
    return str(folder / name), str(folder / f"{name}.csv")
