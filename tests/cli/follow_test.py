#!/usr/bin/env python3
"""`follow`: a line for each frame while the walk goes on."""

import json
import pathlib
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.cli_test_case import CliTest  # noqa: E402
from support.retrace_cli import MATCH_COLUMNS, NEAREST_COLUMNS, RETRACE, check, read_json, rows, video  # noqa: E402


class FollowTest(CliTest):
    def test_follows_a_walk_frame_by_frame(self):
        out = self.folder / "out"
        lines = check("follow", self.walks.query, "--route", self.walks.route, "-o", out, "--announce").splitlines()
        self.assertEqual((out / "follow.jsonl").read_text().splitlines(), lines)
        self.assertIn("data-kind=\"player\"", (out / "report.html").read_text())
        # What reads the runs of localise reads these.
        matches = rows(out / "matches.csv")
        self.assertEqual(list(matches[0]), MATCH_COLUMNS + NEAREST_COLUMNS)
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
        self.refused("follow", self.walks.query, "--route", self.walks.route, "--force", says="--force", code=2, leaves=())
        evaluation = (out / "evaluation.html").read_text()
        self.assertIn("Max-F1", evaluation)
        for of_sequences in ("<dt>Sequence", "probability 0 or more", "<dt>Relative scale", "were found on part of a line"):
            self.assertFalse(of_sequences in evaluation, of_sequences)
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


if __name__ == "__main__":
    unittest.main(verbosity=2)
