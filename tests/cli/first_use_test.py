#!/usr/bin/env python3
"""What a newcomer meets first: help, the demo, the doctor, the README's example."""

import json
import os
import pathlib
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.cli_test_case import CliTest  # noqa: E402
from support.retrace_cli import check, draw_walk, rows, street  # noqa: E402


class FirstUseTest(CliTest):
    def test_help_shows_units_defaults_and_examples(self):
        for command in ("build", "localise", "correct", "evaluate", "odometry", "evaluate-odometry", "inspect", "config"):
            text = check(command, "--help")
            self.assertIn("Example", text)
            self.assertIn(f"retrace {command}", text)
        self.assertRegex(check("localise", "--help"), r"--search-range-rad NUMBER=0\.1")
        self.assertRegex(check("--version"), r"^retrace \d+\.\d+\.\d+\n$")

    def test_the_demo_shows_that_speed_does_not_matter(self):
        demo = self.folder / "demo"
        result = json.loads(check("demo", "-o", demo, "--length-m", "25", "--json"))
        self.assertGreater(result["normalised"]["max_f1"], result["vanilla"]["max_f1"] + 0.2)
        self.assertLess(result["normalised"]["median_error_m"], 1)
        for name in ("overview.png", "route.db", "day/truth.csv", "day/walk.mp4", "night/walk.mp4", "normalised/report.html",
                     "vanilla/matches.csv"):
            self.assertGreater((demo / name).stat().st_size, 0, name)
        self.refused("demo", "-o", demo, says="--force")

    def test_the_doctor_says_what_a_recording_is_fit_for(self):
        check("simulate", "--scene", "street", "--length-m", "15", "--seed", "3", "-o", self.folder / "walk")
        walk, truth = self.folder / "walk" / "walk.mp4", rows(self.folder / "walk" / "truth.csv")
        told = json.loads(check("doctor", walk, "--json"))
        self.assertEqual(told["frames"], len(truth))
        self.assertAlmostEqual(told["steps"], int(truth[-1]["steps"]), delta=1)
        self.assertEqual({finding["check"]: finding["fitness"] for finding in told["findings"]}["gait"], "good")
        self.assertIn("fit to be a reference", check("doctor", walk))
        # The same walk between black bars, and a camera that sees one view.
        barred = self.folder / "barred.mp4"
        subprocess.run(["ffmpeg", "-v", "error", "-i", str(walk), "-vf", "pad=640:480:0:60", "-q:v", "3", str(barred)], check=True)
        told = json.loads(check("doctor", barred, "--json"))
        self.assertEqual(told["frame_size"], [640, 360])
        self.assertEqual(told["fitness"], "with care")
        self.assertIn("--crop", "".join(finding["text"] for finding in told["findings"]))
        still = draw_walk(self.folder / "still", street(), [40] * 60)
        shown = check("doctor", still)
        self.assertIn("not fit to be a reference", shown.splitlines()[0])
        self.assertIn("shows no motion", shown)
        self.refused("doctor", self.folder / "none.mp4", says="does not exist")

    def test_the_example_of_the_readme_finds_a_walk(self):
        check("simulate", "--scene", "corridor", "--length-m", "25", "--seed", "2", "-o", self.folder / "walk")
        walk, truth = self.folder / "walk" / "walk.mp4", self.folder / "walk" / "truth.csv"
        done = subprocess.run([os.environ["RETRACE_EXAMPLE"], walk, truth, walk, truth], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("max-F1 1.000", done.stdout)  # it is the same walk
        self.assertGreater((self.folder / "route.db").stat().st_size, 0)
        self.assertTrue((self.folder / "night.tum").exists())


if __name__ == "__main__":
    unittest.main(verbosity=2)
