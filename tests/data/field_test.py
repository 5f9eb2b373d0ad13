#!/usr/bin/env python3
"""Inputs as people have them, each of which was once read wrongly: every row of the README in the data's folder `field`.

Reads the folder that RETRACE_DATA names, or ../shared/data beside the source tree; without it, says so and is skipped. Videos
are drawn by the folder's own make.sh (RETRACE_FIELD_VIDEOS names a folder that has them already); without ffmpeg those rows are
skipped.
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.retrace_cli import SOURCE, check, read_json, rows, run  # noqa: E402

DATA = pathlib.Path(os.environ.get("RETRACE_DATA", SOURCE.parent / "shared" / "data"))
FIELD, SIM, FOOTPATH = DATA / "field", DATA / "sim", DATA / "gopro_footpath"
SURVEYED_M, TOLERANCE_M = 20.1, 0.3  # of the GPS track: a few tenths by where its first and last keyframe are
CORRIDOR_M = 103.7


class FieldTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="retrace-field-"))
        cls.count = 0

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def built(self, walk, *options):
        """What `build` prints as JSON, its warnings, and the traverse."""
        FieldTest.count += 1
        route = self.folder / f"{self.count}.db"
        done = run("build", walk, "-o", route, "--json", *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout), done.stderr, json.loads(check("inspect", route, "--json"))["traverses"][0]

    def footpath(self, *options):
        return self.built(FOOTPATH / "reference.mp4", "--motion", "none", "--every", 10, *options)

    def corridor(self, *options):
        return self.built(SIM / "corridor_a.mp4", "--motion", "none", "--every", 60, *options)

    def refused(self, walk, *options, says):
        FieldTest.count += 1
        done = run("build", walk, "-o", self.folder / f"{self.count}.db", "--motion", "none", "--every", 60, *options)
        self.assertEqual(done.returncode, 1, done.stdout)
        for words in says:
            self.assertIn(words, done.stderr)

    def surveyed_m(self, traverse):
        known = [k["distance_m"] for k in traverse["keyframe"] if "distance_m" in k]
        return known[-1] - known[0]

    # ---- GPX ----

    def track(self, name, *options):
        _, said, traverse = self.footpath("--track", FIELD / "gpx" / name, *options)
        print(f"\n  {name}: {self.surveyed_m(traverse):.1f} m", end=" ", flush=True)
        return said, traverse

    def test_tracks_that_say_the_same_in_other_words(self):
        for name in ("base.gpx", "mixed_offset.gpx", "UPPER.GPX", "prefix.gpx", "space_eq.gpx", "utf16.gpx"):
            with self.subTest(name):
                said, traverse = self.track(name)
                self.assertEqual(said, "")
                self.assertAlmostEqual(self.surveyed_m(traverse), SURVEYED_M, delta=TOLERANCE_M)

    def test_a_logger_that_ran_before_the_camera(self):
        self.assertIn("the video", self.track("starts_60s_before.gpx")[0])
        said, traverse = self.track("starts_60s_before.gpx", "--track-start-s", 60)
        self.assertEqual(said, "")
        self.assertAlmostEqual(self.surveyed_m(traverse), SURVEYED_M, delta=TOLERANCE_M)

    def test_two_tracks_in_one_file(self):
        said, traverse = self.track("two_tracks.gpx")
        self.assertIn("'yesterday'", said)
        self.assertIn("--track-name", said)
        self.assertAlmostEqual(self.surveyed_m(traverse), SURVEYED_M, delta=TOLERANCE_M)
        said, traverse = self.track("two_tracks.gpx", "--track-name", "yesterday")
        self.assertEqual(said, "")
        self.assertAlmostEqual(self.surveyed_m(traverse), SURVEYED_M, delta=TOLERANCE_M)

    def test_files_without_a_track(self):
        self.refused(FOOTPATH / "reference.mp4", "--track", FIELD / "gpx" / "route.gpx", says=["route.gpx", "route"])
        self.refused(FOOTPATH / "reference.mp4", "--track", FIELD / "gpx" / "wpt.gpx", says=["wpt.gpx", "waypoints"])

    def test_bad_points_are_left_out(self):
        for name in ("dup.gpx", "emptycoord.gpx", "sometimes.gpx", "subsecond_dropped.gpx"):
            with self.subTest(name):
                said, traverse = self.track(name)
                self.assertIn("left out", said)
                # Where a point is left out at an end, up to a second of walk is not surveyed; tenths dropped, one moves by as much.
                self.assertAlmostEqual(self.surveyed_m(traverse), SURVEYED_M, delta=2)
        said, traverse = self.track("segs_out_of_order.gpx")
        # Between two segments, a second of the walk, nothing is known.
        self.assertAlmostEqual(self.surveyed_m(traverse), SURVEYED_M, delta=2)

    # ---- trajectories ----

    def trajectory(self, name, *options):
        _, said, traverse = self.corridor("--trajectory", FIELD / "tum" / name, *options)
        print(f"\n  {name}: {self.surveyed_m(traverse):.1f} m", end=" ", flush=True)
        return said, traverse

    def test_no_pose_where_tracking_was_lost(self):
        _, traverse = self.trajectory("lost.tum")
        without = [k["time_s"] for k in traverse["keyframe"] if "x_m" not in k]
        self.assertAlmostEqual(len(without) * 60 / 25, 30, delta=2 * 60 / 25)  # a keyframe at either end
        self.assertLess(max(b - a for a, b in zip(without, without[1:])), 2 * 60 / 25)

    def test_a_camera_s_axes(self):
        for options in ((), ("--axes", "camera")):
            _, traverse = self.trajectory("orbslam_xz.tum", *options)
            self.assertAlmostEqual(self.surveyed_m(traverse), CORRIDOR_M, delta=1)

    def test_lines_as_programs_write_them(self):
        for name, warned in (("nan.tum", "left out"), ("dup.tum", "left out"), ("header.tum", ""), ("comma.tum", ""), ("bom.tum", ""),
                             ("unsorted.tum", "sorted"), ("nonunit.tum", "")):
            with self.subTest(name):
                said, traverse = self.trajectory(name)
                self.assertAlmostEqual(self.surveyed_m(traverse), CORRIDOR_M, delta=1)
                self.assertIn(warned, said)
                if not warned and name != "nonunit.tum":
                    self.assertEqual(said, "")

    # ---- truth, calibrations ----

    def test_truth_as_spreadsheets_write_it(self):
        for file in sorted((FIELD / "csv").glob("*.csv")):
            with self.subTest(file.name):
                self.assertAlmostEqual(self.surveyed_m(self.corridor("--truth", file)[2]), CORRIDOR_M, delta=1)

    def test_calibrations(self):
        """All of them say a field of view of 64.4 degrees, which is the default: the same trajectory to a few centimetres."""
        if not shutil.which("ffmpeg"):
            self.skipTest("no ffmpeg, which cuts the walk short")
        clip = self.folder / "clip.mp4"
        subprocess.run(["ffmpeg", "-v", "error", "-i", str(SIM / "run.mp4"), "-t", "4", str(clip)], check=True)

        def end_of(name, *options):
            check("odometry", clip, "-o", self.folder / name, "--motion", "steps", *options)
            return [line.split() for line in (self.folder / name / "trajectory.tum").read_text().splitlines()][-1]
        by_angle = end_of("by_angle")
        for file in sorted((FIELD / "calibration").glob("*.yaml")):
            with self.subTest(file.name):
                for mine, same in zip(end_of(file.stem, "--camera", file), by_angle):
                    self.assertAlmostEqual(float(mine), float(same), delta=0.05)

    # ---- videos ----

    @classmethod
    def video(cls, name):
        if "RETRACE_FIELD_VIDEOS" in os.environ:
            return pathlib.Path(os.environ["RETRACE_FIELD_VIDEOS"]) / name
        if not shutil.which("ffmpeg"):
            raise unittest.SkipTest("no ffmpeg, which draws the videos")
        videos = cls.folder / "videos"
        if not videos.exists():
            subprocess.run(["bash", str(FIELD / "make.sh"), str(videos)], check=True, stdout=subprocess.DEVNULL)
        return videos / name

    def odometry(self, walk, *options):
        out = self.folder / pathlib.Path(walk).stem
        done = run("odometry", walk, "-o", out, "--force", *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        summary = read_json(out / "summary.json")
        print(f"\n  {pathlib.Path(walk).name}: {summary['steps']} steps, {summary['distance']:.1f} {summary['unit']}", end=" ", flush=True)
        return summary, done.stderr

    def keyframes(self, walk, *options):
        result, said, _ = self.built(walk, *options)
        print(f"\n  {pathlib.Path(walk).name}: {result['keyframes']} keyframes", end=" ", flush=True)
        return result["keyframes"], said

    def test_a_clock_that_jumps(self):
        """92 steps of the run, and those of two seconds more at its cadence, 92 in 31.5 s."""
        walk = self.video("gap.mp4")
        truth = rows(SIM / "run.csv")
        true_steps, duration_s = int(float(truth[-1]["steps"])), float(truth[-1]["time_s"])
        in_gap = 2 * true_steps / duration_s
        summary, _ = self.odometry(walk)
        self.assertAlmostEqual(summary["steps"], true_steps + in_gap, delta=2)
        times = [float(row["time_s"]) for row in rows(self.folder / "gap" / "frames.csv")]
        self.assertGreater(max(b - a for a, b in zip(times, times[1:])), 1.9)
        self.assertIn("no frames for 2.0 s, from 27.96 s", " ".join(summary["warnings"]))
        self.keyframes(walk)

    def test_every_other_second_at_half_the_rate(self):
        summary, _ = self.odometry(self.video("half_rate_by_seconds.mp4"), "--step-length", "0.691")
        self.assertAlmostEqual(summary["steps"], 70, delta=1)
        self.assertAlmostEqual(summary["distance"], 48.4, delta=1.04)  # a step and a half

    def test_half_the_rate_gives_the_same_keyframes(self):
        halved, _ = self.keyframes(self.video("half_rate.mp4"))
        clip = self.folder / "whole_rate.mp4"
        subprocess.run(["ffmpeg", "-v", "error", "-i", str(SIM / "street_day.mp4"), "-t", "120", "-c", "copy", str(clip)], check=True)
        whole, _ = self.keyframes(clip)
        self.assertAlmostEqual(halved / whole, 1, delta=0.05)

    def test_a_pause_of_two_minutes(self):
        paused, _ = self.keyframes(self.video("long_pause.mp4"))
        self.assertAlmostEqual(paused / 78, 1, delta=0.1)
        self.assertAlmostEqual(self.odometry(self.video("long_pause.mp4"))[0]["steps"], 70, delta=1)

    def test_pixels_that_are_not_square(self):
        truth = rows(SIM / "corridor_a.csv")
        errors = []
        for walk in (SIM / "corridor_a.mp4", self.video("anamorphic.mp4")):
            out = self.folder / walk.stem
            self.odometry(walk, "--step-length", float(truth[-1]["distance_m"]) / float(truth[-1]["steps"]))
            check("evaluate-odometry", out, "--truth", SIM / "corridor_a.csv")
            errors.append(read_json(out / "odometry_metrics.json")["euclidean_error_m"]["50"])
        print(f"\n  position error after 50 m: {errors[0]:.2f} m with square pixels, {errors[1]:.2f} m with oblong ones", end=" ", flush=True)
        # Fewer pixels across, so a little worse; doubled at first.
        self.assertLess(errors[1], 1.5 * errors[0] + 0.3)

    def test_black_bars(self):
        barred, said = self.keyframes(self.video("letterbox.mp4"))
        self.assertIn("black bars", said)
        plain, _ = self.keyframes(FOOTPATH / "reference.mp4")
        self.assertAlmostEqual(barred / plain, 1, delta=0.1)

    def test_sound_longer_than_the_picture(self):
        self.assertNotIn("breaks off", self.keyframes(self.video("sound_longer.mp4"))[1])


if __name__ == "__main__":
    if not FIELD.is_dir():
        print(f"skipped: no data folder {FIELD}; set RETRACE_DATA")
        sys.exit(77)
    unittest.main(verbosity=1)
