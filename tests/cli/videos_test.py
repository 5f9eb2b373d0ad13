#!/usr/bin/env python3
"""`video`: the query and, below it, the matched reference."""

import pathlib
import shutil
import statistics
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.cli_test_case import CliTest  # noqa: E402
from support.retrace_cli import MATCH_COLUMNS, check, rows, run  # noqa: E402


class VideosTest(CliTest):
    def grey_pictures(self, path, crop, size):
        """All pictures of a video: a part of each, in grey, scaled to a size."""
        width, height = size
        raw = subprocess.run(["ffmpeg", "-v", "error", "-i", str(path), "-vf", f"crop={crop},scale={width}:{height}",
                              "-pix_fmt", "gray", "-f", "rawvideo", "-"], capture_output=True, check=True).stdout
        return [raw[at:at + width * height] for at in range(0, len(raw), width * height)]

    def test_a_video_shows_the_query_and_below_it_the_reference(self):
        # Pictures of 96x48 become 192x96: the query at the top, the reference from row 96 on.
        side = self.folder / "side.mp4"
        self.assertIn("740 frames at 30 frames/s", check("video", self.walks.run, "-o", side, "--width-px", "192"))
        shown = self.grey_pictures(side, "192:96:0:96", (96, 48))
        self.assertEqual(len(shown), 740)
        above = self.grey_pictures(side, "192:96:0:0", (96, 48))

        def difference(picture, folder, frame):
            # Rows that no caption covers.
            drawn = (folder / f"{frame}.pgm").read_bytes()[-96 * 48:]
            return sum(abs(a - b) for a, b in zip(picture[96 * 14:96 * 46:3], drawn[96 * 14:96 * 46:3]))

        def most_alike(picture, folder, frames):
            differences = {frame: difference(picture, folder, frame) for frame in frames}
            return [frame for frame in frames if differences[frame] == min(differences.values())]  # the wall may stand still

        found = [row for row in rows(self.walks.run / "matches.csv") if row["accepted"] == "1"]
        for row in found[3:-3:max(1, len(found) // 8)]:
            query, reference = int(row["query_frame"]), int(row["reference_frame"])
            self.assertIn(reference, most_alike(shown[query], self.walks.reference,
                                                range(max(0, reference - 40), min(600, reference + 40))))
            self.assertIn(query, most_alike(above[query], self.walks.query, range(max(0, query - 20), min(740, query + 20))))

        # Half way between two matches in succession, the reference is half way too: the walls pass at one speed there.
        pairs = [(a, b) for a, b in zip(found[3:-3], found[4:-3])
                 if 6 < int(b["reference_frame"]) - int(a["reference_frame"]) < 40]
        self.assertTrue(pairs)
        for a, b in pairs[::max(1, len(pairs) // 5)]:
            first, last = int(a["reference_frame"]), int(b["reference_frame"])
            middle = (int(a["query_frame"]) + int(b["query_frame"])) // 2
            best = statistics.mean(most_alike(shown[middle], self.walks.reference, range(first, last + 1)))
            # Its displacement is known to a frame or so; a middle of two frames is rounded, and the wall's pixels are whole.
            self.assertAlmostEqual(best, (first + last) / 2, delta=3)

    def test_a_video_says_where_the_walk_is_off_the_route(self):
        run_folder = self.folder / "run"
        shutil.copytree(self.walks.run, run_folder)
        lines = (run_folder / "matches.csv").read_text().splitlines()
        edited, refused = lines[:1], []
        for i, line in enumerate(lines[1:]):
            cells = line.split(",")
            if 10 <= i < 20:
                cells[MATCH_COLUMNS.index("accepted")] = "0"
                refused.append(int(cells[0]))
            edited.append(",".join(cells))
        (run_folder / "matches.csv").write_text("\n".join(edited) + "\n")
        side = self.folder / "side.mp4"
        check("video", run_folder, "-o", side, "--width-px", "192")
        shown = self.grey_pictures(side, "192:96:0:96", (96, 48))
        accepted = [int(row["query_frame"]) for row in rows(run_folder / "matches.csv") if row["accepted"] == "1"]
        for query in refused:
            self.assertLess(statistics.mean(shown[query]), 60, query)
        for query in accepted:
            self.assertGreater(statistics.mean(shown[query]), 90, query)

        # Without the recording, the route's previews; blinking, the query itself every other half second.
        elsewhere = self.folder / "elsewhere"
        elsewhere.mkdir()
        shutil.copy(self.walks.route, elsewhere / "route.db")
        done = run("video", run_folder, "-o", side, "--force", "--route", elsewhere / "route.db", "--width-px", "192", "--blink")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("--reference FILE says where it is", done.stderr)
        blinking = self.grey_pictures(side, "192:96:0:96", (96, 48))
        above = self.grey_pictures(side, "192:96:0:0", (96, 48))
        self.assertEqual(len(blinking), 740)
        for query in accepted[::5]:
            apart = statistics.mean(abs(a - b) for a, b in zip(blinking[query][96 * 14:], above[query][96 * 14:]))
            (self.assertLess if query // 15 % 2 == 1 else self.assertGreater)(apart, 8, query)

    def test_refuses_videos_it_cannot_make(self):
        side = self.folder / "side.mp4"
        video_of_it = ("video", self.walks.run, "-o", side)
        self.refused(*video_of_it, "--query", self.walks.reference, says="has 600 frames; expected the walk of the run, with 740")
        self.refused(*video_of_it, "--reference", self.walks.query, says="has 740 frames or more; expected the walk of the run, with 600")
        self.refused(*video_of_it, "--warp", says="--warp: has no effect; expected a run of `localise --verify 7`")
        self.refused("video", self.walks.run, "-o", self.folder / "side.txt", says="expected a name ending in .mp4")
        self.refused("video", self.folder / "none", "-o", side, says="matches.csv: does not exist")
        self.refused("video", self.walks.run, "-o", self.folder / "none" / "side.mp4", says="is no folder")
        side.write_text("before")
        self.refused(*video_of_it, says="--force")
        self.assertEqual(side.read_text(), "before")


if __name__ == "__main__":
    unittest.main(verbosity=2)
