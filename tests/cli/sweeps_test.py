#!/usr/bin/env python3
"""Sweeps over settings and over lists of pairs: whole, stopped and gone on with, and divided."""

import json
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.cli_test_case import CliTest  # noqa: E402
from support.retrace_cli import RETRACE, check, read_json, rows  # noqa: E402


class SweepsTest(CliTest):
    SWEPT = ("sweep.csv", "sweep.toml", "methods.json", "report.html", "heat_map.png")

    def sweep(self, folder, *options):
        return check("sweep", self.walks.query, "--reference", self.walks.reference, "--query-truth", self.walks.query_truth,
                     "--reference-truth", self.walks.reference_truth, "--tolerance-m", 0.1, "-o", folder,
                     "--sequence-length", "5,10", "--search-range-rad", "0.1,0.3", *options)

    def same_files(self, one, other, names):
        for name in names:
            self.assertEqual((one / name).read_bytes(), (other / name).read_bytes(), name)
        self.assertEqual(sorted(path.name for path in one.iterdir()), sorted(path.name for path in other.iterdir()))

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

    def test_sweeps_over_descriptors(self):
        self.sweep(self.folder / "sweep", "--motion", "sad", "--vary", "descriptor=thumbnail,hog")
        self.assertEqual({row["descriptor"] for row in rows(self.folder / "sweep/sweep.csv")}, {"thumbnail", "hog"})

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
        self.refused("sweep", self.folder / "none.mp4", "--reference", self.walks.reference, "--query-truth", self.walks.query_truth,
                     "--reference-truth", self.walks.reference_truth, "--tolerance-m", 0.1, "-o", whole, "--force", says="none.mp4")
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
                             (lambda t: t.replace("[back]", "[a/b]"), "a folder's"),
                             (lambda t: t.replace("[back]", "[back, again]"), "a folder's"),
                             (lambda t: t.replace("[back]", "[report.html]"), "a file of the benchmark"), (lambda t: "", "has no pair"),
                             (lambda t: t.replace("reference.csv", "nothing.csv"), "nothing.csv")):
            path = self.folder / "benchmark-of" / "bad.toml"
            path.write_text(change(good))
            self.refused("sweep", "--list", path, "-o", self.folder / "bad", says=says)
        self.assertFalse((self.folder / "bad").exists())
        self.refused("sweep", "--list", path, "--tolerance-m", 1, "-o", self.folder / "bad", says="--list", code=2)
        self.refused("sweep", "-o", self.folder / "bad", says="query is required", code=2)


if __name__ == "__main__":
    unittest.main(verbosity=2)
