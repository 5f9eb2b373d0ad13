"""A walk is added to a route again and again, and killed at a random moment each time: half of them at a random operation by
which it changes files, half after a random time. The route must be the old one or the new one, to the byte, and
`inspect`, which checks all digests, must read it; a build afterwards must succeed and leave nothing behind.

    killed_builds.py RETRACE DISK_SHIM [KILLS] [SEED]
"""

import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from retrace_cli import draw_walk, street  # noqa: E402


def main():
    retrace, shim = sys.argv[1], sys.argv[2]
    kills = int(sys.argv[3]) if len(sys.argv) > 3 else 200
    rng = random.Random(int(sys.argv[4]) if len(sys.argv) > 4 else 1)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        wall = street(length=3000)
        draw_walk(folder / "a", wall, [9.0 * i for i in range(200)])
        draw_walk(folder / "b", wall, [9.0 * i + 3 for i in range(200)])
        work = folder / "work"
        work.mkdir()
        route, old = work / "route.db", folder / "old.db"
        subprocess.run([retrace, "build", folder / "a", "-o", old, "--motion", "none", "--every", "1"], check=True,
                       stdout=subprocess.DEVNULL)
        add = [retrace, "build", str(folder / "b"), "-o", str(route), "--name", "b"]

        def build(**extra):
            environment = dict(os.environ, LD_PRELOAD=shim, DISK_SHIM_FOLDER=f"{work}/", **extra)
            return subprocess.Popen(add, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

        shutil.copy(old, route)
        begin = time.monotonic()
        assert build().wait() == 0
        length_s = time.monotonic() - begin
        new = route.read_bytes()
        states, damaged, killed = {"old": 0, "new": 0}, 0, 0
        operations = 60  # beyond the last one the build ends by itself
        for i in range(kills):
            shutil.copy(old, route)
            if i % 2 == 0:
                code = build(DISK_SHIM_KILL=str(rng.randrange(operations))).wait()
            else:
                process = build()
                time.sleep(rng.uniform(0, 1.1 * length_s))
                process.kill()
                code = process.wait()
            killed += code == -signal.SIGKILL
            found = route.read_bytes()
            state = "old" if found == old.read_bytes() else "new" if found == new else None
            if state is None or subprocess.run([retrace, "inspect", route], capture_output=True).returncode != 0:
                damaged += 1
                continue
            states[state] += 1
        shutil.copy(old, route)
        assert build().wait() == 0 and route.read_bytes() == new
        left = sorted(path.name for path in work.iterdir())
        print(f"{kills} builds, {killed} of them killed: the old route {states['old']} times, the new one {states['new']} times, damaged {damaged}; "
              f"left behind after one more build: {', '.join(left)}")
        return 0 if damaged == 0 and left == ["route.db"] else 1


if __name__ == "__main__":
    sys.exit(main())
