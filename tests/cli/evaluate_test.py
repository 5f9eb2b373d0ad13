#!/usr/bin/env python3
"""Runs measured against the truth, and compared with each other."""

import json
import pathlib
import shutil
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.cli_test_case import CliTest  # noqa: E402
from support.retrace_cli import check, read_json, rows  # noqa: E402


class EvaluateTest(CliTest):
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
        self.refused("evaluate", run_folder, "--pairs", pairs, "--reference-truth", self.walks.reference_truth,
                     "--tolerance-frames", 15, says="--reference-truth: has no effect")

    def evaluated(self, name, *options, tolerance_m=0.05):
        check("localise", self.walks.query, "--route", self.walks.route, "-o", self.folder / name, *options)
        check("evaluate", self.folder / name, "--query-truth", self.walks.query_truth, "--reference-truth",
              self.walks.reference_truth, "--tolerance-m", tolerance_m)
        return self.folder / name

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


if __name__ == "__main__":
    unittest.main(verbosity=2)
