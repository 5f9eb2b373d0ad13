#!/usr/bin/env python3
"""The program as a user calls it: the road from walks to metrics, what it refuses, and what it leaves behind."""

import json
import math
import os
import pathlib
import re
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.retrace_cli import RETRACE, SOURCE, check, draw_walk, read_json, rows, run, street, video, write_truth  # noqa: E402

MATCH_COLUMNS = ["query_frame", "query_time_s", "traverse", "reference_frame", "reference_time_s",
                 "reference_distance_m", "score", "accepted", "probability", "sd_keyframes", "sd_m", "yaw_deg", "lateral_m",
                 "ahead_m"]
NAMES = ["nearest_place", "nearest_place_m"]


def positions(speeds):
    """Where the walker is at each frame, from the speed at each, in pixels a frame."""
    where, all_of_them = 0.0, []
    for speed in speeds:
        all_of_them.append(where)
        where += speed
    return all_of_them


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


class Fixture:
    """Two walks along one wall, the second twice as fast where the first is slow; made once."""

    def __init__(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="retrace-cli-"))
        wall = street()
        self.reference_at = positions([1] * 300 + [2] * 300)
        self.query_at = positions([2] * 150 + [1] * 590)
        self.reference = draw_walk(self.folder / "reference", wall, self.reference_at)
        self.query = draw_walk(self.folder / "query", wall, self.query_at, gain=0.7)
        self.reference_truth = write_truth(self.folder / "reference.csv", self.reference_at)
        self.query_truth = write_truth(self.folder / "query.csv", self.query_at)
        self.route = self.folder / "route.db"
        check("build", self.reference, "-o", self.route, "--truth", self.reference_truth)
        self.run = self.folder / "run"
        check("localise", self.query, "--route", self.route, "-o", self.run)


class CliTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.walks = Fixture()

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.walks.folder)

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="retrace-cli-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def refused(self, *arguments, says, code=1, leaves=(), **options):
        """Runs, and expects one clear line, the exit code, and nothing in self.folder but what was there or `leaves`."""
        before = {str(p) for p in self.folder.rglob("*")}
        done = run(*arguments, **options)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertEqual(len(done.stderr.strip().splitlines()), 1 if code == 1 else 2, done.stderr)
        self.assertTrue(done.stderr.startswith("retrace: "), done.stderr)
        self.assertIn(says, done.stderr)
        after = {str(p) for p in self.folder.rglob("*")}
        self.assertEqual(after - before - {str(self.folder / name) for name in leaves}, set())

    # ---- the road ----

    def test_names_that_are_no_utf8_are_names(self):
        walk = os.fsencode(self.folder) + b"/caf\xe9"
        shutil.copytree(os.fsencode(self.walks.query), walk)
        run, route = self.folder / "run", self.folder / "route.db"
        for arguments in (["localise", os.fsdecode(walk), "--route", self.walks.route, "-o", run],
                          ["build", os.fsdecode(walk), "-o", route], ["inspect", route, "--json"]):
            done = subprocess.run([RETRACE, *map(str, arguments)], capture_output=True, timeout=600)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("caf\N{REPLACEMENT CHARACTER}", json.loads((run / "summary.json").read_text())["query"])
        self.assertEqual(json.loads(done.stdout)["traverses"][0]["source"], "caf\N{REPLACEMENT CHARACTER}")

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

    def test_finds_the_walk_and_writes_the_contract_s_files(self):
        found = rows(self.walks.run / "matches.csv")
        self.assertEqual(list(found[0]), MATCH_COLUMNS + NAMES)
        frames = [int(row["query_frame"]) for row in found]
        self.assertEqual(frames, sorted(set(frames)))
        keyframes = json.loads(check("inspect", self.walks.route, "--json"))["traverses"][0]["keyframe"]
        spacing = (self.walks.reference_at[-1] - self.walks.reference_at[0]) / len(keyframes)
        accepted = [row for row in found if row["accepted"] == "1"]
        close = 0
        for row in accepted:
            at = self.walks.reference_at[int(row["reference_frame"])]
            self.assertAlmostEqual(float(row["reference_distance_m"]), at * 0.01, places=4)
            # Sampling leaves up to one keyframe between neighbours of both walks, the search may add one.
            close += abs(at - self.walks.query_at[int(row["query_frame"])]) <= 2 * spacing
        self.assertGreaterEqual(close, 0.95 * len(accepted))
        self.assertGreater(sum(row["accepted"] == "1" for row in found), 0.8 * len(found))
        for name in ("trajectory.tum", "summary.json", "report.html", "report_data.json", "config.toml", "cost_matrix.png"):
            self.assertGreater((self.walks.run / name).stat().st_size, 0, name)
        poses = [line.split() for line in (self.walks.run / "trajectory.tum").read_text().splitlines() if line[0] != "#"]
        self.assertEqual(len(poses), sum(row["accepted"] == "1" for row in found))
        self.assertEqual({len(pose) for pose in poses}, {8})

    def test_evaluates_by_distances_and_by_landmarks(self):
        run_folder = self.folder / "run"
        shutil.copytree(self.walks.run, run_folder)
        check("evaluate", run_folder, "--query-truth", self.walks.query_truth, "--reference-truth",
              self.walks.reference_truth, "--tolerance-m", "0.4")
        metrics = read_json(run_folder / "metrics.json")
        for key in ("queries", "with_truth", "max_f1", "max_f1_threshold", "precision", "recall", "auc_pr",
                    "recall_at_100_precision", "recall_at_1", "accepted", "calibration_error"):
            self.assertIn(key, metrics)
        self.assertGreaterEqual(metrics["max_f1"], 0.9)
        curve = rows(run_folder / "pr.csv")
        best = max(curve, key=lambda row: float(row["f1"]))
        self.assertAlmostEqual(float(best["f1"]), metrics["max_f1"], places=6)
        self.assertIn("Max-F1", (run_folder / "report.html").read_text())

        # Landmarks on the first half only: later queries have no true place, and accepted ones are false positives.
        pairs = self.folder / "pairs.csv"
        pairs.write_text("query_frame,reference_frame\n0,0\n150,300\n")
        check("evaluate", run_folder, "--pairs", pairs, "--tolerance-frames", "15")
        metrics = read_json(run_folder / "metrics.json")
        inside = sum(int(row["query_frame"]) <= 150 for row in rows(run_folder / "matches.csv"))
        self.assertEqual(metrics["with_truth"], inside)
        self.assertLess(metrics["accepted"]["precision"], 0.6)

    def test_the_demo_shows_that_speed_does_not_matter(self):
        demo = self.folder / "demo"
        result = json.loads(check("demo", "-o", demo, "--length-m", "25", "--json"))
        self.assertGreater(result["normalised"]["max_f1"], result["vanilla"]["max_f1"] + 0.2)
        self.assertLess(result["normalised"]["median_error_m"], 1)
        for name in ("overview.png", "route.db", "day/truth.csv", "day/walk.mp4", "night/walk.mp4", "normalised/report.html",
                     "vanilla/matches.csv"):
            self.assertGreater((demo / name).stat().st_size, 0, name)
        self.refused("demo", "-o", demo, says="--force")

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
        self.refused("evaluate-odometry", out, "--kitti-poses", kitti, "--truth", kitti, says="--kitti-poses", code=2)
        (out / "visual_odometry.csv").unlink()
        self.refused("evaluate-odometry", out, "--kitti-poses", kitti, says="visual_odometry.csv: does not exist")

    def test_corrects_drift_on_a_route_with_a_gps_track(self):
        check("simulate", "--scene", "corridor", "--length-m", "25", "--seed", "2", "-o", self.folder / "walk")
        video_file, truth = self.folder / "walk" / "walk.mp4", rows(self.folder / "walk" / "truth.csv")
        # Degrees at 46 N as long as tables have them: 111147 m and 77466 m.
        track = self.folder / "track.csv"
        track.write_text("time_s,lat_deg,lon_deg\n" + "".join(
            f"{row['time_s']},{46 + float(row['y_m']) / 111147:.9f},{7 + float(row['x_m']) / 77466:.9f}\n" for row in truth))
        route, out = self.folder / "route.db", self.folder / "run"
        check("build", video_file, "-o", route, "--track", track)
        dated = self.folder / "dated.mp4"
        subprocess.run(["ffmpeg", "-v", "error", "-i", str(video_file), "-c", "copy", "-metadata",
                        "creation_time=2024-05-01T10:01:00Z", str(dated)], check=True)
        video_file = dated
        localise = ("localise", video_file, "--route", route, "--step-length", "0.75", "--sequence-length", "6")
        check(*localise, "-o", out)
        corrected = rows(out / "trajectory.csv")
        self.assertEqual(list(corrected[0])[:11], ["query_frame", "time_s", "x_m", "y_m", "heading_deg", "cov_xx_m2", "cov_xy_m2",
                                                   "cov_yy_m2", "heading_sd_deg", "distance_m", "lateral_m"])
        matches = rows(out / "matches.csv")
        self.assertEqual([row["query_frame"] for row in corrected], [row["query_frame"] for row in matches])
        first = truth[0]
        for row in corrected:
            true = truth[int(row["query_frame"])]
            # The walk is found on itself, so that half a keyframe's way is left, and the track's headings at its ends.
            self.assertAlmostEqual(float(row["x_m"]), float(true["x_m"]) - float(first["x_m"]), delta=0.6)
            self.assertAlmostEqual(float(row["y_m"]), float(true["y_m"]) - float(first["y_m"]), delta=0.6)
        for name in ("trajectory.tum", "trajectory_odometry.tum"):
            poses = [line for line in (out / name).read_text().splitlines() if line[0] != "#"]
            self.assertEqual(len(poses), len(corrected))
        line = read_json(out / "trajectory.geojson")["geometry"]["coordinates"]
        self.assertEqual(len(line), len(corrected))
        self.assertAlmostEqual(line[-1][1], 46 + float(truth[-1]["y_m"]) / 111147, delta=1e-5)
        self.assertEqual((out / "trajectory.gpx").read_text().count("<trkpt"), len(corrected))
        self.assertIn("<time>2024-05-01T10:01:0", (out / "trajectory.gpx").read_text())
        self.assertTrue(read_json(out / "summary.json")["drift"]["corrected"])
        told = read_json(out / "trajectory.geojson")["properties"]["probability"]
        for probability, row in zip(told, matches):
            self.assertEqual(probability is None, row["probability"] == "")
            if probability is not None:
                self.assertAlmostEqual(probability, float(row["probability"]), delta=1e-4)

        # From the files again, the same; from other odometry, as good; without, the matches' poses.
        before = (out / "trajectory.csv").read_bytes()
        check("correct", out, "--route", route)
        for a, b in zip(corrected, rows(out / "trajectory.csv")):
            self.assertAlmostEqual(float(a["x_m"]), float(b["x_m"]), delta=0.01)  # six decimals of odometry
        check("odometry", video_file, "-o", self.folder / "odometry", "--close-loops")
        self.assertEqual(read_json(self.folder / "odometry" / "summary.json")["loops"]["keyframes"], 0)
        check("correct", out, "--route", route, "--odometry", self.folder / "odometry" / "trajectory.tum")
        self.assertNotEqual(before, (out / "trajectory.csv").read_bytes())
        self.assertAlmostEqual(float(rows(out / "trajectory.csv")[-1]["x_m"]), float(corrected[-1]["x_m"]), delta=0.3)
        self.refused(*localise, "-o", out, "--force", "--correct-drift", "false", says="step-length: has no effect")
        check("localise", video_file, "--route", route, "--sequence-length", "6", "-o", out, "--force", "--correct-drift", "false")
        self.assertFalse((out / "trajectory.csv").exists())
        self.assertFalse(read_json(out / "summary.json")["drift"]["corrected"])
        # Without correction, maps have the places of the accepted matches.
        accepted = [row for row in rows(out / "matches.csv") if row["accepted"] == "1"]
        self.assertEqual(len(read_json(out / "trajectory.geojson")["geometry"]["coordinates"]), len(accepted))
        self.assertEqual((out / "trajectory.gpx").read_text().count("<trkpt"), len(accepted))
        (self.folder / "short.tum").write_text("0 0 0 0 0 0 0 1\n")
        self.refused("correct", out, "--route", route, "--odometry", self.folder / "short.tum", says="short.tum: has no pose at")
        self.refused("correct", out, "--route", self.walks.route, says="is not on the route")

    def grey_pictures(self, path, crop, size):
        """All pictures of a video: a part of each, in grey, scaled to a size."""
        width, height = size
        raw = subprocess.run(["ffmpeg", "-v", "error", "-i", str(path), "-vf", f"crop={crop},scale={width}:{height}",
                              "-pix_fmt", "gray", "-f", "rawvideo", "-"], capture_output=True, check=True).stdout
        return [raw[at:at + width * height] for at in range(0, len(raw), width * height)]

    def test_a_video_shows_the_query_and_below_it_the_reference(self):
        # Pictures of 96x48 become 192x96: the query at the top, the reference from row 96 on.
        side = self.folder / "side.mp4"
        self.assertIn("740 frames at 30 frames/s", check("video", self.walks.run, "-o", side, "--width-px", "192"))
        shown = self.grey_pictures(side, "192:96:0:96", (96, 48))
        self.assertEqual(len(shown), 740)
        above = self.grey_pictures(side, "192:96:0:0", (96, 48))

        def difference(picture, folder, frame):
            # Rows that no caption covers.
            drawn = (folder / f"{frame}.pgm").read_bytes()[-96 * 48:]
            return sum(abs(a - b) for a, b in zip(picture[96 * 14:96 * 46:3], drawn[96 * 14:96 * 46:3]))

        def most_alike(picture, folder, frames):
            differences = {frame: difference(picture, folder, frame) for frame in frames}
            return [frame for frame in frames if differences[frame] == min(differences.values())]  # the wall may stand still

        found = [row for row in rows(self.walks.run / "matches.csv") if row["accepted"] == "1"]
        for row in found[3:-3:max(1, len(found) // 8)]:
            query, reference = int(row["query_frame"]), int(row["reference_frame"])
            self.assertIn(reference, most_alike(shown[query], self.walks.reference,
                                                range(max(0, reference - 40), min(600, reference + 40))))
            self.assertIn(query, most_alike(above[query], self.walks.query, range(max(0, query - 20), min(740, query + 20))))

        # Half way between two matches in succession, the reference is half way too: the walls pass at one speed there.
        pairs = [(a, b) for a, b in zip(found[3:-3], found[4:-3])
                 if 6 < int(b["reference_frame"]) - int(a["reference_frame"]) < 40]
        self.assertTrue(pairs)
        for a, b in pairs[::max(1, len(pairs) // 5)]:
            first, last = int(a["reference_frame"]), int(b["reference_frame"])
            middle = (int(a["query_frame"]) + int(b["query_frame"])) // 2
            best = statistics.mean(most_alike(shown[middle], self.walks.reference, range(first, last + 1)))
            # Its displacement is known to a frame or so; a middle of two frames is rounded, and the wall's pixels are whole.
            self.assertAlmostEqual(best, (first + last) / 2, delta=3)

    def test_a_video_says_where_the_walk_is_off_the_route(self):
        run_folder = self.folder / "run"
        shutil.copytree(self.walks.run, run_folder)
        lines = (run_folder / "matches.csv").read_text().splitlines()
        edited, refused = lines[:1], []
        for i, line in enumerate(lines[1:]):
            cells = line.split(",")
            if 10 <= i < 20:
                cells[MATCH_COLUMNS.index("accepted")] = "0"
                refused.append(int(cells[0]))
            edited.append(",".join(cells))
        (run_folder / "matches.csv").write_text("\n".join(edited) + "\n")
        side = self.folder / "side.mp4"
        check("video", run_folder, "-o", side, "--width-px", "192")
        shown = self.grey_pictures(side, "192:96:0:96", (96, 48))
        accepted = [int(row["query_frame"]) for row in rows(run_folder / "matches.csv") if row["accepted"] == "1"]
        for query in refused:
            self.assertLess(statistics.mean(shown[query]), 60, query)
        for query in accepted:
            self.assertGreater(statistics.mean(shown[query]), 90, query)

        # Without the recording, the route's previews; blinking, the query itself every other half second.
        elsewhere = self.folder / "elsewhere"
        elsewhere.mkdir()
        shutil.copy(self.walks.route, elsewhere / "route.db")
        done = run("video", run_folder, "-o", side, "--force", "--route", elsewhere / "route.db", "--width-px", "192", "--blink")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("--reference FILE says where it is", done.stderr)
        blinking = self.grey_pictures(side, "192:96:0:96", (96, 48))
        above = self.grey_pictures(side, "192:96:0:0", (96, 48))
        self.assertEqual(len(blinking), 740)
        for query in accepted[::5]:
            apart = statistics.mean(abs(a - b) for a, b in zip(blinking[query][96 * 14:], above[query][96 * 14:]))
            (self.assertLess if query // 15 % 2 == 1 else self.assertGreater)(apart, 8, query)

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

    def test_says_what_it_saw_where_a_walk_is_not_found(self):
        # The wrong route, and the walk and the route swapped.
        other = draw_walk(self.folder / "other", street(seed=9), positions([1.5] * 400))
        run_folder = self.folder / "run"
        done = run("localise", other, "--route", self.walks.route, "-o", run_folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("keyframes accepted", done.stderr)
        self.assertIn("another route", done.stderr)
        self.assertIn("retrace doctor", "".join(read_json(run_folder / "summary.json")["warnings"]))
        self.assertNotIn("retrace doctor", "".join(read_json(self.walks.run / "summary.json")["warnings"]))
        for command in (("localise", "-o", self.folder / "swapped"), ("follow",)):
            self.refused(command[0], self.walks.route, "--route", self.walks.query, *command[1:], says="expected the two swapped")

    def test_a_route_goes_through_a_folder_and_back(self):
        folder, back = self.folder / "folder", self.folder / "back.db"
        check("inspect", self.walks.route, "--export", folder)
        keyframes = json.loads(check("inspect", self.walks.route, "--json"))["traverses"][0]["keyframe"]
        written = rows(folder / "traverse-1" / "keyframes.csv")
        self.assertEqual([int(row["frame"]) for row in written], [keyframe["frame"] for keyframe in keyframes])
        self.assertEqual([float(row["distance_m"]) for row in written], [keyframe["distance_m"] for keyframe in keyframes])
        self.assertEqual(len(list((folder / "traverse-1").glob("preview-*.jpg"))), len(written))
        self.assertIn("1 traverse", check("build", "--import", folder, "-o", back))
        self.assertEqual(back.read_bytes(), self.walks.route.read_bytes())
        self.refused("inspect", self.walks.route, "--export", folder, says="is there already")
        self.refused("build", "--import", folder, "-o", back, says="--force")
        self.refused("build", "--import", folder, "-o", self.folder / "new.db", "--every", "3", "--motion", "none",
                     says="--import: leaves no choice")
        self.refused("build", "-o", self.folder / "new.db", says="walk: is missing")
        (folder / "traverse-1" / "descriptors-1.npy").unlink()
        self.refused("build", "--import", folder, "-o", self.folder / "new.db", says="descriptors-1.npy: cannot be read")

    def test_refuses_videos_it_cannot_make(self):
        side = self.folder / "side.mp4"
        video_of_it = ("video", self.walks.run, "-o", side)
        self.refused(*video_of_it, "--query", self.walks.reference, says="has 600 frames; expected the walk of the run, with 740")
        self.refused(*video_of_it, "--reference", self.walks.query, says="has 740 frames or more; expected the walk of the run, with 600")
        self.refused(*video_of_it, "--warp", says="--warp: has no effect; expected a run of `localise --verify 7`")
        self.refused("video", self.walks.run, "-o", self.folder / "side.txt", says="expected a name ending in .mp4")
        self.refused("video", self.folder / "none", "-o", side, says="matches.csv: does not exist")
        self.refused("video", self.walks.run, "-o", self.folder / "none" / "side.mp4", says="is no folder")
        side.write_text("before")
        self.refused(*video_of_it, says="--force")
        self.assertEqual(side.read_text(), "before")

    def test_refuses_odometry_it_cannot_do(self):
        walk = ("odometry", self.walks.query, "-o", self.folder / "out")
        self.refused(*walk, "--frame-rate-hz", "7", says="7 frames/s, too few to see steps; expected more than 8", leaves=("out",))
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

    def test_a_second_traverse_joins_the_route(self):
        route = self.folder / "route.db"
        shutil.copy(self.walks.route, route)
        check("build", self.walks.query, "-o", route, "--name", "evening")
        self.refused("build", self.walks.query, "-o", route, "--name", "evening", says="already has a traverse 'evening'")
        check("build", self.walks.query, "-o", route, "--name", "evening", "--force")
        names = [t["name"] for t in json.loads(check("inspect", route, "--json"))["traverses"]]
        self.assertEqual(names, ["reference", "evening"])
        check("localise", self.walks.query, "--route", route, "-o", self.folder / "run")
        found = rows(self.folder / "run" / "matches.csv")
        self.assertGreater(sum(row["traverse"] == "evening" for row in found), 0.5 * len(found))

    def test_same_bytes_for_any_number_of_threads(self):
        files = {}
        for threads in ("1", "2"):
            route, out = self.folder / f"route{threads}.db", self.folder / f"run{threads}"
            check("build", self.walks.reference, "-o", route, "--threads", threads)
            check("localise", self.walks.query, "--route", route, "-o", out, "--threads", threads, "--save-matrices")
            files[threads] = {name: (out / name).read_bytes() for name in
                              ("matches.csv", "trajectory.tum", "cost_matrix.png", "D.csv", "DD.csv")}
            files[threads]["route"] = route.read_bytes()
        self.assertEqual(files["1"], files["2"])

    def test_openseqslam_mode_leaves_the_ends_unmatched(self):
        route = self.folder / "route.db"
        check("build", self.walks.reference, "-o", route, "--motion", "none", "--every", "6")
        check("localise", self.walks.query, "--route", route, "-o", self.folder / "run", "--compat", "openseqslam")
        found = rows(self.folder / "run" / "matches.csv")
        unmatched = [i for i, row in enumerate(found) if row["reference_frame"] == ""]
        self.assertEqual(unmatched, [0, 1, 2, 3, 4] + [len(found) - k for k in (5, 4, 3, 2, 1)])
        self.assertTrue(all(found[i]["accepted"] == "0" for i in unmatched))

    def test_inspect_shows_text_and_json(self):
        text = check("inspect", self.walks.route)
        for part in ("traverse 'reference'", "600 frames of 96x48 px", "poses from reference.csv", "motion=sad",
                     "described by blocks, 1024 bytes a keyframe"):
            self.assertIn(part, text)
        self.assertEqual(json.loads(check("inspect", self.walks.route, "--json"))["traverses"][0]["descriptor_bytes"], 1024)

    # ---- videos ----

    def test_reads_video_with_its_own_times_and_rotation(self):
        # Two seconds at 30 frames/s, then half as many for the rest: index / rate would be wrong by seconds.
        path = video(self.walks.reference, self.folder / "vfr.mkv", "-vf",
                     "setpts='if(lt(N,60),N/30,2+(N-60)/15)/TB'", "-fps_mode", "vfr")
        check("build", path, "-o", self.folder / "route.db")
        keyframes = json.loads(check("inspect", self.folder / "route.db", "--json"))["traverses"][0]["keyframe"]
        for keyframe in keyframes:
            n = keyframe["frame"]
            self.assertAlmostEqual(keyframe["time_s"], n / 30 if n < 60 else 2 + (n - 60) / 15, delta=1 / 15)  # ffmpeg may drop one frame at the change
        upright = video(self.walks.reference, self.folder / "plain.mp4")
        turned = self.folder / "turned.mp4"
        subprocess.run(["ffmpeg", "-v", "error", "-i", upright, "-c", "copy", "-metadata:s:v", "rotate=90", turned], check=True)
        check("build", turned, "-o", self.folder / "turned.db")
        self.assertIn("48x96 px", check("inspect", self.folder / "turned.db"))

    def test_a_video_that_breaks_off_gives_what_it_has(self):
        whole = video(self.walks.reference, self.folder / "whole.avi")
        cut = self.folder / "cut.avi"
        cut.write_bytes(whole.read_bytes()[:int(whole.stat().st_size * 0.6)])
        done = run("build", cut, "-o", self.folder / "route.db")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, r"cut.avi: breaks off: \d+ of 600 frames could be read")

    # ---- bad input ----

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

    def test_refuses_settings_that_are_wrong(self):
        config = self.folder / "my.toml"
        build = ("build", self.walks.reference, "-o", self.folder / "route.db", "--config", config)
        for text, says in (("sequnce-length = 5\n", "my.toml: sequnce-length: is no setting; expected sequence-length?"),
                           ("sampling-n = 3\nsampling-n = 4\n", "my.toml: sampling-n: stands there twice"),
                           ("sampling-n = \"many\"\n", "my.toml: sampling-n: "),
                           ("thumbnail-width = 3\n", "my.toml: thumbnail-width: "),
                           ("motion = \"steam\"\n", "my.toml: motion: ")):
            config.write_text(text)
            self.refused(*build, says=says)
        self.refused("build", self.walks.reference, "-o", self.folder / "route.db", "--config", self.folder / "none.toml",
                     says="none.toml: is no file")
        self.refused("build", self.walks.reference, "-o", self.folder / "route.db", "--samplin-n", "3",
                     says="did you mean --sampling-n?", code=2)
        self.refused("biuld", says="did you mean build?", code=2)
        self.refused("localise", self.walks.query, "--route", self.walks.route, says="--output is required", code=2)

    def test_flags_come_on_top_of_the_file_and_the_run_can_be_repeated(self):
        config = self.folder / "my.toml"
        config.write_text("# a comment\nsequence-length = 7\nenhance = \"local\"\nsampling-n = 6\n")
        first = self.folder / "first"
        check("localise", self.walks.query, "--route", self.walks.route, "-o", first, "--config", config, "--enhance", "none")
        saved = (first / "config.toml").read_text()
        self.assertIn("sequence-length = 7\n", saved)
        self.assertIn('enhance = "none"\n', saved)
        second = self.folder / "second"
        check("localise", self.walks.query, "--route", self.walks.route, "-o", second, "--config", first / "config.toml")
        self.assertEqual((first / "matches.csv").read_bytes(), (second / "matches.csv").read_bytes())
        self.assertEqual(saved, (second / "config.toml").read_text())

    def test_the_default_configuration_changes_nothing(self):
        default = SOURCE / "configs" / "default.toml"
        for motion in ("sad", "none"):
            for name, extra in (("plain", ()), ("config", ("--config", default))):
                check("build", self.walks.reference, "-o", self.folder / f"{name}.db", "--name", "a", "--motion", motion, "--force", *extra)
                check("localise", self.walks.query, "--route", self.folder / f"{name}.db", "-o", self.folder / name, "--force", *extra)
            self.assertEqual((self.folder / "plain.db").read_bytes(), (self.folder / "config.db").read_bytes())
            for file in ("matches.csv", "config.toml", "trajectory.tum"):
                self.assertEqual((self.folder / "plain" / file).read_bytes(), (self.folder / "config" / file).read_bytes(), file)

    def test_automatic_motion_is_alignment_error_where_no_gait_shows(self):
        route, run_folder = self.folder / "auto.db", self.folder / "run"
        said = json.loads(check("build", self.walks.reference, "-o", route, "--truth", self.walks.reference_truth,
                                "--motion", "auto", "--json"))
        self.assertEqual((said["motion"], said["gait_share"]), ("sad", 0))
        self.assertIn("motion: sad", check("build", self.walks.reference, "-o", self.folder / "b.db", "--motion", "auto"))
        check("localise", self.walks.query, "--route", route, "-o", run_folder, "--motion", "auto")
        self.assertEqual(read_json(run_folder / "summary.json")["motion"], "sad")
        self.assertEqual((run_folder / "matches.csv").read_bytes(), (self.walks.run / "matches.csv").read_bytes())
        said = check("describe", self.walks.reference, "-o", self.folder / "a.npy", "--motion", "auto")
        self.assertIn("keyframes", said)
        self.refused("build", self.walks.reference, "-o", self.folder / "c.db", "--motion", "auto", "--spacing-m", 1,
                     says="shows no steps")

    def test_two_builds_at_once_lose_no_walk(self):
        route = self.folder / "both.db"
        builds = [subprocess.Popen([RETRACE, "build", str(self.walks.reference), "-o", str(route), "--name", name],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) for name in ("one", "two")]
        for process in builds:
            self.assertEqual(process.wait(), 0, process.stderr.read())
            process.stderr.close()
        self.assertEqual({t["name"] for t in json.loads(check("inspect", route, "--json"))["traverses"]}, {"one", "two"})

    def test_options_without_effect_are_refused(self):
        build = ("build", self.walks.reference, "-o", self.folder / "a.db")
        localise = ("localise", self.walks.query, "--route", self.walks.route, "-o", self.folder / "run")
        for command, options, says in (
                (build, ("--every", "4"), "every: has no effect: motion is sad"),
                (build, ("--motion", "hybrid", "--separations", "1"), "separations: has no effect: motion is hybrid"),
                (build, ("--fov-deg", "90"), "fov-deg: has no effect: motion is sad"),
                (localise, ("--compat", "openseqslam", "--search-range-rad", "0.2"), "search-range-rad: has no effect: compat is"),
                (localise, ("--sequence-length", "9", "--sequence-length-m", "3"), "sequence-length: has no effect"),
                (("odometry", self.walks.query, "-o", self.folder / "odometry"), ("--step-signal", "bounce", "--min-step-deg", "1"),
                 "min-step-deg: has no effect: step-signal is bounce")):
            self.refused(*command, *options, says=says)

    def test_looks_again_at_places_by_their_points(self):
        def drawn(name, *options):
            check("simulate", "-o", self.folder / name, "--length-m", "14", "--seed", "7", *options)
            return self.folder / name / "walk.mp4", rows(self.folder / name / "truth.csv")

        reference, _ = drawn("reference")
        query, truth = drawn("query", "--gait-seed", "2", "--lateral-m", "0.5", "--camera-yaw-deg", "10")
        route = self.folder / "points.db"
        check("build", reference, "-o", route, "--truth", self.folder / "reference" / "truth.csv",
              "--view-points", "true", "--fov-deg", "64.4")
        out = {}
        for name, options in (("unseen", ()), ("seen", ("--verify", "7", "--threads", "1")),
                              ("again", ("--verify", "7", "--threads", "2"))):
            out[name] = self.folder / name
            check("localise", query, "--route", route, "-o", out[name], *options)
        self.assertEqual((out["seen"] / "matches.csv").read_bytes(), (out["again"] / "matches.csv").read_bytes())
        found, unseen = rows(out["seen"] / "matches.csv"), rows(out["unseen"] / "matches.csv")
        for before, after in zip(unseen, found, strict=True):
            self.assertEqual([before[name] for name in MATCH_COLUMNS[:-3]], [after[name] for name in MATCH_COLUMNS[:-3]])
            self.assertEqual({before[name] for name in MATCH_COLUMNS[-3:]}, {""})
        aside = [float(row["lateral_m"]) for row in found if row["lateral_m"]]
        turned = [float(row["yaw_deg"]) for row in found if row["yaw_deg"]]
        self.assertGreater(len(aside), len(found) / 3)
        self.assertGreater(len(turned), len(found) / 2)
        self.assertLess(abs(statistics.median(aside) - 0.5), 0.2)
        self.assertLess(abs(statistics.median(turned) - 10), 3)  # both walkers' trunks swing by some 2 degrees

        def off(run):
            """Of the corrected trajectory, metres."""
            return statistics.median(math.hypot(float(row["x_m"]) - float(truth[int(row["query_frame"])]["x_m"]),
                                                float(row["y_m"]) - float(truth[int(row["query_frame"])]["y_m"]))
                                     for row in rows(run / "trajectory.csv"))
        self.assertLess(off(out["seen"]), 0.5 * off(out["unseen"]))
        # The matches say it all: corrected from the files, it is the same trajectory.
        before = (out["seen"] / "trajectory.csv").read_text()
        check("correct", out["seen"], "--route", route)
        self.assertLess(abs(off(out["seen"]) - off(out["again"])), 0.02)
        self.assertEqual(len((out["seen"] / "trajectory.csv").read_text().splitlines()), len(before.splitlines()))

        self.refused("localise", query, "--route", self.walks.route, "-o", self.folder / "run", "--verify", "3",
                     says="verify: is 3 and the route keeps no points of its keyframes; expected 0, or a route built with")
        self.refused("localise", query, "--route", route, "-o", self.folder / "run", "--view-points", "false",
                     says="view-points: is false and the route was built with true")

    def test_the_default_configuration_is_current(self):
        self.assertEqual((SOURCE / "configs" / "default.toml").read_text(), check("config"))
        for name in ("default",):
            check("localise", self.walks.query, "--route", self.walks.route, "-o", self.folder / name, "--sampling-n", "6",
                  "--config", SOURCE / "configs" / f"{name}.toml")

    # ---- what is left behind ----

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

    # ---- while walking ----

    def test_follows_a_walk_frame_by_frame(self):
        out = self.folder / "out"
        lines = check("follow", self.walks.query, "--route", self.walks.route, "-o", out, "--announce").splitlines()
        self.assertEqual((out / "follow.jsonl").read_text().splitlines(), lines)
        self.assertIn("data-kind=\"player\"", (out / "report.html").read_text())
        # What reads the runs of localise reads these.
        matches = rows(out / "matches.csv")
        self.assertEqual(list(matches[0]), MATCH_COLUMNS + NAMES)
        by_frame = {line["frame"]: line for line in map(json.loads, lines) if "state" in line}
        for row in matches:
            line = by_frame[int(row["query_frame"])]
            self.assertEqual(row["accepted"] == "1", line["state"] == "on_route")
            self.assertEqual(row["reference_frame"], str(line.get("reference_frame", "")))
        summary = read_json(out / "summary.json")
        self.assertEqual((summary["query_frames"], summary["queries"]), (len(by_frame), len(matches)))
        self.assertEqual(summary["accepted"], sum(row["accepted"] == "1" for row in matches))
        self.assertEqual(len([line for line in (out / "trajectory.tum").read_text().splitlines() if not line.startswith("#")]),
                         summary["accepted"])
        self.assertIn('descriptor = ', (out / "config.toml").read_text())
        page = (out / "report.html").read_bytes()
        found = json.loads(check("evaluate", out, "--query-truth", self.walks.query_truth, "--reference-truth",
                                 self.walks.reference_truth, "--tolerance-m", 0.48, "--json"))
        self.assertGreater(found["accepted"]["precision"], 0.9)
        self.assertEqual((out / "report.html").read_bytes(), page)
        self.assertTrue((out / "evaluation.html").exists())
        check("follow", self.walks.query, "--route", self.walks.route, "-o", out, "--lag-s", 1, "--force")
        surer = rows(out / "matches.csv")
        self.assertEqual([row["query_frame"] for row in surer], [row["query_frame"] for row in matches])
        # By now the first ones are known too.
        self.assertGreater(sum(row["accepted"] == "1" for row in surer), summary["accepted"])
        told = [json.loads(line) for line in lines]
        positions = [line for line in told if "state" in line]
        self.assertEqual([line["frame"] for line in positions], list(range(len(self.walks.query_at))))
        self.assertEqual(positions[0]["state"], "searching")
        events = [line["event"] for line in told if "event" in line]
        self.assertEqual((events[0], events[-1]), ("found", "end_of_route"))
        on_route = [line for line in positions if line["state"] == "on_route"]
        self.assertGreater(len(on_route), 0.8 * len(positions))
        near = 0
        for line in on_route:
            self.assertEqual(line["traverse"], "reference")
            for column in ("reference_frame", "distance_m", "sd_m", "probability", "x_m", "y_m", "heading_deg"):
                self.assertIn(column, line)
            # Half the width of a picture: walks change their speed by a factor of two, which is noticed on the way.
            near += abs(line["distance_m"] - 0.01 * self.walks.query_at[line["frame"]]) <= 0.48
        self.assertGreaterEqual(near, 0.95 * len(on_route))

    def test_says_the_names_of_places_in_passing(self):
        route, names = self.folder / "route.db", self.folder / "names.csv"
        names.write_text("distance_m,name\n4,\"bench, <script>\"\n2.5,bakery\n")
        check("build", self.walks.reference, "-o", route, "--truth", self.walks.reference_truth, "--places", names)
        told = json.loads(check("inspect", route, "--json"))["traverses"][0]["places"]
        self.assertEqual([(one["name"], one["distance_m"]) for one in told], [("bakery", 2.5), ("bench, <script>", 4)])
        for one in told:  # a pixel is a centimetre
            self.assertAlmostEqual(0.01 * self.walks.reference_at[one["frame"]], one["distance_m"], delta=0.03)
        self.assertIn("'bakery' at frame", check("inspect", route))
        lines = [json.loads(line) for line in check("follow", self.walks.query, "--route", route, "--announce").splitlines()]
        passing = [line for line in lines if line.get("event") == "passing"]
        self.assertEqual([line["name"] for line in passing], ["bakery", "bench, <script>"])
        for line in passing:
            self.assertLessEqual(abs(line["distance_m"]), 2)

        # localise names the nearest, in its file as it is written anywhere.
        check("localise", self.walks.query, "--route", route, "-o", self.folder / "named")
        matches = [row for row in rows(self.folder / "named" / "matches.csv") if row["reference_frame"]]
        self.assertEqual({row["nearest_place"] for row in matches}, {"bakery", "bench, <script>"})
        for row in matches:
            to = {"bakery": 2.5, "bench, <script>": 4}[row["nearest_place"]] - float(row["reference_distance_m"])
            self.assertAlmostEqual(float(row["nearest_place_m"]), to, delta=0.03)
            self.assertEqual(row["nearest_place"], "bakery" if float(row["reference_distance_m"]) < 3.25 else "bench, <script>")
        truth = ("--query-truth", self.walks.query_truth, "--reference-truth", self.walks.reference_truth, "--tolerance-m", 1)
        check("evaluate", self.folder / "named", *truth)  # which reads it

        # A second walk keeps them, and so does an exported route.
        check("build", self.walks.query, "-o", route, "--name", "evening")
        check("inspect", route, "--export", self.folder / "exported")
        check("build", "--import", self.folder / "exported", "-o", self.folder / "imported.db")
        self.assertIn("'bakery' at frame", check("inspect", self.folder / "imported.db"))

        self.refused("build", self.walks.query, "-o", self.folder / "new.db", "--places", names,
                     says="names.csv: line 2: gives a distance, and the walk has no surveyed distances")
        names.write_text("frame,name\n9999,x\n")
        self.refused("build", self.walks.query, "-o", self.folder / "new.db", "--places", names, says="line 2: names frame 9999")
        names.write_text("place,name\n1,x\n")
        self.refused("build", self.walks.query, "-o", self.folder / "new.db", "--places", names, says="frame,name or distance_m,name")

    def test_a_line_depends_on_no_later_frame(self):
        walk = video(self.walks.query, self.folder / "walk.mp4")
        all_of_it = check("follow", walk, "--route", self.walks.route, "--lag-s", "1").splitlines()
        y4m = subprocess.run(["ffmpeg", "-v", "error", "-i", walk, "-frames:v", "300", "-pix_fmt", "yuv420p", "-f", "yuv4mpegpipe", "-"],
                             capture_output=True, check=True).stdout
        done = subprocess.run([RETRACE, "follow", "-", "--route", str(self.walks.route), "--lag-s", "1", "--threads", "1"],
                              input=y4m, capture_output=True, check=True, timeout=600)
        some = done.stdout.decode().splitlines()
        self.assertEqual(len(some), 300)
        self.assertEqual(some, all_of_it[:300])

    def test_following_is_refused_where_it_cannot_be(self):
        self.refused("follow", self.folder / "none.mp4", "--route", self.walks.route, says="does not exist")
        self.refused("follow", self.walks.query, "--route", self.folder / "none.db", says="none.db")
        (self.folder / "out").mkdir()
        (self.folder / "out" / "follow.jsonl").write_text("")
        self.refused("follow", self.walks.query, "--route", self.walks.route, "-o", self.folder / "out", says="follow.jsonl")
        self.refused("follow", self.walks.query, "--route", self.walks.route, "--lag-s", "-1", says="--lag-s", code=2)

    # ---- descriptors ----

    def npy(self, path):
        """The type, shape and header length of a .npy file."""
        content = path.read_bytes()
        length = int.from_bytes(content[8:10], "little")
        header = content[10:10 + length].decode()
        shape = tuple(int(n) for n in re.search(r"'shape': \((\d+), (\d+)\)", header).groups())
        return re.search(r"'descr': '(.*?)'", header)[1], shape, len(content) - 10 - length

    def test_describes_keyframes_for_other_programs(self):
        for descriptor, kind, width, size in (("blocks", "<f4", 1024, 4), ("hog", "<f4", 5040, 4), ("thumbnail", "|u1", 2048, 1)):
            with self.subTest(descriptor=descriptor):
                file = self.folder / f"{descriptor}.npy"
                said = json.loads(check("describe", self.walks.reference, "-o", file, "--descriptor", descriptor, "--json"))
                frames = rows(f"{file}.csv")
                self.assertEqual(list(frames[0]), ["frame", "time_s"])
                self.assertEqual(self.npy(file), (kind, (len(frames), width), len(frames) * width * size))
                self.assertEqual((said["keyframes"], said["width"]), (len(frames), width))
                self.refused("describe", self.walks.reference, "-o", file, says="exists already")

    def test_finds_a_walk_by_a_file_of_descriptors(self):
        route, run_folder = self.folder / "file.db", self.folder / "run"
        for walk, name in ((self.walks.reference, "reference.npy"), (self.walks.query, "query.npy")):
            check("describe", walk, "-o", self.folder / name, "--descriptor", "thumbnail", "--motion", "none", "--every", 4)
        check("build", self.walks.reference, "-o", route, "--motion", "none", "--every", 8, "--truth", self.walks.reference_truth,
              "--descriptor", "file", "--descriptor-file", self.folder / "reference.npy", "--descriptor-metric", "l1")
        self.refused("localise", self.walks.query, "--route", route, "-o", run_folder, says="descriptor-file: is missing", leaves=("run",))
        check("localise", self.walks.query, "--route", route, "--descriptor-file", self.folder / "query.npy", "-o", run_folder,
              "--search", "lines", "--search-range-rad", 0.6)
        check("evaluate", run_folder, "--query-truth", self.walks.query_truth, "--reference-truth", self.walks.reference_truth,
              "--tolerance-m", 0.8)
        self.assertGreaterEqual(read_json(run_folder / "metrics.json")["max_f1"], 0.8)

    def test_a_route_has_one_descriptor_for_all_walks(self):
        route = self.folder / "hog.db"
        check("build", self.walks.reference, "-o", route, "--descriptor", "hog", "--preview-width-px", 0)
        self.refused("localise", self.walks.query, "--route", route, "-o", self.folder / "run", "--descriptor", "blocks",
                     says="descriptor: is blocks and the route was built with hog")
        self.refused("localise", self.walks.query, "--route", route, "-o", self.folder / "run", "--compat", "openseqslam",
                     says="was built without thumbnails", leaves=("run",))
        self.refused("build", self.walks.reference, "-o", self.folder / "other.db", "--descriptor", "surf",
                     says="'surf' is no descriptor; expected blocks, thumbnail")
        self.refused("build", self.walks.reference, "-o", self.folder / "other.db", "--layer", "conv_1", says="no effect")
        self.refused("build", self.walks.reference, "-o", self.folder / "other.db", "--descriptor", "network",
                     says="model: is missing")

    def test_several_descriptors_speak_together(self):
        route, run_folder = self.folder / "both.db", self.folder / "run"
        check("build", self.walks.reference, "-o", route, "--truth", self.walks.reference_truth, "--descriptor", "blocks+hog")
        check("localise", self.walks.query, "--route", route, "-o", run_folder)
        check("evaluate", run_folder, "--query-truth", self.walks.query_truth, "--reference-truth", self.walks.reference_truth,
              "--tolerance-m", 0.8)
        self.assertGreaterEqual(read_json(run_folder / "metrics.json")["max_f1"], 0.9)

    def test_sweeps_over_descriptors(self):
        self.sweep(self.folder / "sweep", "--motion", "sad", "--vary", "descriptor=thumbnail,hog")
        self.assertEqual({row["descriptor"] for row in rows(self.folder / "sweep/sweep.csv")}, {"thumbnail", "hog"})

    # ---- sweeps and comparisons ----

    def sweep(self, folder, *options):
        return check("sweep", self.walks.query, "--reference", self.walks.reference, "--query-truth", self.walks.query_truth,
                     "--reference-truth", self.walks.reference_truth, "--tolerance-m", 0.1, "-o", folder,
                     "--sequence-length", "5,10", "--search-range-rad", "0.1,0.3", *options)

    def test_a_sweep_s_cells_are_what_localise_and_evaluate_give(self):
        said = json.loads(self.sweep(self.folder / "sweep", "--motion", "sad,none", "--vary", "enhance=local,standardise", "--json"))
        cells = rows(self.folder / "sweep/sweep.csv")
        self.assertEqual(list(cells[0])[:4], ["motion", "sequence-length", "search-range-rad", "enhance"])
        self.assertEqual(len(cells), 16)
        best = max(cells, key=lambda cell: float(cell["max_f1"]))
        self.assertAlmostEqual(said["best"]["max_f1"], float(best["max_f1"]), places=6)
        for name in ("report.html", "heat_map.png"):
            self.assertGreater((self.folder / "sweep" / name).stat().st_size, 0, name)

        # The fixture's route was built with the defaults, which are the sweep's too.
        settings = {"sequence-length": "5", "search-range-rad": "0.3", "enhance": "local"}
        check("localise", self.walks.query, "--route", self.walks.route, "-o", self.folder / "run",
              *[f"--{name}={value}" for name, value in settings.items()])
        check("evaluate", self.folder / "run", "--query-truth", self.walks.query_truth, "--reference-truth",
              self.walks.reference_truth, "--tolerance-m", 0.1)
        metrics = read_json(self.folder / "run/metrics.json")
        cell = next(c for c in cells if c["motion"] == "sad" and all(c[name] == value for name, value in settings.items()))
        for name in ("max_f1", "precision", "recall", "auc_pr", "recall_at_1"):
            self.assertAlmostEqual(float(cell[name]), metrics[name], places=8)  # nine digits are written

        # Without motion, about as many keyframes as with it.
        counts = {c["motion"]: int(c["query_keyframes"]) + int(c["reference_keyframes"]) for c in cells}
        self.assertLess(abs(counts["none"] - counts["sad"]), 0.2 * counts["sad"])

    def test_a_sweep_compares_methods_at_equal_densities(self):
        said = json.loads(self.sweep(self.folder / "sweep", "--motion", "none,sad", "--equal-keyframes", "--vary",
                                     "enhance=local,standardise", "--compare", "motion,enhance", "--json"))
        self.assertEqual(said["methods"], read_json(self.folder / "sweep/methods.json"))
        cells = rows(self.folder / "sweep/sweep.csv")
        counts = [int(c["query_keyframes"]) + int(c["reference_keyframes"]) for c in cells]
        self.assertLess(max(counts) / min(counts), 1.05 / 0.99)
        self.assertEqual([m["method"] for m in said["methods"]],
                         [{"motion": m, "enhance": e} for m in ("none", "sad") for e in ("local", "standardise")])
        for method in said["methods"]:
            of_it = [float(c["max_f1"]) for c in cells if all(c[k] == v for k, v in method["method"].items())]
            self.assertAlmostEqual(method["best"]["max_f1"], max(of_it), places=8)
            low, high = method["best"]["max_f1_interval"]
            self.assertLessEqual(low, method["best"]["max_f1"] + 1e-9)
            self.assertLessEqual(method["best"]["max_f1"], high + 0.05)  # a resample seldom beats the walk by more
            self.assertEqual((method["default"]["sequence-length"], method["default"]["search-range-rad"]), ("10", "0.1"))
        # What is said of the density repeats the cell.
        best = next(m["best"] for m in said["methods"] if m["method"] == {"motion": "sad", "enhance": "local"})
        flags = [f"--{name}={best[name]}" for name in ("sequence-length", "search-range-rad", "enhance")]
        check("build", self.walks.reference, "-o", self.folder / "r.db", f"--{best['density']}")
        check("localise", self.walks.query, "--route", self.folder / "r.db", "-o", self.folder / "run", *flags)
        check("evaluate", self.folder / "run", "--query-truth", self.walks.query_truth, "--reference-truth",
              self.walks.reference_truth, "--tolerance-m", 0.1)
        self.assertAlmostEqual(read_json(self.folder / "run/metrics.json")["max_f1"], best["max_f1"], places=9)
        # What is there is not run again, and gives the same table.
        again = json.loads(self.sweep(self.folder / "sweep", "--motion", "none,sad", "--equal-keyframes", "--vary",
                                      "enhance=local,standardise", "--compare", "motion,enhance", "--json"))
        self.assertEqual(again["methods"], said["methods"])

    def test_a_sweep_goes_on_where_it_was_stopped(self):
        whole = self.folder / "whole"
        self.sweep(whole, "--threads", 1)
        expected = (whole / "sweep.csv").read_bytes()
        lines = expected.decode().splitlines(keepends=True)

        # What is there is kept, not worked out again; the rest is added.
        fields = lines[3].split(",")
        fields[lines[0].split(",").index("max_f1")] = "0.125"
        (whole / "sweep.csv").write_text("".join([lines[0], ",".join(fields), *lines[5:]]))
        self.sweep(whole)
        self.assertEqual((whole / "sweep.csv").read_text(), "".join([*lines[:3], ",".join(fields), *lines[4:]]))
        self.sweep(whole, "--force", "--threads", 2)
        self.assertEqual((whole / "sweep.csv").read_bytes(), expected)

        killed = self.folder / "killed"
        command = [RETRACE, "sweep", self.walks.query, "--reference", self.walks.reference, "--query-truth", self.walks.query_truth,
                   "--reference-truth", self.walks.reference_truth, "--tolerance-m", "0.1", "-o", killed,
                   "--sequence-length", "5,10", "--search-range-rad", "0.1,0.3"]
        for delay_s in (0.2, 0.6, 1.2):
            process = subprocess.Popen(list(map(str, command)), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(delay_s)
            process.send_signal(signal.SIGKILL)
            process.wait()
        self.sweep(killed)
        self.assertEqual((killed / "sweep.csv").read_bytes(), expected)

    def test_refuses_sweeps_it_cannot_do(self):
        sweep = ["sweep", self.walks.query, "--reference", self.walks.reference, "--query-truth", self.walks.query_truth,
                 "--reference-truth", self.walks.reference_truth, "--tolerance-m", 0.1, "-o", self.folder / "sweep"]
        for options, says in ((["--vary", "enhanse=local"], "enhance?"), (["--vary", "preview-width-px=32,64"], "cannot vary"),
                              (["--vary", "enhance"], "NAME=a,b,c"), (["--sequence-length", "0"], "expected 1 to 100000"),
                              (["--motion", "fast"], "fast"), (["--vary", "motion=sad"], "twice"),
                              (["--compare", "enhance"], "is not varied"),
                              (["--equal-keyframes", "--motion", "sad"], "has no effect"),
                              (["--sequence-length", "5", "--sequence-length-m", "5"], "one of both")):
            self.refused(*sweep, *options, says=says)
        self.refused(*sweep[:-4], "-o", self.folder / "sweep", says="tolerance", code=2)
        self.sweep(self.folder / "sweep", "--motion", "sad")
        before = (self.folder / "sweep/sweep.csv").read_bytes()
        self.refused(*sweep, "--motion", "sad", "--sampling-n", "7", says="holds another sweep")
        self.assertEqual((self.folder / "sweep/sweep.csv").read_bytes(), before)

    SWEPT = ("sweep.csv", "sweep.toml", "methods.json", "report.html", "heat_map.png")

    def same_files(self, one, other, names):
        for name in names:
            self.assertEqual((one / name).read_bytes(), (other / name).read_bytes(), name)
        self.assertEqual(sorted(path.name for path in one.iterdir()), sorted(path.name for path in other.iterdir()))

    def test_a_divided_sweep_gives_the_files_of_the_undivided_one(self):
        options = ("--motion", "none,sad", "--vary", "enhance=local,standardise", "--equal-keyframes", "--compare", "motion,enhance")
        whole, divided = self.folder / "whole", self.folder / "divided"
        self.sweep(whole, *options)
        command = ["sweep", self.walks.query, "--reference", self.walks.reference, "--query-truth", self.walks.query_truth,
                   "--reference-truth", self.walks.reference_truth, "--tolerance-m", 0.1, "-o", divided, "--sequence-length", "5,10",
                   "--search-range-rad", "0.1,0.3", *options]
        # Three processes at once, in any order; the last of them later.
        processes = [subprocess.Popen([RETRACE, *map(str, command), "--cell", f"{i}/3"], stdout=subprocess.DEVNULL,
                                      stderr=subprocess.DEVNULL) for i in (2, 1)]
        self.assertEqual([process.wait() for process in processes], [0, 0])
        done = sum(len(rows(path)) for path in (divided / "cells").iterdir())
        self.assertIn(done, (10, 11))  # of 16
        self.refused(*command, "--merge", says=f"{16 - done} of 16 cells are missing")
        self.assertFalse((divided / "sweep.csv").exists())
        said = json.loads(check(*command, "--cell", "3/3", "--json"))
        self.assertEqual(said, {"part": 3, "parts": 3, "cells": 16 - done, "of": 16})
        # What a part has is not done again, however the sweep is divided: an altered figure stays.
        part = divided / "cells" / "1-of-3.csv"
        before = part.read_text()
        part.write_text(re.sub(r"(\n[^,]*,[^,]*,[^,]*,[^,]*,\d+,\d+,[^,]*),[^,]*", r"\1,0.125", before, count=1))
        self.assertNotEqual(part.read_text(), before)
        altered = part.read_text()
        check(*command, "--cell", "1/3")
        self.assertEqual(part.read_text(), altered)
        part.write_text(before)
        check(*command, "--merge")
        self.same_files(whole, divided, self.SWEPT)

        self.refused(*command, "--cell", "4/3", says="1 <= I <= N")
        self.refused(*command, "--cell", "1/3", "--merge", says="--merge", code=2)
        self.refused(*command, "--cell", "1/3", "--force", says="another folder")
        self.refused(*command, "--sampling-n", "7", "--cell", "1/3", says="holds another sweep")

    def write_pairs(self, *more):
        folder = self.folder / "benchmark-of"
        folder.mkdir()
        names = {}
        for name in ("query", "reference"):
            (folder / name).symlink_to(getattr(self.walks, name))
            shutil.copy(getattr(self.walks, name + "_truth"), folder / f"{name}.csv")
        (folder / "landmarks.csv").write_text("query_frame,reference_frame\n0,0\n149,298\n")
        text = """[forth]
query = "query"
reference = "reference"
query-truth = "query.csv"
reference-truth = "reference.csv"
tolerance-m = 0.1

[back]
query = ["reference"]
reference = "query"
query-truth = "reference.csv"
reference-truth = "query.csv"
tolerance-m = 0.1
"""
        (folder / "pairs.toml").write_text(text + "".join(more))
        return folder / "pairs.toml"

    def test_sweeps_over_a_list_of_pairs_end_in_one_table(self):
        pairs = self.write_pairs()
        command = ["sweep", "--list", pairs, "--sequence-length", "5,10", "--search-range-rad", "0.1,0.3", "--motion", "none,sad"]
        whole = self.folder / "benchmark"
        said = check(*command, "-o", whole)
        self.assertIn("| motion | forth | back | mean rank |", said)
        # A pair's files are those of its own sweep.
        alone = self.folder / "alone"
        self.sweep(alone, "--motion", "none,sad")
        self.same_files(alone, whole / "forth", ("sweep.csv", "methods.json", "heat_map.png"))
        table = rows(whole / "benchmark.csv")
        self.assertEqual([(row["pair"], row["motion"]) for row in table],
                         [(pair, motion) for pair in ("forth", "back") for motion in ("none", "sad")])
        methods = read_json(whole / "forth/methods.json")
        for row, method in zip(table, methods):
            self.assertAlmostEqual(float(row["max_f1"]), method["best"]["max_f1"], places=8)
            self.assertEqual([float(row["max_f1_low"]), float(row["max_f1_high"])],
                             [float(f"{x:.9g}") for x in method["best"]["max_f1_interval"]])
            self.assertEqual(row["best_sequence-length"], method["best"]["sequence-length"])
        ranks = read_json(whole / "benchmark.json")["ranks"]
        for which, column in (("mean_rank_best", "max_f1"), ("mean_rank_default", "default_max_f1")):
            figures = [[float(row[column]) for row in table if row["pair"] == pair] for pair in ("forth", "back")]
            for i, rank in enumerate(ranks):
                one = [1 + sum(other > of[i] for other in of) + (of.count(of[i]) - 1) / 2 for of in figures]
                self.assertAlmostEqual(rank[which], sum(one) / 2)
        # Divided over both pairs, it gives the same.
        divided = self.folder / "divided"
        for part in (3, 1, 2):
            check(*command, "-o", divided, "--cell", f"{part}/3")
        check(*command, "-o", divided, "--merge")
        self.same_files(whole, divided, ("benchmark.csv", "benchmark.json", "report.html"))
        for pair in ("forth", "back"):
            self.same_files(whole / pair, divided / pair, self.SWEPT)

    def test_refuses_lists_of_pairs_it_cannot_read(self):
        good = self.write_pairs().read_text()
        for change, says in ((lambda t: t.replace("[back]", "[forth]"), "twice"), (lambda t: "query = \"a\"\n" + t, "above the first pair"),
                             (lambda t: t.replace("tolerance-m", "tolerance"), "tolerance: is no key"),
                             (lambda t: t.replace("reference = \"query\"\n", ""), "[back]: reference: is missing"),
                             (lambda t: t.replace("0.1", "near"), "a number of at least 0"),
                             (lambda t: t.replace("tolerance-m = 0.1\n\n", "tolerance-m = 0.1\ntolerance-frames = 3\n\n"), "one of tolerance-m"),
                             (lambda t: t.replace("[back]", "[a/b]"), "a folder's"), (lambda t: "", "has no pair"),
                             (lambda t: t.replace("reference.csv", "nothing.csv"), "nothing.csv")):
            path = self.folder / "benchmark-of" / "bad.toml"
            path.write_text(change(good))
            self.refused("sweep", "--list", path, "-o", self.folder / "bad", says=says)
        self.assertFalse((self.folder / "bad").exists())
        self.refused("sweep", "--list", path, "--tolerance-m", 1, "-o", self.folder / "bad", says="--list", code=2)
        self.refused("sweep", "-o", self.folder / "bad", says="query is required", code=2)

    def evaluated(self, name, *options, tolerance_m=0.05):
        check("localise", self.walks.query, "--route", self.walks.route, "-o", self.folder / name, *options)
        check("evaluate", self.folder / name, "--query-truth", self.walks.query_truth, "--reference-truth",
              self.walks.reference_truth, "--tolerance-m", tolerance_m)
        return self.folder / name

    def test_compares_runs(self):
        one, two = self.evaluated("one", "--sequence-length", 2), self.evaluated("two", "--enhance", "local")
        compare = ["compare", one, two, "--segment-s", 2, "--resamples", 500, "--json"]
        said = json.loads(check(*compare, "-o", self.folder / "a"))
        self.assertEqual(said, read_json(self.folder / "a/comparison.json"))
        for run, folder in zip(said["runs"], (one, two)):
            self.assertEqual(run["name"], folder.name)
            self.assertAlmostEqual(run["max_f1"], read_json(folder / "metrics.json")["max_f1"], places=9)
            low, high = run["max_f1_interval"]
            self.assertTrue(0 <= low < high <= 1)
        self.assertAlmostEqual(said["differences"][0]["max_f1_difference"], said["runs"][1]["max_f1"] - said["runs"][0]["max_f1"])
        self.assertEqual(said, json.loads(check(*compare, "--threads", 1, "-o", self.folder / "b")))
        self.assertNotEqual(said, json.loads(check(*compare, "--seed", 2, "-o", self.folder / "c")))

        # SSS Fig. 6 and 7: both matrices, the paths through them, and the keyframes on the route.
        page = (self.folder / "a/report.html").read_text()
        self.assertEqual(page.count('data-kind="matrix"'), 2)
        for title in ("share of the reference", "m along the route", "Cost matrices"):
            self.assertIn(title, page)

        other = self.evaluated("other", tolerance_m=0.1)
        self.refused("compare", one, other, "-o", self.folder / "d", says="tolerance of 0.1 metres", leaves=["d"])
        self.refused("compare", one, self.walks.run, "-o", self.folder / "e", says="retrace evaluate", leaves=["e"])
        self.refused("compare", one, two, "--names", "a", "-o", self.folder / "f", says="one for each run")
        self.refused("compare", one, "-o", self.folder / "g", says="2", code=2)

    def test_evaluate_says_where_each_query_truly_is(self):
        run = self.evaluated("run")
        known = 0
        for row in rows(run / "errors.csv"):
            at = self.walks.query_at[int(row["query_frame"])]
            if not row["true_frame"]:
                continue
            known += 1
            # The first frame of the reference that is as far.
            frame = int(float(row["true_frame"]))
            self.assertGreaterEqual(self.walks.reference_at[frame], at)
            self.assertTrue(frame == 0 or self.walks.reference_at[frame - 1] < at)
        self.assertGreater(known, 0.9 * len(rows(run / "errors.csv")))
        self.assertIn("as fixed sampling has it", (run / "report.html").read_text())

    def test_build_leaves_a_report_when_asked(self):
        build = ["build", self.walks.reference, "-o", self.folder / "route.db"]
        self.refused(*build, "--report", self.folder / "route.db", says="is the route itself")
        self.refused(*build, "--report", self.folder / "none" / "day.html", says="is no folder")
        page = self.folder / "day.html"
        check(*build, "--report", page)
        self.assertEqual({path.name for path in self.folder.iterdir() if "lock" not in path.name}, {"route.db", "day.html"})
        text = page.read_text()
        for title in ("Alignment error", "learned relation", "What stays and what passes by", "keyframes"):
            self.assertIn(title, text)
        self.assertEqual(text.count('class="picture"'), 3)  # 1, 5 and 10 frames apart
        self.refused(*build, "--name", "again", "--report", page, says="already exists")
        self.assertEqual(page.read_text(), text)
        self.refused("build", "--import", self.folder, "-o", self.folder / "b.db", "--report", self.folder / "b.html",
                     says="leaves no choice")

    # ---- the libraries ----

    def test_the_example_of_the_readme_finds_a_walk(self):
        check("simulate", "--scene", "corridor", "--length-m", "25", "--seed", "2", "-o", self.folder / "walk")
        walk, truth = self.folder / "walk" / "walk.mp4", self.folder / "walk" / "truth.csv"
        done = subprocess.run([os.environ["RETRACE_EXAMPLE"], walk, truth, walk, truth], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("max-F1 1.000", done.stdout)  # it is the same walk
        self.assertGreater((self.folder / "route.db").stat().st_size, 0)
        self.assertTrue((self.folder / "night.tum").exists())

    # ---- help ----

    def test_help_shows_units_defaults_and_examples(self):
        for command in ("build", "localise", "correct", "evaluate", "odometry", "evaluate-odometry", "inspect", "config"):
            text = check(command, "--help")
            self.assertIn("Example", text)
            self.assertIn(f"retrace {command}", text)
        self.assertRegex(check("localise", "--help"), r"--search-range-rad NUMBER=0\.1")
        self.assertRegex(check("--version"), r"^retrace \d+\.\d+\.\d+\n$")


if __name__ == "__main__":
    unittest.main(verbosity=2)
