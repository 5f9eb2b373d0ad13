#!/usr/bin/env python3
"""Routes and their files: what `build` reads and writes, and what `inspect` shows of it."""

import json
import pathlib
import shutil
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.cli_test_case import CliTest  # noqa: E402
from support.retrace_cli import RETRACE, check, rows, run, video  # noqa: E402


class RoutesTest(CliTest):
    def test_inspect_shows_text_and_json(self):
        text = check("inspect", self.walks.route)
        for part in ("traverse 'reference'", "600 frames of 96x48 px", "poses from reference.csv", "motion=sad",
                     "described by blocks, 1024 bytes a keyframe"):
            self.assertIn(part, text)
        self.assertEqual(json.loads(check("inspect", self.walks.route, "--json"))["traverses"][0]["descriptor_bytes"], 1024)

    def test_a_second_traverse_joins_the_route(self):
        route = self.folder / "route.db"
        shutil.copy(self.walks.route, route)
        check("build", self.walks.query, "-o", route, "--name", "evening")
        self.refused("build", self.walks.query, "-o", route, "--name", "evening", says="already has a traverse 'evening'")
        check("build", self.walks.query, "-o", route, "--name", "evening", "--force")
        names = [t["name"] for t in json.loads(check("inspect", route, "--json"))["traverses"]]
        self.assertEqual(names, ["reference", "evening"])
        check("localise", self.walks.query, "--route", route, "-o", self.folder / "run")
        found = rows(self.folder / "run" / "matches.csv")
        self.assertGreater(sum(row["traverse"] == "evening" for row in found), 0.5 * len(found))

    def test_two_builds_at_once_lose_no_walk(self):
        route = self.folder / "both.db"
        builds = [subprocess.Popen([RETRACE, "build", str(self.walks.reference), "-o", str(route), "--name", name],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) for name in ("one", "two")]
        for process in builds:
            self.assertEqual(process.wait(), 0, process.stderr.read())
            process.stderr.close()
        self.assertEqual({t["name"] for t in json.loads(check("inspect", route, "--json"))["traverses"]}, {"one", "two"})

    def test_a_route_goes_through_a_folder_and_back(self):
        folder, back = self.folder / "folder", self.folder / "back.db"
        check("inspect", self.walks.route, "--export", folder)
        keyframes = json.loads(check("inspect", self.walks.route, "--json"))["traverses"][0]["keyframe"]
        written = rows(folder / "traverse-1" / "keyframes.csv")
        self.assertEqual([int(row["frame"]) for row in written], [keyframe["frame"] for keyframe in keyframes])
        self.assertEqual([float(row["distance_m"]) for row in written], [keyframe["distance_m"] for keyframe in keyframes])
        self.assertEqual(len(list((folder / "traverse-1").glob("preview-*.jpg"))), len(written))
        self.assertIn("1 traverse", check("build", "--import", folder, "-o", back))
        self.assertEqual(back.read_bytes(), self.walks.route.read_bytes())
        self.refused("inspect", self.walks.route, "--export", folder, says="is there already")
        self.refused("build", "--import", folder, "-o", back, says="--force")
        self.refused("build", "--import", folder, "-o", self.folder / "new.db", "--every", "3", "--motion", "none",
                     says="--import: leaves no choice", code=2)
        self.refused("build", "-o", self.folder / "new.db", says="walk: is missing", code=2)
        (folder / "traverse-1" / "descriptors-1.npy").unlink()
        self.refused("build", "--import", folder, "-o", self.folder / "new.db", says="descriptors-1.npy: cannot be read")

    def test_says_the_names_of_places_in_passing(self):
        route, names = self.folder / "route.db", self.folder / "names.csv"
        names.write_text("distance_m,name\n4,\"bench, <script>\"\n2.5,bakery\n")
        check("build", self.walks.reference, "-o", route, "--truth", self.walks.reference_truth, "--places", names)
        told = json.loads(check("inspect", route, "--json"))["traverses"][0]["places"]
        self.assertEqual([(one["name"], one["distance_m"]) for one in told], [("bakery", 2.5), ("bench, <script>", 4)])
        for one in told:  # a pixel is a centimetre
            self.assertAlmostEqual(0.01 * self.walks.reference_at[one["frame"]], one["distance_m"], delta=0.03)
        self.assertIn("'bakery' at frame", check("inspect", route))
        lines = [json.loads(line) for line in check("follow", self.walks.query, "--route", route, "--announce").splitlines()]
        passing = [line for line in lines if line.get("event") == "passing"]
        self.assertEqual([line["name"] for line in passing], ["bakery", "bench, <script>"])
        for line in passing:
            self.assertLessEqual(abs(line["distance_m"]), 2)

        # localise names the nearest, in its file as it is written anywhere.
        check("localise", self.walks.query, "--route", route, "-o", self.folder / "named")
        matches = [row for row in rows(self.folder / "named" / "matches.csv") if row["reference_frame"]]
        self.assertEqual({row["nearest_place"] for row in matches}, {"bakery", "bench, <script>"})
        for row in matches:
            to = {"bakery": 2.5, "bench, <script>": 4}[row["nearest_place"]] - float(row["reference_distance_m"])
            self.assertAlmostEqual(float(row["nearest_place_m"]), to, delta=0.03)
            self.assertEqual(row["nearest_place"], "bakery" if float(row["reference_distance_m"]) < 3.25 else "bench, <script>")
        truth = ("--query-truth", self.walks.query_truth, "--reference-truth", self.walks.reference_truth, "--tolerance-m", 1)
        check("evaluate", self.folder / "named", *truth)  # which reads it

        # A second walk keeps them, and so does an exported route.
        check("build", self.walks.query, "-o", route, "--name", "evening")
        check("inspect", route, "--export", self.folder / "exported")
        check("build", "--import", self.folder / "exported", "-o", self.folder / "imported.db")
        self.assertIn("'bakery' at frame", check("inspect", self.folder / "imported.db"))

        self.refused("build", self.walks.query, "-o", self.folder / "new.db", "--places", names,
                     says="names.csv: line 2: gives a distance, and the walk has no surveyed distances")
        names.write_text("frame,name\n9999,x\n")
        self.refused("build", self.walks.query, "-o", self.folder / "new.db", "--places", names, says="line 2: names frame 9999")
        names.write_text("place,name\n1,x\n")
        self.refused("build", self.walks.query, "-o", self.folder / "new.db", "--places", names, says="frame,name or distance_m,name")

    def test_build_leaves_a_report_when_asked(self):
        build = ["build", self.walks.reference, "-o", self.folder / "route.db"]
        self.refused(*build, "--report", self.folder / "route.db", says="is the route itself")
        self.refused(*build, "--report", self.folder / "none" / "day.html", says="is no folder")
        page = self.folder / "day.html"
        check(*build, "--report", page)
        self.assertEqual({path.name for path in self.folder.iterdir() if "lock" not in path.name}, {"route.db", "day.html"})
        text = page.read_text()
        for title in ("Alignment error", "learned relation", "What stays and what passes by", "keyframes"):
            self.assertIn(title, text)
        self.assertEqual(text.count('class="picture"'), 3)  # 1, 5 and 10 frames apart
        self.refused(*build, "--name", "again", "--report", page, says="already exists")
        self.assertEqual(page.read_text(), text)
        self.refused("build", "--import", self.folder, "-o", self.folder / "b.db", "--report", self.folder / "b.html",
                     says="leaves no choice", code=2)

    def test_reads_video_with_its_own_times_and_rotation(self):
        # Two seconds at 30 frames/s, then half as many for the rest: index / rate would be wrong by seconds.
        path = video(self.walks.reference, self.folder / "vfr.mkv", "-vf",
                     "setpts='if(lt(N,60),N/30,2+(N-60)/15)/TB'", "-fps_mode", "vfr")
        check("build", path, "-o", self.folder / "route.db")
        keyframes = json.loads(check("inspect", self.folder / "route.db", "--json"))["traverses"][0]["keyframe"]
        for keyframe in keyframes:
            n = keyframe["frame"]
            self.assertAlmostEqual(keyframe["time_s"], n / 30 if n < 60 else 2 + (n - 60) / 15, delta=1 / 15)  # ffmpeg may drop one frame at the change
        upright = video(self.walks.reference, self.folder / "plain.mp4")
        turned = self.folder / "turned.mp4"
        subprocess.run(["ffmpeg", "-v", "error", "-i", upright, "-c", "copy", "-metadata:s:v", "rotate=90", turned], check=True)
        check("build", turned, "-o", self.folder / "turned.db")
        self.assertIn("48x96 px", check("inspect", self.folder / "turned.db"))

    def test_a_video_that_breaks_off_gives_what_it_has(self):
        whole = video(self.walks.reference, self.folder / "whole.avi")
        cut = self.folder / "cut.avi"
        cut.write_bytes(whole.read_bytes()[:int(whole.stat().st_size * 0.6)])
        done = run("build", cut, "-o", self.folder / "route.db")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, r"cut.avi: breaks off: \d+ of 600 frames could be read")


if __name__ == "__main__":
    unittest.main(verbosity=2)
