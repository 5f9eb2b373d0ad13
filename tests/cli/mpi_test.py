#!/usr/bin/env python3
"""`mpirun -n N retrace localise`: the same bytes for any N. Skipped, visibly, where there is no MPI or the build has none."""

import os
import pathlib
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.retrace_cli import RETRACE, check, draw_walk, read_json, rows, street, write_truth  # noqa: E402

SKIPPED = 77
MPIRUN = ["mpirun", "--oversubscribe", "--allow-run-as-root", "--quiet"]
FRAMES = 4700  # more than eight blocks of 512
NUMBERS = (1, 2, 3, 5, 8)


def together(processes, *arguments, **options):
    """The finished mpirun of `retrace ARGUMENTS`."""
    return subprocess.run([*MPIRUN, "-n", str(processes), RETRACE, *map(str, arguments)], capture_output=True, text=True,
                          timeout=300, stdin=subprocess.DEVNULL, **options)


def draw_whole_pixels(folder, wall, positions, width=64):
    """As draw_walk, for whole positions, which takes slices only."""
    folder.mkdir()
    lines = [bytes(line) for line in wall]
    for i, at in enumerate(positions):
        (folder / f"{i}.pgm").write_bytes(b"P5 %d %d 255\n" % (width, len(lines)) + b"".join(line[at:at + width] for line in lines))
    return folder


class MpiTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = pathlib.Path(tempfile.mkdtemp(prefix="retrace-mpi-"))
        wall = street(length=FRAMES + 70, height=32)
        cls.walk = draw_whole_pixels(cls.made / "reference", wall, range(FRAMES))
        # Across the borders of shards at 512, 1024 and 1536, with a match every twelve keyframes of the route.
        cls.query = draw_whole_pixels(cls.made / "query", wall, range(470, 470 + 12 * 100, 12))
        cls.along = draw_whole_pixels(cls.made / "along", wall, range(2000, 2100))  # across 2048
        cls.route = cls.made / "route.db"
        check("build", cls.walk, "-o", cls.route, "--motion", "none", "--every", 1)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.made)

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="run-", dir=self.made))

    def expect_the_same(self, query, route, *options, numbers=NUMBERS):
        """Every number of processes gives the files of one run without MPI."""
        check("localise", query, "--route", route, "-o", self.folder / "alone", *options)
        expected = (self.folder / "alone/matches.csv").read_bytes()
        alone = read_json(self.folder / "alone/summary.json")
        self.assertEqual(alone["processes"], 1)
        for number in numbers:
            folder = self.folder / f"by-{number}"
            done = together(number, "localise", query, "--route", route, "-o", folder, *options)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual((folder / "matches.csv").read_bytes(), expected, f"{number} processes")
            summary = read_json(folder / "summary.json")
            self.assertEqual(summary.pop("processes"), number)
            shards = summary.pop("shards", [])
            self.assertEqual(len(shards), number if number > 1 else 0)
            self.assertEqual(summary, {key: value for key, value in alone.items() if key != "processes"})
            for name in ("cost_matrix.png", "trajectory.tum", "config.toml"):
                self.assertEqual((folder / name).read_bytes(), (self.folder / "alone" / name).read_bytes(), name)
            self.assertEqual(sorted(p.name for p in folder.iterdir()), sorted(p.name for p in (self.folder / "alone").iterdir()))
        return alone

    def test_the_default_search_gives_the_same_bytes(self):
        self.expect_the_same(self.along, self.route)
        # The walk was found on both sides of the border.
        found = [row for row in rows(self.folder / "by-8/matches.csv") if row["accepted"] == "1"]
        places = [int(row["reference_frame"]) for row in found]
        self.assertLess(min(places), 2048)
        self.assertGreaterEqual(max(places), 2048)
        for row, place in zip(found, places):  # keyframes within the uniqueness window are one place to the search
            self.assertLessEqual(abs(place - 2000 - int(row["query_frame"])), 10)

    def test_steps_across_several_borders_give_the_same_bytes(self):
        self.expect_the_same(self.query, self.route, "--v-min", 8, "--v-max", 16)

    def test_lines_give_the_same_bytes(self):
        self.expect_the_same(self.along, self.route, "--search", "lines", "--sequence-length", 30, "--uniqueness-window", 40)

    def test_a_route_with_motion_gives_the_same_bytes(self):
        """Its scale is tied, and some members have no keyframe."""
        wall = street(seed=2)
        there, here = [1.0 * i for i in range(700)], [1.5 * i for i in range(400)]
        draw_walk(self.folder / "r", wall, there)
        draw_walk(self.folder / "q", wall, here, gain=0.8)
        truth = write_truth(self.folder / "r.csv", there)
        check("build", self.folder / "r", "-o", self.folder / "r.db", "--truth", truth)
        self.expect_the_same(self.folder / "q", self.folder / "r.db", numbers=(1, 3))

    def refused(self, processes, *arguments, says, code=1):
        done = together(processes, *arguments)
        self.assertEqual(done.returncode, code, done.stderr)
        lines = [line for line in done.stderr.splitlines() if line.startswith("retrace: ")]
        self.assertEqual(len(lines), 1, done.stderr)
        self.assertIn(says, lines[0])
        self.assertEqual([path for path in self.folder.rglob("*") if path.is_file()], [])

    def test_refuses_in_one_line_what_cannot_be_divided(self):
        run = ["localise", self.along, "--route", self.route, "-o", self.folder / "run"]
        for options, says in ((["--search", "graph"], "search graph: cannot be divided among processes; expected path or lines"),
                              (["--enhance", "none"], "enhance none"), (["--memory", "2G"], "--memory"),
                              (["--sampling-n", "3"], "sampling-n")):
            self.refused(3, *run, *options, says=says)
        self.refused(2, "localise", self.along, "--route", self.folder / "no.db", "-o", self.folder / "run", says="does not exist")

    def test_a_part_of_the_file_that_is_damaged_ends_all_in_one_line(self):
        damaged = self.made / "damaged.db"
        shutil.copy(self.route, damaged)
        with sqlite3.connect(damaged) as database:
            database.execute("DROP TABLE IF EXISTS row_digest")  # which would show it to the first process
            database.execute("UPDATE descriptor_chunk SET checksum = 0 WHERE first = 4096")  # of the last members alone
        self.refused(3, "localise", self.along, "--route", damaged, "-o", self.folder / "run", says="does not fit its checksum")

    def test_a_process_that_is_killed_ends_the_run_and_leaves_nothing(self):
        # The first process waits for its walk; another is killed meanwhile.
        process = subprocess.Popen([*MPIRUN, "-n", "3", RETRACE, "localise", "-", "--route", str(self.route), "-o",
                                    str(self.folder / "run")], stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        victim = None
        for _ in range(200):
            victim = self.process_of_rank(process.pid, 1)
            if victim and (self.folder / "run").exists():
                break
            time.sleep(0.1)
        self.assertIsNotNone(victim)
        os.kill(victim, signal.SIGKILL)
        process.stdin.close()
        process.stdin = None
        _, said = process.communicate(timeout=60)
        self.assertNotEqual(process.returncode, 0, said)
        self.assertEqual([path for path in self.folder.rglob("*") if path.is_file()], [])

    def process_of_rank(self, parent, rank):
        for path in pathlib.Path("/proc").glob("[0-9]*/environ"):
            try:
                environment = path.read_bytes()
                status = (path.parent / "status").read_text()
            except OSError:
                continue
            if f"\nPPid:\t{parent}\n" in status and f"OMPI_COMM_WORLD_RANK={rank}\0".encode() in environment:
                return int(path.parent.name)
        return None


if __name__ == "__main__":
    if shutil.which("mpirun") is None:
        print("skipped: no mpirun; Debian's openmpi-bin and libopenmpi-dev expected")
        sys.exit(SKIPPED)
    if not (pathlib.Path(RETRACE).resolve().parent / "libretrace_mpi.so").exists():
        print("skipped: this build has no MPI; CMake with libopenmpi-dev expected")
        sys.exit(SKIPPED)
    unittest.main(verbosity=2)
