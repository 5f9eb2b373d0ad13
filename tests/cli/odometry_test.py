#!/usr/bin/env python3
"""What `odometry` reads from a walk: steps, a trajectory, and visual odometry frame by frame."""

import math
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.cli_test_case import CliTest  # noqa: E402
from support.retrace_cli import check, read_json, rows, run  # noqa: E402


class OdometryTest(CliTest):
    def test_turns_a_walk_into_steps_and_a_trajectory(self):
        check("simulate", "--scene", "street", "--length-m", "15", "--seed", "3", "-o", self.folder / "walk")
        truth = rows(self.folder / "walk" / "truth.csv")
        out = self.folder / "out"
        step_length = float(truth[-1]["distance_m"]) / float(truth[-1]["steps"])
        check("odometry", self.folder / "walk" / "walk.mp4", "-o", out, "--step-length", step_length)

        frames = rows(out / "frames.csv")
        self.assertEqual(list(frames[0])[:9], ["frame", "time_s", "displacement", "unit", "source", "orientation_deg", "dx_px",
                                               "matches", "heading_deg"])
        self.assertEqual([row["frame"] for row in frames], [row["frame"] for row in truth])
        steps = rows(out / "steps.csv")
        self.assertEqual(list(steps[0])[:7], ["step", "frame", "time_s", "leg", "x_m", "y_m", "heading_deg"])
        legs = [row["leg"] for row in steps]
        self.assertTrue(all(a != b for a, b in zip(legs, legs[1:])), legs)
        walked = sum(float(row["displacement"]) for row in frames)
        # Steps tell metres, known to a step: by how much of it is made when the walk begins and ends.
        self.assertAlmostEqual(walked, 15, delta=step_length)
        self.assertIn("vo", {row["source"] for row in frames})
        # Each source alone is brought to the length walked where it knows it, and goes its own way within that.
        for alone in ("vo_displacement", "sad_displacement"):
            known = [(float(row[alone]), float(row["displacement"])) for row in frames if row[alone]]
            self.assertGreater(len(known), 0.9 * len(frames), alone)
            self.assertAlmostEqual(sum(own for own, _ in known), sum(moved for _, moved in known), delta=0.01, msg=alone)
        self.assertGreater(max(abs(float(row["sad_displacement"]) - float(row["displacement"])) for row in frames), 0.005)
        alignment = read_json(out / "report_data.json")["alignment"]  # the figures of SSS 1 to 3 and 10
        self.assertEqual(len(alignment["pictures"]), 3)
        self.assertLess(alignment["pictures"][0]["mean"], alignment["pictures"][2]["mean"])  # it grows with the separation
        for name in ("knot_error", "knot_separation"):
            self.assertEqual(alignment["relation"][name], sorted(alignment["relation"][name]))
        check("odometry", self.folder / "walk" / "walk.mp4", "-o", self.folder / "by_steps", "--step-length", step_length,
              "--motion", "steps")
        by_steps = rows(self.folder / "by_steps" / "frames.csv")
        self.assertEqual({row["source"] for row in by_steps[1:]}, {"steps"})
        self.assertEqual({row["vo_displacement"] for row in by_steps}, {""})
        self.assertAlmostEqual(sum(float(row["displacement"]) for row in by_steps), 15, delta=step_length)
        activities = {row["activity"] for row in rows(out / "activity.csv")}
        self.assertIn("walking", activities)
        self.assertNotIn("running", activities)
        self.assertEqual(read_json(out / "summary.json")["steps"], len(steps))

        check("evaluate-odometry", out, "--truth", self.folder / "walk" / "truth.csv")
        metrics = read_json(out / "odometry_metrics.json")
        self.assertLessEqual(abs(metrics["steps_estimated"] - metrics["steps_true"]), 1)
        self.assertLess(metrics["euclidean_error_m"]["10"], 1.05)

        # The same walk measures the step length, and is the same for one thread.
        check("odometry", self.folder / "walk" / "walk.mp4", "-o", self.folder / "calibrated", "--walk-length-m", "15",
              "--motion", "steps", "--threads", "1")
        calibrated = sum(float(row["displacement"]) for row in rows(self.folder / "calibrated" / "frames.csv"))
        # The steps cut off at the ends are longer or shorter than the mean by their cadence: by some tenths of 0.7 m.
        self.assertAlmostEqual(calibrated, 15, delta=0.2)
        self.assertEqual([row["time_s"] for row in rows(self.folder / "calibrated" / "steps.csv")], [row["time_s"] for row in steps])

    def test_visual_odometry_frame_by_frame_and_kittis_errors(self):
        check("simulate", "--scene", "corridor", "--length-m", "12", "--seed", "2", "-o", self.folder / "walk")
        walk, out, truth = self.folder / "walk" / "walk.mp4", self.folder / "out", rows(self.folder / "walk" / "truth.csv")
        check("odometry", walk, "-o", out, "--visual-odometry")
        frames = rows(out / "visual_odometry.csv")
        self.assertEqual(list(frames[0]), ["frame", "time_s", "valid", "displacement", "sigma", "turn_deg", "segment", "loss"])
        self.assertEqual(len(frames), len(truth))
        for row in frames:
            self.assertEqual(row["displacement"] == "", row["valid"] == "0", row)
            self.assertEqual(row["loss"] == "none", row["valid"] == "1", row)
        poses = [line for line in (out / "visual_odometry.tum").read_text().splitlines() if line[0] != "#"]
        self.assertLessEqual(len(poses), len(frames))

        # The truth as KITTI writes it: right, down, ahead.
        lines = []
        for row in truth:
            heading = math.radians(float(row["heading_deg"]))
            c, s = math.cos(heading), math.sin(heading)
            lines.append(f"{c} 0 {s} {row['x_m']} 0 1 0 0 {-s} 0 {c} {row['y_m']}\n")
        kitti = self.folder / "kitti.txt"
        kitti.write_text("".join(lines))
        check("evaluate-odometry", out, "--kitti-poses", kitti)
        metrics = read_json(out / "kitti_metrics.json")
        self.assertEqual(metrics["frames"], len(frames))
        self.assertEqual(metrics["all"]["stretches"], 0)  # the shortest that KITTI measures is 100 m
        self.assertGreater(metrics["metres_per_unit"], 0)
        kitti.write_text("".join(lines[:-1]))
        self.refused("evaluate-odometry", out, "--kitti-poses", kitti, says="one for each frame of the walk")
        for option in ("--truth", kitti), ("--segment-m", 50), ("--segments", 5), ("--seed", 7), ("--true-steps", 9):
            self.refused("evaluate-odometry", out, "--kitti-poses", kitti, *option, says="--kitti-poses", code=2)
        (out / "visual_odometry.csv").unlink()
        self.refused("evaluate-odometry", out, "--kitti-poses", kitti, says="visual_odometry.csv: does not exist")

    def test_refuses_odometry_it_cannot_do(self):
        walk = ("odometry", self.walks.query, "-o", self.folder / "out")
        self.refused(*walk, "--frame-rate-hz", "7", says="7 frames/s, too few to see steps; expected more than 8", leaves=("out",))
        self.refused(*walk, "--walk-length-m", 20, "--step-length", 0.7, says="--step-length: has no effect")
        self.refused(*walk, "--camera", self.folder / "none.yml", says="none.yml: does not exist")
        calibration = self.folder / "camera.yml"
        calibration.write_text("%YAML:1.0\n---\nimage_width: 1000\nimage_height: 480\ncamera_matrix: !!opencv-matrix\n   rows: 3\n"
                               "   cols: 3\n   dt: d\n   data: [ 600., 0., 500., 0., 600., 240., 0., 0., 1. ]\n")
        self.refused(*walk, "--camera", calibration, says="is of 1000x480 pixels; expected", leaves=("out",))
        for degrees in ("9", "171"):
            done = run(*walk, "--fov-deg", degrees)
            self.assertEqual(done.returncode, 2)
            self.assertIn("--fov-deg", done.stderr)
        self.assertFalse((self.folder / "out" / "steps.csv").exists())


if __name__ == "__main__":
    unittest.main(verbosity=2)
