#!/usr/bin/env python3
"""What retrace must reach on real and simulated walks, through its own command line. Prints a line for each.

Reads the folder that RETRACE_DATA names, or ../shared/data beside the source tree; without it, says so and is skipped.
"""

import os
import pathlib
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.retrace_cli import SOURCE, check, read_json, rows  # noqa: E402

DATA = pathlib.Path(os.environ.get("RETRACE_DATA", SOURCE.parent / "shared" / "data"))
SIM = DATA / "sim"


def sim_truth(reference, query):
    return ("--query-truth", SIM / f"{query}.csv", "--reference-truth", SIM / f"{reference}.csv", "--tolerance-m", 4)


class AccuracyTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="retrace-accuracy-"))
        cls.routes = {}

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def route(self, reference, *options):
        """The route of a walk, built once for each set of options."""
        key = (reference, options)
        if key not in self.routes:
            self.routes[key] = self.folder / f"{len(self.routes)}.db"
            check("build", reference, "-o", self.routes[key], *options)
        return self.routes[key]

    def metrics(self, reference, query, truth, build=(), localise=()):
        out = self.folder / "run"
        check("localise", query, "--route", self.route(reference, *build), "-o", out, "--force", *localise)
        check("evaluate", out, *truth)
        metrics = read_json(out / "metrics.json")
        print(f"\n  max-F1 {metrics['max_f1']:.3f}, recall@1 {metrics['recall_at_1']:.3f}, median error "
              f"{metrics['error']['p50']:.3g} {metrics['unit']}, {metrics['with_truth']}/{metrics['queries']} queries "
              f"| {pathlib.Path(reference).name} {' '.join(map(str, (*build, *localise)))}", end=" ", flush=True)
        return metrics

    def test_gopro_footpath(self):
        walks = DATA / "gopro_footpath"
        metrics = self.metrics(walks / "reference.mp4", walks / "query.mp4",
                               ("--pairs", walks / "pairs.csv", "--tolerance-frames", 17), (), ("--sequence-length", 10))
        self.assertGreaterEqual(metrics["max_f1"], 0.93)
        self.assertLessEqual(metrics["error"]["p50"] / 17, 0.25)  # 17 reference frames are a metre

    def test_nordland(self):
        walks = DATA / "nordland_64x32"
        truth = ("--pairs", walks / "pairs.csv", "--tolerance-frames", 2)
        for enhance, length, least in (("local", 10, 0.84), ("local", 20, 0.92), ("standardise", 10, 0.87), ("standardise", 20, 0.94)):
            with self.subTest(enhance=enhance, length=length):
                metrics = self.metrics(walks / "summer", walks / "winter", truth, ("--motion", "none", "--every", 1),
                                       ("--enhance", enhance, "--sequence-length", length))
                self.assertGreaterEqual(metrics["max_f1"], least)

    def test_corridor(self):
        walks = DATA / "corridor"
        for length, least in ((10, 0.85), (1, 0.55)):
            with self.subTest(length=length):
                metrics = self.metrics(walks / "reference", walks / "query",
                                       ("--pairs", walks / "pairs.csv", "--tolerance-frames", 2),
                                       ("--motion", "none", "--every", 1), ("--sequence-length", length))
                self.assertGreaterEqual(metrics["max_f1"], least)

    def test_street_by_day_and_night(self):
        day, night = SIM / "street_day.mp4", SIM / "street_night.mp4"
        truth = sim_truth("street_day", "street_night")
        search = ("--sequence-length", 20, "--search-range-rad", 0.1)
        fixed = self.metrics(day, night, truth, ("--motion", "none", "--every", 8), ("--enhance", "local", *search))
        self.assertLess(fixed["max_f1"], 0.1)
        local = self.metrics(day, night, truth, (), ("--enhance", "local", *search))
        self.assertGreaterEqual(local["max_f1"], 0.85)
        standardised = self.metrics(day, night, truth, (), ("--enhance", "standardise", *search))
        self.assertGreaterEqual(standardised["max_f1"], 0.99)

    def test_corridor_with_stops_and_passers_by(self):
        metrics = self.metrics(SIM / "corridor_a.mp4", SIM / "corridor_b.mp4", sim_truth("corridor_a", "corridor_b"))
        self.assertGreaterEqual(metrics["max_f1"], 0.98)

    # ---- pedestrian odometry ----

    def odometry(self, name):
        truth = rows(SIM / f"{name}.csv")
        out = self.folder / name
        step_length = float(truth[-1]["distance_m"]) / float(truth[-1]["steps"])
        check("odometry", SIM / f"{name}.mp4", "-o", out, "--force", "--step-length", step_length)
        check("evaluate-odometry", out, "--truth", SIM / f"{name}.csv")
        metrics = read_json(out / "odometry_metrics.json")
        errors = ", ".join(f"{at} m: {error:.2f}" for at, error in metrics["euclidean_error_m"].items() if error is not None)
        print(f"\n  {name}: {metrics['steps_estimated']} of {metrics['steps_true']} steps; error in metres after {errors}",
              end=" ", flush=True)
        return metrics

    def test_odometry_outdoors(self):
        metrics = self.odometry("street_day")
        self.assertLessEqual(abs(metrics["step_error_pct"]), 1)
        self.assertLessEqual(metrics["euclidean_error_m"]["25"], 2)
        self.assertLessEqual(metrics["euclidean_error_m"]["100"], 8)
        self.assertLessEqual(abs(self.odometry("run")["step_error_pct"]), 1)

    def test_odometry_by_night(self):
        metrics = self.odometry("street_night")
        self.assertLessEqual(abs(metrics["step_error_pct"]), 1)
        self.assertLessEqual(metrics["euclidean_error_m"]["100"], 8)

    def test_odometry_indoors(self):
        for name, step_error_pct in (("corridor_a", 1), ("corridor_b", 3)):
            metrics = self.odometry(name)
            self.assertLessEqual(abs(metrics["step_error_pct"]), step_error_pct)
            self.assertLessEqual(metrics["euclidean_error_m"]["50"], 4)

    def test_standing_is_no_step(self):
        self.odometry("stand_walk")
        truth = rows(SIM / "stand_walk.csv")
        for step in rows(self.folder / "stand_walk" / "steps.csv"):
            # Half a second either side, the time of a step, belongs to the walk.
            frame = int(step["frame"])
            before, after = truth[max(0, frame - 13)], truth[min(len(truth) - 1, frame + 13)]
            self.assertGreater(float(after["distance_m"]) - float(before["distance_m"]), 0.05, step)

    def test_steps_resample_as_well_as_alignment_error(self):
        for enhance in ("local", "standardise"):
            search = ("--sequence-length", "20", "--search-range-rad", "0.1", "--enhance", enhance)
            walks = (SIM / "street_day.mp4", SIM / "street_night.mp4", sim_truth("street_day", "street_night"))
            survey = ("--truth", SIM / "street_day.csv")
            by_steps = self.metrics(*walks, build=(*survey, "--motion", "steps"), localise=search)
            by_error = self.metrics(*walks, build=survey, localise=search)
            self.assertGreaterEqual(by_steps["max_f1"], by_error["max_f1"])


if __name__ == "__main__":
    if not DATA.is_dir():
        print(f"skipped: no data folder {DATA}; set RETRACE_DATA")
        sys.exit(77)
    unittest.main(verbosity=2)
