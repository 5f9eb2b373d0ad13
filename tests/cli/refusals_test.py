#!/usr/bin/env python3
"""Input that is wrong or damaged, and what is left behind where a command fails."""

import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.cli_test_case import CliTest  # noqa: E402
from support.retrace_cli import RETRACE, check, draw_walk, street, video  # noqa: E402


class RefusalsTest(CliTest):
    def test_refuses_what_is_no_walk(self):
        route = self.folder / "route.db"
        self.refused("build", self.folder / "none.mp4", "-o", route, says="none.mp4: does not exist")
        (self.folder / "empty.mp4").touch()
        self.refused("build", self.folder / "empty.mp4", "-o", route, says="empty.mp4: is empty (0 bytes)")
        (self.folder / "text.mp4").write_text("this is no video\n" * 50)
        self.refused("build", self.folder / "text.mp4", "-o", route, says="text.mp4: is no video that FFmpeg can read")
        one = draw_walk(self.folder / "one", street(length=200), [0])
        self.refused("build", one, "-o", route, says="has 1 frame; expected a walk of at least 2 frames")
        film = video(one, self.folder / "one.avi")
        self.refused("build", film, "-o", route, says="has 1 frame")
        still = draw_walk(self.folder / "still", street(length=200), [3] * 60)
        self.refused("build", still, "-o", route, says="shows no motion to learn from")
        black = draw_walk(self.folder / "black", street(length=400), range(60), gain=0)
        self.refused("build", black, "-o", route, says="shows no motion to learn from")
        (one / "1.pgm").write_bytes(b"P5 4 4 255\n" + bytes(16))
        self.refused("build", one, "-o", route, says="1.pgm: is 4x4 pixels; expected 96x48")
        (one / "1.pgm").write_bytes(b"no picture")
        self.refused("build", one, "-o", route, says="1.pgm: cannot be read as an image")

    def test_refuses_routes_that_do_not_fit(self):
        out = ("-o", self.folder / "run")
        self.refused("localise", self.walks.query, "--route", self.folder / "none.db", *out, says="none.db: does not exist")
        (self.folder / "text.db").write_text("this is no database " * 100)
        self.refused("localise", self.walks.query, "--route", self.folder / "text.db", *out, says="is no route database")
        (self.folder / "empty.db").touch()
        self.refused("inspect", self.folder / "empty.db", says="is no route database")
        self.refused("localise", self.walks.query, "--route", self.walks.route, *out, "--thumbnail-width", "32",
                     says="thumbnail-width: is 32 and the route was built with 64")
        self.refused("localise", self.walks.query, "--route", self.walks.route, *out, "--sequence-length", "500",
                     says="keyframes, the sequence 500", leaves=["run"])
        whole = self.walks.route.read_bytes()
        (self.folder / "cut.db").write_bytes(whole[:len(whole) // 2])
        self.refused("localise", self.walks.query, "--route", self.folder / "cut.db", *out, says="cut.db: is damaged")
        newer = bytearray(whole)
        newer[60:64] = (99).to_bytes(4, "big")  # the header's user version
        (self.folder / "newer.db").write_bytes(newer)
        self.refused("localise", self.walks.query, "--route", self.folder / "newer.db", *out, says="written by another version of retrace")
        self.refused("build", self.walks.query, "-o", self.folder / "newer.db", says="written by another version of retrace")

    def test_refuses_truth_that_is_wrong(self):
        route = self.folder / "route.db"
        good = self.walks.reference_truth.read_text().splitlines()
        cases = {
            "no column 'distance_m'": [",".join(line.split(",")[:5]) for line in good],
            "line 5: x_m is 'abc'": good[:4] + [good[4].replace(",0,", ",abc,", 1)] + good[5:],
            "has 199 rows; expected 600": good[:200],
            "line 3: frame is 7; expected 1": good[:2] + ["7" + good[2][1:]] + good[3:],
        }
        for says, lines in cases.items():
            (self.folder / "truth.csv").write_text("\n".join(lines) + "\n")
            self.refused("build", self.walks.reference, "-o", route, "--truth", self.folder / "truth.csv", says=says)
        (self.folder / "none.tum").write_text("what is this\n")
        self.refused("build", self.walks.reference, "-o", route, "--trajectory", self.folder / "none.tum", says="none.tum")

        short = self.folder / "short.csv"
        short.write_text("\n".join(good[:50]) + "\n")
        run_folder = self.folder / "run"
        shutil.copytree(self.walks.run, run_folder)
        self.refused("evaluate", run_folder, "--query-truth", self.walks.query_truth, "--reference-truth", short,
                     "--tolerance-m", "1", says="reference truth: has no frame")
        (self.folder / "pairs.csv").write_text("query_frame,reference_frame\n5,1\n5,2\n")
        self.refused("evaluate", run_folder, "--pairs", self.folder / "pairs.csv", "--tolerance-frames", "1",
                     says="line 3: query_frame 5 does not follow 5")
        self.refused("evaluate", self.folder / "nowhere", "--pairs", self.folder / "pairs.csv", "--tolerance-frames", "1",
                     says="nowhere: is no folder")

    def test_says_what_is_wrong_with_a_runs_files(self):
        """A line, where a figure was drawn from what is not there."""
        run = self.folder / "run"
        shutil.copytree(self.walks.run, run)
        found = (run / "matches.csv").read_text().splitlines()
        (run / "matches.csv").write_text("\n".join([found[0], found[2], found[1]]) + "\n")
        self.refused("video", run, "-o", self.folder / "side.mp4", says="a row for each query keyframe, in order")
        (run / "matches.csv").write_text("\n".join(found) + "\n")
        (run / "summary.json").write_text('{"queries": "many", "query": 7, "query_frames": 3, "warnings": [null]}')
        self.refused("video", run, "-o", self.folder / "side.mp4", says="the 3 frames that summary.json says the query has")
        (run / "report_data.json").write_text('{"query": 1, "traverses": [{"frame": "x", "pictures": 3}, 4], "pairs": {}}')
        pairs = self.folder / "pairs.csv"
        pairs.write_text("query_frame,reference_frame\n0,0\n100,100\n")
        check("evaluate", run, "--pairs", pairs, "--tolerance-frames", 5)
        (run / "metrics.json").write_text('{"tolerance": "x", "unit": 3}')
        self.refused("compare", run, run, "-o", self.folder / "compared", says="has no tolerance", leaves=["compared"])

    def test_keeps_results_that_are_there(self):
        again = ("localise", self.walks.query, "--route", self.walks.route, "-o", self.walks.run)
        before = (self.walks.run / "matches.csv").read_bytes()
        self.refused(*again, "--sequence-length", "5", says="already exists; expected another folder, or --force")
        self.assertEqual(before, (self.walks.run / "matches.csv").read_bytes())

    def test_refuses_folders_it_cannot_write_to(self):
        self.refused("build", self.walks.reference, "-o", self.folder / "none" / "route.db", says="none: is no folder")
        (self.folder / "file").touch()
        self.refused("localise", self.walks.query, "--route", self.walks.route, "-o", self.folder / "file" / "run",
                     says="cannot be created")
        self.refused("localise", self.walks.query, "--route", self.walks.route, "-o", self.folder / "file",
                     says="file: is no folder")
        if os.geteuid() != 0:  # root may write anywhere
            os.chmod(self.folder, 0o500)
            try:
                self.refused("build", self.walks.reference, "-o", self.folder / "route.db", says="cannot be written to")
            finally:
                os.chmod(self.folder, 0o700)

    def test_a_full_disk_leaves_the_old_file(self):
        route = self.folder / "route.db"
        shutil.copy(self.walks.route, route)
        before = route.read_bytes()
        # A file size limit stands for the full disk: writes fail beyond it. The walk comes from elsewhere.
        limited = ["bash", "-c", 'ulimit -f 40; exec "$0" "$@"', RETRACE, "build", str(self.walks.query), "-o", str(route),
                   "--name", "evening"]
        done = subprocess.run(limited, capture_output=True, text=True)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
        self.assertIn("route.db: ", done.stderr)
        self.assertEqual(before, route.read_bytes())
        self.assertEqual([p.name for p in self.folder.iterdir()], ["route.db"])

    def test_a_killed_build_leaves_the_old_file(self):
        route = self.folder / "route.db"
        shutil.copy(self.walks.route, route)
        before = route.read_bytes()
        for delay_s in (0.02, 0.05, 0.1, 0.2, 0.4):
            process = subprocess.Popen([RETRACE, "build", str(self.walks.query), "-o", str(route), "--name", "evening", "--force"],
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(delay_s)
            process.send_signal(signal.SIGKILL)
            process.wait()
            traverses = check("inspect", route).count("traverse '")
            self.assertIn(traverses, (1, 2))
            if traverses == 1:
                self.assertEqual(before, route.read_bytes())

    def test_refuses_failures_of_a_camera_that_cannot_be_drawn(self):
        self.refused("simulate", "--failure-s", 5, "-o", self.folder / "walk", says="--failures", code=2)
        self.refused("simulate", "--length-m", 5, "--failures", 10, "--failure-s", 60, "-o", self.folder / "walk", says="failure-s: is 60")


if __name__ == "__main__":
    unittest.main(verbosity=2)
