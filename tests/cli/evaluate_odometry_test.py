#!/usr/bin/env python3
"""Odometry measured by the paper's protocol, on trajectories made for it."""

import json
import math
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.cli_test_case import CliTest  # noqa: E402
from support.retrace_cli import check, read_json  # noqa: E402


def write_odometry(folder, poses, steps):
    """What `retrace odometry` leaves, as far as its evaluation reads it: poses are (time_s, x_m, y_m, heading_deg)."""
    folder.mkdir()
    lines = []
    for time_s, x_m, y_m, heading_deg in poses:
        half_yaw = math.radians(90 - heading_deg) / 2
        lines.append(f"{time_s:.6f} {x_m:.6f} {y_m:.6f} 0 0 0 {math.sin(half_yaw):.9f} {math.cos(half_yaw):.9f}\n")
    (folder / "trajectory.tum").write_text("".join(lines))
    rows_of_steps = [f"{i},{i},{i / 2},left,0,{i},0\n" for i in range(steps)]
    (folder / "steps.csv").write_text("step,frame,time_s,leg,x_m,y_m,heading_deg\n" + "".join(rows_of_steps))
    return folder


class EvaluateOdometryTest(CliTest):
    def test_evaluates_odometry_by_the_paper_s_protocol(self):
        # The truth goes 120 m north at 1 m/s; the estimate is a tenth too long, and 5 m to the side.
        truth = self.folder / "truth.csv"
        truth.write_text("frame,time_s,x_m,y_m,heading_deg,distance_m,steps\n" +
                         "".join(f"{i},{i},0,{i},0,{i},{i * 3 // 2}\n" for i in range(121)))
        walk = write_odometry(self.folder / "walk", [(i, 5, 1.1 * i, 0) for i in range(121)], steps=171)
        shown = check("evaluate-odometry", walk, "--truth", truth)
        self.assertIn("steps: 171, truly 180, error 5.00 %", shown)
        metrics = read_json(walk / "odometry_metrics.json")
        self.assertEqual((metrics["steps_estimated"], metrics["steps_true"]), (171, 180))
        self.assertAlmostEqual(metrics["step_error_pct"], 5)
        for at_m in ("5", "10", "25", "50", "75", "100"):
            # Six decimals in the file.
            self.assertAlmostEqual(metrics["euclidean_error_m"][at_m], 0.1 * float(at_m), places=4)
            self.assertAlmostEqual(metrics["euclidean_error_sd_m"][at_m], 0, places=4)
            self.assertAlmostEqual(metrics["heading_error_deg"][at_m], 0, places=4)
            self.assertEqual(metrics["measurements"][at_m], 25)
        self.assertEqual(json.loads(check("evaluate-odometry", walk, "--truth", truth, "--json")), metrics)

        # The same way on a map of 0.5 m a pixel, up being north: by shares of the way, the estimate is a tenth too long.
        way = self.folder / "way.csv"
        way.write_text("x_px,y_px\n40,300\n40,60\n")
        check("evaluate-odometry", walk, "--truth", way, "--map-scale-m-per-px", "0.5", "--true-steps", "171", "--segment-m", "50")
        metrics = read_json(walk / "odometry_metrics.json")
        self.assertEqual(metrics["step_error_pct"], 0)
        self.assertAlmostEqual(metrics["distance_m"], 120)
        self.assertAlmostEqual(metrics["euclidean_error_m"]["50"], 5, places=4)
        self.assertIsNone(metrics["euclidean_error_m"]["75"])
        self.assertEqual(metrics["measurements"]["75"], 0)

    def test_pools_the_odometry_of_several_walks(self):
        # One walk of 200 m a tenth too long, 4 steps too many of 100; one of 60 m as true as can be, 2 too few of 60, which
        # is too short for 75 and 100 m.
        walks, truths = [], []
        for name, metres, scale, found, steps in (("long", 200, 1.1, 104, 100), ("short", 60, 1, 58, 60)):
            truths.append(self.folder / f"{name}.csv")
            truths[-1].write_text("frame,time_s,x_m,y_m,heading_deg,distance_m,steps\n" +
                                  "".join(f"{i},{i},0,{i},0,{i},{steps if i == metres else 0}\n" for i in range(metres + 1)))
            walks.append(write_odometry(self.folder / name, [(i, 0, scale * i, 0) for i in range(metres + 1)], steps=found))
        (self.folder / "file").write_text("")
        self.refused("evaluate-odometry", *walks, "--truth", *truths, "-o", self.folder / "file", says="file: is no folder")
        shown = check("evaluate-odometry", *walks, "--truth", *truths, "-o", self.folder / "all")
        self.assertIn("2 walks, steps: 162, truly 160, error 3.75 %, 3.00 +- 1.41 steps a walk", shown)
        metrics = read_json(self.folder / "all" / "odometry_metrics.json")
        self.assertEqual((metrics["walks"], metrics["steps_estimated"], metrics["steps_true"]), (2, 162, 160))
        self.assertEqual(metrics["measurements"]["50"], 50)
        self.assertEqual(metrics["measurements"]["100"], 25)
        # 25 errors of 5 m and 25 of none: mean 2.5, sample deviation 2.5 * sqrt(50 / 49).
        self.assertAlmostEqual(metrics["euclidean_error_m"]["50"], 2.5, places=4)
        self.assertAlmostEqual(metrics["euclidean_error_sd_m"]["50"], 2.5 * (50 / 49) ** 0.5, places=4)
        self.assertAlmostEqual(metrics["euclidean_error_m"]["100"], 10, places=4)
        self.assertEqual(metrics["step_error"]["mean"], 1)
        self.assertEqual(read_json(walks[1] / "odometry_metrics.json")["measurements"]["100"], 0)
        self.refused("evaluate-odometry", *walks, "--truth", truths[0], says="--truth: names 1 files for 2 walks")
        self.refused("evaluate-odometry", *walks, "--truth", *truths, "--true-steps", "3", says="has 1 numbers for 2 walks")
        self.refused("evaluate-odometry", walks[0], "--truth", truths[0], "-o", self.folder, says="--output: is for several walks")

    def test_other_seeds_measure_other_segments(self):
        truth = self.folder / "truth.csv"
        truth.write_text("frame,time_s,x_m,y_m,heading_deg,distance_m\n" + "".join(f"{i},{i},0,{i},0,{i}\n" for i in range(201)))
        # Its steps grow longer and longer, so that errors depend on where a segment starts.
        walk = write_odometry(self.folder / "walk", [(i, 0, i + i * i / 500, 0) for i in range(201)], steps=10)
        results = [check("evaluate-odometry", walk, "--truth", truth, "--json", "--seed", seed) for seed in ("1", "1", "2")]
        self.assertEqual(results[0], results[1])
        first, other = json.loads(results[0]), json.loads(results[2])
        self.assertNotEqual(first["euclidean_error_m"]["10"], other["euclidean_error_m"]["10"])
        self.assertGreater(first["euclidean_error_sd_m"]["10"], 0)
        self.assertIsNone(first["steps_true"])
        self.assertIsNone(first["step_error_pct"])

    def test_refuses_odometry_and_truth_that_do_not_fit(self):
        walk = write_odometry(self.folder / "walk", [(i, 0, i, 0) for i in range(50)], steps=5)
        truth, way, point = self.folder / "truth.csv", self.folder / "way.csv", self.folder / "point.csv"
        truth.write_text("frame,time_s,x_m,y_m,heading_deg,distance_m\n" + "".join(f"{i},{i},0,{i},0,{i}\n" for i in range(4)))
        way.write_text("x_px,y_px\n0,0\n0,9\n")
        point.write_text("x_px,y_px\n3,3\n3,3\n")
        empty = self.folder / "empty"
        empty.mkdir()
        evaluate = ("evaluate-odometry", walk, "--truth")
        self.refused(*evaluate, truth, says="the trajectory share 3.0 m; expected 5 m or more")
        self.refused(*evaluate, self.folder / "none.csv", says="none.csv: does not exist")
        self.refused(*evaluate, way, says="expected --map-scale-m-per-px")
        self.refused(*evaluate, truth, "--map-scale-m-per-px", "1", says="has no column 'x_px'")
        self.refused(*evaluate, point, "--map-scale-m-per-px", "1", says="point.csv: is no path")
        self.refused(*evaluate, way, "--map-scale-m-per-px", "0", says="--map-scale-m-per-px: Value 0: expected a positive number", code=2)
        self.refused("evaluate-odometry", self.folder / "nowhere", "--truth", truth, says="nowhere: is no folder")
        self.refused("evaluate-odometry", empty, "--truth", truth, says="steps.csv: does not exist")
        (walk / "trajectory.tum").write_text("0 1 2\n")
        self.refused(*evaluate, truth, says="trajectory.tum: line 1: has 3 numbers")


if __name__ == "__main__":
    unittest.main(verbosity=2)
