#!/usr/bin/env python3
"""What a user says of a recording and of its survey: every such option has its effect, or is an error."""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.retrace_cli import check, draw_walk, rows, run, street, video, write_truth  # noqa: E402

FRAMES = 240
VANILLA = ("--motion", "none", "--every", "10")


def at(frame):
    """Where the drawn walker is, in metres: a pixel and a half a frame, a centimetre a pixel."""
    return 0.015 * frame


def tum(path, pose_of, frames=range(0, FRAMES, 3), start_s=0.0):
    path.write_text("".join(f"{start_s + f / 30:.6f} {pose_of(f)}\n" for f in frames))
    return path


def gpx(path, tracks):
    """Tracks of (name, points), a point being (time, degrees north): due north, so that degrees alone say how far."""
    text = '<gpx version="1.1" xmlns="http://www.topografix.com/GPX/1/1">'
    for name, points in tracks:
        text += f"<trk><name>{name}</name><trkseg>"
        text += "".join(f'<trkpt lat="{north:.9f}" lon="7"><time>{when}</time></trkpt>' for when, north in points)
        text += "</trkseg></trk>"
    path.write_text(text + "</gpx>")
    return path


def utc(seconds, day=1):
    return f"2024-05-{day:02d}T10:{int(seconds) // 60:02d}:{seconds % 60:06.3f}Z"


class RecordingsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = pathlib.Path(tempfile.mkdtemp(prefix="retrace-recordings-"))
        cls.walk = draw_walk(cls.made / "walk", street(), [1.5 * f for f in range(FRAMES)])
        cls.video = video(cls.walk, cls.made / "walk.mp4")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.made)

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="retrace-recordings-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def build(self, *arguments):
        """What `build` prints as JSON, its warnings, and the route's only traverse."""
        route = self.folder / f"{len(list(self.folder.glob('*.db')))}.db"
        done = run("build", *arguments, "-o", route, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout), done.stderr, json.loads(check("inspect", route, "--json"))["traverses"][0]

    def refused(self, *arguments, says, code=1):
        done = run(*arguments, "-o", self.folder / "refused.db")
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertIn(says, done.stderr)
        self.assertFalse((self.folder / "refused.db").exists())

    def surveyed_m(self, traverse):
        known = [k["distance_m"] for k in traverse["keyframe"] if "distance_m" in k]
        return known[-1] - known[0]

    # ---- pictures ----

    def test_a_rate_of_a_video_instead_of_its_times(self):
        # The last frame is a frame short of the whole: N - 1 intervals.
        self.assertAlmostEqual(self.build(self.video, *VANILLA)[0]["duration_s"], (FRAMES - 1) / 30, places=3)
        self.assertAlmostEqual(self.build(self.video, *VANILLA, "--frame-rate-hz", 120)[0]["duration_s"], (FRAMES - 1) / 120, places=3)
        self.assertAlmostEqual(self.build(self.walk, *VANILLA)[0]["duration_s"], (FRAMES - 1) / 30, places=3)
        self.refused("build", "camera:99", "--frame-rate-hz", 30, says="no frame-rate-hz for a camera")

    def test_a_clock_that_is_not_the_walker_s(self):
        # Recorded at 80 frames a second and shown at 20.
        check("simulate", "--scene", "street", "--length-m", "15", "--seed", "3", "--frame-rate-hz", "80", "--width", "320",
              "--height", "180", "-o", self.folder / "walk")
        walk, slow = self.folder / "walk" / "walk.mp4", self.folder / "slow.mp4"
        subprocess.run(["ffmpeg", "-v", "error", "-i", str(walk), "-vf", "setpts=4*PTS", "-r", "20", "-q:v", "3", str(slow)], check=True)
        self.assertNotIn("--frame-rate-hz", self.build(walk, "--motion", "sad")[1])
        said = self.build(slow, "--motion", "sad")[1]
        self.assertIn("slow motion", said)
        self.assertIn("--frame-rate-hz", said)
        self.assertNotIn("slow motion", self.build(slow, "--motion", "sad", "--frame-rate-hz", 80)[1])
        self.refused("build", slow, "--motion", "steps", says="as in slow motion")

    def test_a_camera_that_looks_to_the_side_does_not_stand(self):
        check("simulate", "--scene", "street", "--length-m", "25", "--seed", "3", "--camera-yaw-deg", "90", "--width", "320",
              "--height", "180", "-o", self.folder / "walk")
        check("odometry", self.folder / "walk" / "walk.mp4", "-o", self.folder / "out")
        seen = [row["activity"] for row in rows(self.folder / "out" / "activity.csv")]
        self.assertNotIn("standing", seen[:-1])

    def test_bars_of_dark_grey(self):
        barred = self.folder / "barred.mp4"
        subprocess.run(["ffmpeg", "-v", "error", "-i", str(self.video), "-vf", "scale=192:96,pad=192:144:0:24:0x202020,noise=alls=6:allf=t",
                        "-c:v", "mpeg4", "-q:v", "6", str(barred)], check=True)
        _, said, traverse = self.build(barred, *VANILLA)
        self.assertIn("has black bars", said)
        self.assertEqual(traverse["frame_size"], [192, 96])

    def test_a_part_of_the_picture(self):
        for recording in (self.video, self.walk):
            self.assertEqual(self.build(recording, *VANILLA)[2]["frame_size"], [96, 48])
            cropped = self.build(recording, *VANILLA, "--crop", "16,0,64,40")[2]
            self.assertEqual(cropped["frame_size"], [64, 40])
        self.refused("build", self.video, "--crop", "40,0,64,48", says="--crop within them, not 40,0,64,48")
        for bad in ("40,0,64", "0,0,0,48", "a,b,c,d", "0,0,64,48,1", "-1,0,64,48"):
            self.refused("build", self.video, f"--crop={bad}", says="crop: is")

    def test_a_mask(self):
        def described(name, *options):
            out = self.folder / f"{name}.npy"
            check("describe", self.walk, "-o", out, *VANILLA, *options)
            return out.read_bytes()

        def mask(name, left, width=96):
            path = self.folder / f"{name}.pgm"
            path.write_bytes(b"P5 %d 48 255\n" % width + (bytes(left) + b"\xff" * (width - left)) * 48)
            return path
        unmasked = described("none")
        self.assertEqual(described("white", "--mask", mask("white", 0)), unmasked)
        self.assertNotEqual(described("half", "--mask", mask("half", 48)), unmasked)
        self.refused("build", self.walk, "--mask", mask("black", 96), says="is black all over")
        self.refused("build", self.walk, "--mask", mask("wide", 0, 200), says="the shape of the recording's pictures, 96x48")
        self.refused("build", self.walk, "--mask", self.folder / "none.png", says="cannot be read as an image")

    # ---- several files ----

    def test_several_files_are_one_walk(self):
        parts = []
        for name, frames in (("a", range(0, 100)), ("b", range(100, FRAMES))):
            draw_walk(self.folder / name, street(), [1.5 * f for f in frames])
            parts.append(video(self.folder / name, self.folder / f"{name}.mp4", "-metadata",
                               f"creation_time=2024-05-01T10:00:{frames[0] // 30:02d}Z"))
        result, _, traverse = self.build(*parts, *VANILLA)
        self.assertEqual((result["frames"], result["traverse"]), (FRAMES, "a"))
        self.assertAlmostEqual(result["duration_s"], (FRAMES - 1) / 30, places=3)  # one follows the other at once
        self.assertEqual([k["frame"] for k in traverse["keyframe"]], list(range(0, FRAMES, 10)))

        check("localise", *parts, "--route", self.folder / "0.db", "-o", self.folder / "run", "--sequence-length", "5")
        matches = rows(self.folder / "run" / "matches.csv")
        self.assertEqual([int(m["query_frame"]) for m in matches], list(range(0, FRAMES, 10)))
        check("odometry", *parts, "-o", self.folder / "odometry", "--motion", "steps")
        self.assertEqual(len(rows(self.folder / "odometry" / "frames.csv")), FRAMES)
        check("describe", *parts, "-o", self.folder / "parts.npy", *VANILLA)
        self.assertEqual(len(rows(self.folder / "parts.npy.csv")), FRAMES / 10)
        (self.folder / "pairs.csv").write_text(f"query_frame,reference_frame\n0,0\n{FRAMES - 1},{FRAMES - 1}\n")
        check("sweep", *parts, "--reference", *parts, "--pairs", self.folder / "pairs.csv", "--tolerance-frames", 2,
              "--motion", "none", "--every", 10, "--sequence-length", 5, "--search-range-rad", 0.1, "-o", self.folder / "sweep")
        cell = rows(self.folder / "sweep/sweep.csv")[0]
        self.assertEqual((int(cell["query_keyframes"]), int(cell["reference_keyframes"]), float(cell["max_f1"])), (FRAMES / 10, FRAMES / 10, 1))
        self.refused("build", parts[0], "camera:0", says="cannot be one of several")

    # ---- surveys ----

    def test_a_trajectory_s_clock(self):
        poses = tum(self.folder / "late.tum", lambda f: f"0 {at(f)} 0 0 0 0 1", start_s=1000)
        self.refused("build", self.video, *VANILLA, "--trajectory", poses, says="--trajectory-start-s")
        traverse = self.build(self.video, *VANILLA, "--trajectory", poses, "--trajectory-start-s", 1000)[2]
        self.assertAlmostEqual(self.surveyed_m(traverse), at(FRAMES - 10), places=3)
        self.refused("build", self.video, "--trajectory-start-s", 5, says="--trajectory", code=2)
        self.refused("build", self.video, "--track-start-s", 5, says="--track", code=2)
        self.refused("build", self.video, "--track-name", "a", says="--track", code=2)

    def test_a_track_s_clock_and_name(self):
        def points(metres, start_s, day):
            return [(utc(start_s + i / 2, day), 46 + metres * i / 111147) for i in range(17)]
        file = gpx(self.folder / "two.gpx", [("morning", points(1, 0, 1)), ("evening", points(2, 0, 2))])
        _, said, traverse = self.build(self.video, *VANILLA, "--track", file)
        self.assertIn("'evening' is taken, the latest; choose another by --track-name", said)
        # Two metres each half second, over the time of the last keyframe; degrees are good to a thousandth.
        last_s = (FRAMES - 10) / 30
        self.assertAlmostEqual(self.surveyed_m(traverse), 4 * last_s, delta=0.05)
        _, said, traverse = self.build(self.video, *VANILLA, "--track", file, "--track-name", "morning")
        self.assertEqual(said, "")
        self.assertAlmostEqual(self.surveyed_m(traverse), 2 * last_s, delta=0.05)
        self.refused("build", self.video, *VANILLA, "--track", file, "--track-name", "noon", says="has no track 'noon'")

        # A logger that stood for a minute before the camera ran.
        early = gpx(self.folder / "early.gpx", [("a", [(utc(0), 46.0), (utc(30), 46.0)] + points(1, 60, 1))])
        _, said, traverse = self.build(self.video, *VANILLA, "--track", early, "--motion-file-gap-s", 40)
        self.assertIn("lasts 68 s, the video 8 s", said)
        self.assertAlmostEqual(self.surveyed_m(traverse), 0, delta=0.01)
        _, said, traverse = self.build(self.video, *VANILLA, "--track", early, "--track-start-s", 60)
        self.assertEqual(said, "")
        self.assertAlmostEqual(self.surveyed_m(traverse), 2 * last_s, delta=0.05)

    def test_a_track_without_a_date_is_matched_by_the_video_s_creation_time(self):
        dated = self.folder / "dated.mp4"
        subprocess.run(["ffmpeg", "-v", "error", "-i", str(self.video), "-c", "copy", "-metadata",
                        "creation_time=2024-05-01T10:01:00Z", str(dated)], check=True)
        file = gpx(self.folder / "day.gpx", [("a", [(utc(i), 46 + 1.5 * max(0, i - 60) / 111147) for i in range(600)])])
        _, said, traverse = self.build(dated, *VANILLA, "--track", file)
        self.assertIn("matched with the video by its creation time: the first frame is 60.0 s after", said)
        self.assertAlmostEqual(self.surveyed_m(traverse), 1.5 * (FRAMES - 10) / 30, delta=0.05)

    def test_gaps_of_a_survey(self):
        lost = [f for f in range(0, FRAMES, 3) if not 60 < f < 180]  # four seconds without a pose
        poses = tum(self.folder / "lost.tum", lambda f: f"0 {at(f)} 0 0 0 0 1", lost)

        def without_pose(*options):
            keyframes = self.build(self.video, *VANILLA, "--trajectory", poses, *options)[2]["keyframe"]
            return [k["frame"] for k in keyframes if "x_m" not in k]
        self.assertEqual(without_pose(), list(range(70, 180, 10)))
        self.assertEqual(without_pose("--motion-file-gap-s", 5), [])
        self.refused("build", self.video, *VANILLA, "--motion-file-gap-s", 5, says="motion-file-gap-s: has no effect")
        self.refused("build", self.video, *VANILLA, "--truth", write_truth(self.folder / "t.csv", [0] * FRAMES),
                     "--motion-file-gap-s", 5, says="motion-file-gap-s: has no effect")

    def test_the_axes_of_a_trajectory(self):
        # Ahead along z, as a camera sees it, up and down by as much as ahead, and a camera that looks to the side: what of it
        # is the ground cannot be seen in the file.
        odd = tum(self.folder / "odd.tum", lambda f: f"{at(f)} {at(f)} {at(f)} 0 0 0 1")
        self.refused("build", self.video, *VANILLA, "--trajectory", odd, says="--axes")
        along = 2 ** 0.5 * at(FRAMES - 10)  # of x and z
        for axes in ("camera", "vehicle"):
            traverse = self.build(self.video, *VANILLA, "--trajectory", odd, "--axes", axes)[2]
            self.assertAlmostEqual(self.surveyed_m(traverse), along, places=3)
        self.refused("build", self.video, *VANILLA, "--axes", "camera", says="axes: has no effect")
        self.refused("build", self.video, *VANILLA, "--axes", "camera", "--truth", "t.csv", says="axes: has no effect")
        # A file that gives motion is read the same way, and what is left out of it is said.
        nan = tum(self.folder / "nan.tum", lambda f: f"0 {'nan' if f == 30 else at(f)} 0 0 0 0 1")
        by_file = ("--motion", "file", "--motion-file", nan, "--spacing-m", "0.3")
        result, said, _ = self.build(self.video, *by_file, "--axes", "vehicle")
        self.assertIn("nan.tum", said)
        self.assertAlmostEqual(result["keyframes"], at(FRAMES) / 0.3, delta=1)

    def test_units_are_not_held_against_metres(self):
        walk = self.folder / "walk"
        walk.mkdir()
        (walk / "trajectory.tum").write_text("".join(f"{i} 0 {i} 0 0 0 0 1\n" for i in range(100)))
        (walk / "steps.csv").write_text("step,frame,time_s,leg,x_m,y_m,heading_deg\n")
        truth = write_truth(self.folder / "truth.csv", [100 * i for i in range(100)], rate_hz=1)
        for unit in ("s", "units"):
            (walk / "frames.csv").write_text(f"frame,time_s,displacement,unit\n0,0,0,{unit}\n")
            done = run("evaluate-odometry", walk, "--truth", truth)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn(f"trajectory.tum: is in '{unit}', no metres", done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=1)
