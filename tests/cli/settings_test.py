#!/usr/bin/env python3
"""Settings: flags, files of settings, the defaults, and options that are refused."""

import json
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.cli_test_case import CliTest  # noqa: E402
from support.retrace_cli import SOURCE, check, read_json  # noqa: E402


class SettingsTest(CliTest):
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

    def test_the_default_configuration_is_current(self):
        self.assertEqual((SOURCE / "configs" / "default.toml").read_text(), check("config"))
        for name in ("default",):
            check("localise", self.walks.query, "--route", self.walks.route, "-o", self.folder / name, "--sampling-n", "6",
                  "--config", SOURCE / "configs" / f"{name}.toml")

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


if __name__ == "__main__":
    unittest.main(verbosity=2)
