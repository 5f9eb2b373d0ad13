#!/usr/bin/env python3
"""The published methods: every preset of configs/ is read by --config, does what it names, and hides no option without effect."""

import pathlib
import re
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.retrace_cli import SOURCE, check, read_json, rows, run  # noqa: E402

CONFIGS = SOURCE / "configs"


class PresetsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = pathlib.Path(tempfile.mkdtemp(prefix="retrace-presets-"))
        for name, seeds in (("day", ()), ("night", ("--condition", "night", "--gait-seed", "4"))):
            check("simulate", "--length-m", "25", "--width", "320", "--height", "180", *seeds, "-o", cls.made / name)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.made)

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="retrace-presets-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def test_every_setting_of_a_preset_says_where_it_comes_from(self):
        for preset in sorted(CONFIGS.glob("*.toml")):
            if preset.name == "default.toml":
                continue
            for line in preset.read_text(encoding="utf-8").splitlines():
                if re.match(r"[a-z-]+ =", line):
                    self.assertRegex(line, r"# .*(\d|SeqSLAM)", f"{preset.name}: {line}")

    def test_table_1_of_pvo_by_one_command(self):
        walk = self.made / "day"
        shown = check("sweep-odometry", walk / "walk.mp4", "--truth", walk / "truth.csv", "-o", self.folder / "table", "--config",
                      CONFIGS / "pvo.toml", "--step-length", "0.7", "--vary", "tracking-window=1,3", "--segment-m", "25")
        for column in ("E-P", "E-STD", "H-D", "H-STD"):
            self.assertIn(column, shown)
        table = {(row["tracking-window"], row["at_m"]): row for row in rows(self.folder / "table" / "odometry_sweep.csv")}
        self.assertEqual(set(table), {(window, at_m) for window in ("1", "3") for at_m in ("5", "10")})
        self.assertEqual(float(table["1", "10"]["e_p_pct"]), 0)
        one, three = table["1", "10"], table["3", "10"]
        # Three and six decimals in the file.
        self.assertAlmostEqual(float(three["e_p_pct"]), 100 * (1 - float(three["euclidean_error_m"]) / float(one["euclidean_error_m"])), places=2)
        self.assertAlmostEqual(float(three["h_std_deg"]), float(three["heading_error_sd_deg"]) - float(one["heading_error_sd_deg"]), places=2)
        done = run("sweep-odometry", walk / "walk.mp4", "--truth", walk / "truth.csv", "-o", self.folder / "b", "--vary", "enhance=local")
        self.assertEqual(done.returncode, 1)
        self.assertIn("enhance: cannot vary", done.stderr)

    def test_pvo_follows_a_walk(self):
        out, walk = self.folder / "out", self.made / "day"
        check("odometry", walk / "walk.mp4", "-o", out, "--config", CONFIGS / "pvo.toml", "--step-length", "0.7")
        summary = read_json(out / "summary.json")
        self.assertEqual(summary["step_signal"], "orientation by PVO")
        self.assertEqual(summary["steps_bridged"], 0)
        # One fixed step length: the trajectory's length is that of its steps.
        steps = len((out / "steps.csv").read_text().splitlines()) - 1
        self.assertAlmostEqual(summary["distance"], 0.7 * steps, places=3)
        check("evaluate-odometry", out, "--truth", walk / "truth.csv")
        config = (out / "config.toml").read_text()
        for line in ('heading = "naive"', 'step-length-model = "fixed"', 'step-signal = "pvo"', 'motion = "steps"'):
            self.assertIn(line, config)
        refused = run("odometry", walk / "walk.mp4", "-o", self.folder / "other", "--config", CONFIGS / "pvo.toml", "--spacing-m", "1")
        self.assertEqual(refused.returncode, 2)  # no option of that command
        refused = run("build", walk / "walk.mp4", "-o", self.folder / "a.db", "--config", CONFIGS / "pvo.toml", "--separations", "1")
        self.assertEqual(refused.returncode, 1)
        self.assertIn("separations: has no effect: motion is steps", refused.stderr)

    def found(self, preset, *build_options):
        """What a preset leaves of the night walk on the day's route: folder, matches, max-F1 and lines of its config.toml."""
        config, truth = CONFIGS / f"{preset}.toml", self.made / "day" / "truth.csv"
        route, out = self.folder / f"{preset}.db", self.folder / preset
        check("build", self.made / "day" / "walk.mp4", "-o", route, "--truth", truth, "--config", config, *build_options)
        check("localise", self.made / "night" / "walk.mp4", "--route", route, "-o", out, "--config", config)
        check("evaluate", out, "--query-truth", self.made / "night" / "truth.csv", "--reference-truth", truth, "--tolerance-m", "4")
        return rows(out / "matches.csv"), read_json(out / "metrics.json"), (out / "config.toml").read_text()

    def test_sss_finds_a_walk(self):
        matches, metrics, config = self.found("sss")
        for line in ('motion = "sad"', "separations = 1", "search-range-rad = 0.5", 'score = "ratio"', "min-fraction = 1",
                     'patch-shape = "window"', "tie-scale = false", 'search = "lines"', 'enhance = "local"', "max-speed = 1000"):
            self.assertIn(line + "\n", config)
        self.ends_have_no_match(matches, 10)
        self.assertTrue(all(0 <= float(row["score"]) <= 1 for row in matches if row["reference_frame"]))
        # The same run with the score named otherwise finds the same places.
        other = self.folder / "difference"
        check("localise", self.made / "night" / "walk.mp4", "--route", self.folder / "sss.db", "-o", other, "--config",
              CONFIGS / "sss.toml", "--score", "difference")
        self.assertEqual([row["reference_frame"] for row in rows(other / "matches.csv")], [row["reference_frame"] for row in matches])
        self.assertGreater(metrics["with_truth"], 0)

    def test_vanilla_finds_a_walk(self):
        matches, metrics, config = self.found("vanilla", "--every", "8")
        self.assertIn('motion = "none"\n', config)
        self.assertIn("every = 8\n", config)  # the route's
        self.ends_have_no_match(matches, 10)
        self.assertGreater(metrics["with_truth"], 0)

    def test_openseqslam_finds_a_walk(self):
        matches, metrics, config = self.found("openseqslam", "--every", "8")
        self.assertIn('compat = "openseqslam"\n', config)
        self.assertTrue(any(row["reference_frame"] for row in matches))
        self.assertGreater(metrics["with_truth"], 0)

    def ends_have_no_match(self, matches, length):
        """SeqSLAM has no match for the first and last half sequence, and one for every keyframe between."""
        has = [row["reference_frame"] != "" for row in matches]
        self.assertFalse(any(has[:length // 2]))
        self.assertFalse(any(has[len(has) - (length - 1) // 2:]))
        self.assertTrue(all(has[length // 2:len(has) - (length - 1) // 2]))

    def test_presets_excuse_no_option_without_effect(self):
        for preset, option, says in (("sss", ("--every", "4"), "every: has no effect: motion is sad"),
                                     ("vanilla", ("--sampling-n", "4"), "sampling-n: has no effect: motion is none"),
                                     ("openseqslam", ("--separations", "2"), "separations: has no effect: motion is none")):
            done = run("build", self.made / "day" / "walk.mp4", "-o", self.folder / "a.db", "--config", CONFIGS / f"{preset}.toml", *option)
            self.assertEqual(done.returncode, 1, preset)
            self.assertIn(says, done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
