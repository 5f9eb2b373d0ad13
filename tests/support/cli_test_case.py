"""What the tests of tests/cli share: two walks along one wall, a folder for each test, and how a refusal looks."""

import atexit
import functools
import pathlib
import shutil
import tempfile
import unittest

from support.retrace_cli import check, draw_walk, run, street, write_truth


def positions(speeds):
    """Where the walker is at each frame, from the speed at each, in pixels a frame."""
    where, all_of_them = 0.0, []
    for speed in speeds:
        all_of_them.append(where)
        where += speed
    return all_of_them


class TwoWalks:
    """Two walks along one wall, the second twice as fast where the first is slow. Each part is made when it is first asked
    for, and the folder is removed when the process ends."""

    reference_at = positions([1] * 300 + [2] * 300)
    query_at = positions([2] * 150 + [1] * 590)

    @functools.cached_property
    def folder(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="retrace-cli-"))
        atexit.register(shutil.rmtree, folder)
        return folder

    @functools.cached_property
    def wall(self):
        return street()

    @functools.cached_property
    def reference(self):
        return draw_walk(self.folder / "reference", self.wall, self.reference_at)

    @functools.cached_property
    def query(self):
        return draw_walk(self.folder / "query", self.wall, self.query_at, gain=0.7)

    @functools.cached_property
    def reference_truth(self):
        return write_truth(self.folder / "reference.csv", self.reference_at)

    @functools.cached_property
    def query_truth(self):
        return write_truth(self.folder / "query.csv", self.query_at)

    @functools.cached_property
    def route(self):
        """The reference, with its truth, as `build` makes it by default."""
        check("build", self.reference, "-o", self.folder / "route.db", "--truth", self.reference_truth)
        return self.folder / "route.db"

    @functools.cached_property
    def run(self):
        """The query found on that route, as `localise` finds it by default."""
        check("localise", self.query, "--route", self.route, "-o", self.folder / "run")
        return self.folder / "run"


class CliTest(unittest.TestCase):
    """A test in a folder of its own. No test changes the walks, which are made once a process."""

    walks = TwoWalks()

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
