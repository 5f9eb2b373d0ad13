#!/usr/bin/env python3
"""Places found: a walk is found on its route, its drift corrected, and the same bytes come out of any run."""

import json
import math
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.cli_test_case import CliTest, positions  # noqa: E402
from support.retrace_cli import MATCH_COLUMNS, NEAREST_COLUMNS, RETRACE, check, draw_walk, read_json, rows, run, street  # noqa: E402


class LocaliseTest(CliTest):
    def test_finds_the_walk_and_writes_the_contract_s_files(self):
        found = rows(self.walks.run / "matches.csv")
        self.assertEqual(list(found[0]), MATCH_COLUMNS + NEAREST_COLUMNS)
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


if __name__ == "__main__":
    unittest.main(verbosity=2)
