#!/usr/bin/env python3
"""The published methods: every preset of configs/ is read by --config, does what it names, and hides no option without effect."""

import pathlib
import re
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.retrace_cli import SOURCE, check, read_json, run  # noqa: E402

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
                    self.assertRegex(line, r"# .*(\d|Eq\.)", f"{preset.name}: {line}")

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


if __name__ == "__main__":
    unittest.main(verbosity=2)
