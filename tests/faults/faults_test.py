"""A full disk, a signal, a kill and a power loss at each operation by which a command changes files: what it writes is
there whole or not at all, and what was there before is not lost.

The operations are counted by a library that is loaded before the program (disk_shim.cpp). By default a few of them are
tried for each command; RETRACE_FAULTS=all tries every one.
"""

import os
import pathlib
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from retrace_cli import RETRACE, check, draw_walk, street  # noqa: E402

SHIM = os.environ["RETRACE_DISK_SHIM"]
ALL = os.environ.get("RETRACE_FAULTS") == "all"
FEW = 2  # operations tried of a command, besides the first and the last
SETTINGS = ["--motion", "none", "--every", "1", "--descriptor", "thumbnail"]

# Each command, and what it changes in its workspace; {w} is the workspace, {walks} are walks outside it.
COMMANDS = {
    "build": ["build", "{walks}/a", "-o", "{w}/new.db", *SETTINGS],
    "build_more": ["build", "{walks}/b", "-o", "{w}/route.db", "--name", "second"],
    "localise": ["localise", "{walks}/b", "--route", "{w}/route.db", "-o", "{w}/new", "--save-matrices"],
    "localise_again": ["localise", "{walks}/a", "--route", "{w}/route.db", "-o", "{w}/done", "--force"],
    "evaluate": ["evaluate", "{w}/run", "--pairs", "{walks}/pairs.csv", "--tolerance-frames", "2"],
    "compare": ["compare", "{w}/done", "{w}/done", "-o", "{w}/comparison"],
    "odometry": ["odometry", "{walks}/a", "-o", "{w}/out/odometry"],
    "describe": ["describe", "{walks}/a", "-o", "{w}/a.npy", *SETTINGS],
    "export": ["inspect", "{w}/route.db", "--export", "{w}/folder"],
    "config": ["config", "-o", "{w}/config.toml"],
    "simulate": ["simulate", "--length-m", "6", "--width", "96", "--height", "64", "-o", "{w}/walk"],
    "video": ["video", "{w}/run", "-o", "{w}/side.mp4", "--width-px", "160"],
}


def contents(folder):
    """Every file in a folder, by its path; folders too, which hold None."""
    found = {}
    for path in sorted(pathlib.Path(folder).rglob("*")):
        found[str(path.relative_to(folder))] = path.read_bytes() if path.is_file() else None
    return found


def operations_of(log):
    """The operations that the shim recorded: (kind, path, other path, number, data)."""
    data, at, found = log.read_bytes(), 0, []

    def number():
        nonlocal at
        at += 8
        return struct.unpack_from("<q", data, at - 8)[0]

    def piece():
        nonlocal at
        size = number()
        at += size
        return data[at - size:at]

    while at < len(data):
        kind = chr(data[at])
        at += 1
        first, second = piece().decode(), piece().decode()
        value = number()
        found.append((kind, first, second, value, piece()))
    return found


class Disk:
    """What a disk holds after a power loss: of the operations, some were still on their way."""

    def __init__(self, files):
        self.files = {path: bytearray(data) for path, data in files.items() if data is not None}

    def apply(self, operation):
        kind, first, second, number, data = operation
        if kind == "C":
            if number or first not in self.files:
                self.files[first] = bytearray()
        elif kind == "W":
            file = self.files.setdefault(first, bytearray())
            file.extend(bytes(max(0, number + len(data) - len(file))))
            file[number:number + len(data)] = data
        elif kind == "T":
            file = self.files.setdefault(first, bytearray())
            file.extend(bytes(max(0, number - len(file))))
            del file[number:]
        elif kind == "R" and first in self.files:
            self.files[second] = self.files.pop(first)
        elif kind == "U":
            self.files.pop(first, None)


def after_power_loss(before, operations, renames_first):
    """The disk if only what was flushed had reached it: the writes of a file at its last fsync, and renames when their
    folder was flushed, or, if `renames_first`, at once (file systems order them as they like)."""
    disk = Disk(before)
    pending = []
    for operation in operations:
        kind, first = operation[0], operation[1]
        if kind == "S":
            # A file's own operations, or a folder's renames and removals, are on the disk now.
            flushed = [o for o in pending if o[1] == first or (o[0] in "RUC" and str(pathlib.Path(o[1]).parent) == first)]
            for o in flushed:
                disk.apply(o)
            pending = [o for o in pending if o not in flushed]
        elif renames_first and kind in "RUC":
            disk.apply(operation)
        else:
            pending.append(operation)
    return disk


class FaultsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.walks = cls.folder / "walks"
        wall = street()
        draw_walk(cls.walks / "a", wall, [9.0 * i for i in range(40)])
        draw_walk(cls.walks / "b", wall, [9.0 * i + 3 for i in range(36)])
        (cls.walks / "pairs.csv").write_text("query_frame,reference_frame\n0,0\n35,35\n")
        base = cls.folder / "base"
        base.mkdir()
        check("build", cls.walks / "a", "-o", base / "route.db", *SETTINGS)
        for run in ("run", "done"):
            check("localise", cls.walks / "b", "--route", base / "route.db", "-o", base / run)
        check("evaluate", base / "done", "--pairs", cls.walks / "pairs.csv", "--tolerance-frames", "2")
        cls.base, cls.workspace = base, cls.folder / "workspace"

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def run_in_workspace(self, command, fresh=True, limit=None, **shim):
        """The finished command, in so many bytes of memory; the workspace is as at the beginning before it, unless not
        fresh."""
        if fresh:
            shutil.rmtree(self.workspace, ignore_errors=True)
            shutil.copytree(self.base, self.workspace)
        environment = dict(os.environ, LD_PRELOAD=SHIM, DISK_SHIM_FOLDER=str(self.workspace) + "/", TZ="UTC")
        environment.update({f"DISK_SHIM_{name}": str(value) for name, value in shim.items()})
        arguments = [a.format(w=self.workspace, walks=self.walks) for a in COMMANDS[command]]
        return subprocess.run([RETRACE, *arguments], env=environment, capture_output=True, text=True, timeout=300,
                              preexec_fn=limit and (lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit))))

    def recorded(self, command):
        """Its operations, and what the workspace holds before and after it."""
        log = self.folder / "log"
        log.unlink(missing_ok=True)
        done = self.run_in_workspace(command, LOG=log)
        self.assertEqual(done.returncode, 0, done.stderr)
        operations = operations_of(log)
        self.assertGreater(len(operations), 1, command)
        return operations, contents(self.base), contents(self.workspace)

    def tried(self, operations):
        count = len(operations)
        if ALL or count <= FEW + 2:
            return range(count)
        return sorted({0, count - 1, *(1 + i * (count - 2) // FEW for i in range(FEW))})

    def assert_one_line(self, done, where):
        lines = done.stderr.strip().splitlines()
        self.assertEqual(len([line for line in lines if "warn" not in line]), 1, f"{where}: {done.stderr}")
        self.assertRegex(lines[-1], "^(retrace|libgomp): ", f"{where}: {done.stderr}")  # libgomp ends a program itself
        self.assertNotIn("internal error", done.stderr, where)

    def test_a_full_disk(self):
        for command in COMMANDS:
            operations, before, after = self.recorded(command)
            failed = 0
            for at in self.tried(operations):
                where = f"{command}, full from operation {at} of {len(operations)} on"
                done = self.run_in_workspace(command, FAIL=at)
                found = contents(self.workspace)
                if done.returncode == 0:  # nothing was written from there on
                    self.assertEqual(found, after, where)
                    continue
                failed += 1
                self.assertEqual(done.returncode, 1, f"{where}: {done.stderr}")
                self.assert_one_line(done, where)
                self.assertEqual(sorted(found), sorted(before), where)
                self.assertEqual(found, before, where)
            self.assertGreater(failed, 0, command)

    def test_signals(self):
        for number, command in enumerate(COMMANDS):
            wanted = (signal.SIGINT, signal.SIGTERM)[number % 2]
            operations, before, after = self.recorded(command)
            for at in self.tried(operations):
                where = f"{command}, {wanted.name} at operation {at} of {len(operations)}"
                done = self.run_in_workspace(command, SIGNAL=f"{int(wanted)}@{at}")
                found = contents(self.workspace)
                if done.returncode == 0:  # it was done when the signal came
                    self.assertEqual(found, after, where)
                    continue
                self.assertEqual(done.returncode, 128 + wanted, f"{where}: {done.stderr}")
                self.assert_one_line(done, where)
                if found != after:
                    self.assertEqual(sorted(found), sorted(before), where)
                    self.assertEqual(found, before, where)

    def test_a_kill(self):
        for command in COMMANDS:
            operations, before, after = self.recorded(command)
            for at in self.tried(operations):
                where = f"{command}, killed at operation {at} of {len(operations)}"
                done = self.run_in_workspace(command, KILL=at)
                self.assertEqual(done.returncode, -signal.SIGKILL, where)
                for path, data in contents(self.workspace).items():
                    if any(part.startswith(".") for part in pathlib.Path(path).parts):
                        continue  # what a killed program could not remove
                    self.assertIn(data, (before.get(path, data if data is None else ()), after.get(path, ())),
                                  f"{where}: {path}")
                if command in ("build", "build_more", "export", "localise"):
                    again = self.run_in_workspace(command, fresh=False)
                    if again.returncode == 0:  # else all of it was there already
                        self.assertEqual(contents(self.workspace), after, f"{where}, then run again")

    def test_memory_limits(self):
        """At ten limits, from too little to load the program to enough: done, or one line and nothing left behind."""
        for command in ("build", "localise"):
            _, before, after = self.recorded(command)
            ended = set()
            for megabytes in (100, 200, 300, 350, 380, 410, 450, 550, 700, 3000):
                where = f"{command} in {megabytes} MB"
                done = self.run_in_workspace(command, limit=megabytes << 20)
                ended.add(done.returncode)
                if done.returncode == 0:
                    self.assertEqual(contents(self.workspace), after, where)
                    continue
                self.assertEqual(done.returncode, 1, f"{where}: {done.stderr}")
                self.assert_one_line(done, where)
                self.assertEqual(contents(self.workspace), before, where)
            self.assertEqual(ended, {0, 1}, command)

    def test_the_folder_for_results_vanishes(self):
        shutil.rmtree(self.workspace, ignore_errors=True)
        shutil.copytree(self.base, self.workspace)
        frames = [path.read_bytes().split(b"\n", 1)[1] for path in
                  sorted((self.walks / "b").iterdir(), key=lambda path: int(path.stem))]
        width, height = 96, 48
        process = subprocess.Popen(
            [RETRACE, "localise", "-", "--route", self.workspace / "route.db", "-o", self.workspace / "new"],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        process.stdin.write(f"YUV4MPEG2 W{width} H{height} F25:1 Cmono\n".encode())
        pixels = width * height
        for i, frame in enumerate(frames):
            process.stdin.write(b"FRAME\n" + frame[-pixels:])
            if i == len(frames) // 2:
                process.stdin.flush()
                self.wait_for(self.workspace / "new")
                (self.workspace / "new").rmdir()
        output, error = process.communicate(timeout=100)
        self.assertEqual(process.returncode, 1, error)
        self.assertRegex(error.decode().strip().splitlines()[-1], "^retrace: .*new: cannot be written to: ")
        self.assertFalse((self.workspace / "new").exists())

    def wait_for(self, path):
        end = time.monotonic() + 60
        while not path.exists():
            self.assertLess(time.monotonic(), end, f"{path} did not appear")
            time.sleep(0.01)

    def test_a_power_loss_while_a_walk_is_added(self):
        """At every operation, with everything that was not flushed lost, and with renames before their time: the route is
        the old one or the new one, as its digests prove."""
        for command, name in (("build_more", "route.db"), ("build", "new.db")):
            operations, before, after = self.recorded(command)
            begin = {str(self.workspace / path): data for path, data in before.items()}
            states = set()
            for count in range(len(operations) + 1):
                for renames_first in (False, True):
                    disk = after_power_loss(begin, operations[:count], renames_first)
                    states.add(bytes(disk.files.get(str(self.workspace / name), b"")))
            self.assertIn(after[name], states, "the last state is the new route")
            self.assertEqual(states, {before.get(name, b""), after[name]})
            self.workspace.joinpath(name).write_bytes(after[name])
            check("inspect", self.workspace / name)


if __name__ == "__main__":
    unittest.main()
