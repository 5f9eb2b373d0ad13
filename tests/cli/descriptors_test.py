#!/usr/bin/env python3
"""Descriptors: written for other programs, read from a file, one or several for a route."""

import json
import pathlib
import re
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.cli_test_case import CliTest  # noqa: E402
from support.retrace_cli import check, read_json, rows  # noqa: E402


class DescriptorsTest(CliTest):
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
                for option in ("--preview-width-px", 320), ("--view-points", "true"):
                    self.refused("describe", self.walks.reference, "-o", file, *option, says=option[0], code=2)

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


if __name__ == "__main__":
    unittest.main(verbosity=2)
