#!/usr/bin/env python3
"""The reports in a real browser with the network off: no error, every figure drawn, filters, zoom and keys work, light,
dark and on paper. Screenshots stay in the folder RETRACE_SCREENSHOTS. Exits 77, skipped, where there is no Chromium."""

import base64
import json
import os
import pathlib
import shutil
import struct
import sys
import tempfile
import unittest
import zlib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.live_follow import LiveFollow, video_y4m  # noqa: E402
from support.retrace_cli import check  # noqa: E402

SKIPPED = 77
try:
    from selenium import webdriver
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.support.ui import WebDriverWait
except ImportError:
    print("skipped: python3-selenium is not installed")
    sys.exit(SKIPPED)
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
CHROMEDRIVER = shutil.which("chromedriver")
if not CHROMIUM or not CHROMEDRIVER:
    print("skipped: chromium and chromium-driver are not installed")
    sys.exit(SKIPPED)

# What would run if any text of it came into a page as more than text, and the same for a file's name.
PAYLOAD = "</script><script>window.ran = 1</script>\"'><img src=x onerror='window.ran = 1'><svg onload='window.ran = 1'>"
FILE_PAYLOAD = "<img src=x onerror='window.ran = 1'>\"<svg onload=window.ran=1>"
PHONE = 390  # px, the width of a common one
SCREENSHOTS = pathlib.Path(os.environ.get("RETRACE_SCREENSHOTS", "screenshots"))

# The share of a canvas's pixels that differ from its first one.
INKED = """
const canvas = arguments[0], data = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
let inked = 0;
for (let i = 0; i < data.length; i += 4)
  inked += data[i] !== data[0] || data[i + 1] !== data[1] || data[i + 2] !== data[2] || data[i + 3] !== data[3];
return inked / (data.length / 4);"""
# A number that changes with what is drawn.
DIGEST = """
const canvas = arguments[0], data = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
let digest = 7;
for (const byte of data) digest = (Math.imul(digest, 31) + byte) | 0;
return digest;"""


def browser():
    options = Options()
    options.binary_location = CHROMIUM
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--window-size=1200,1000",
                     "--host-resolver-rules=MAP * ~NOTFOUND , EXCLUDE localhost , EXCLUDE 127.0.0.1"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(service=Service(CHROMEDRIVER), options=options)
    driver.execute_cdp_cmd("Network.enable", {})
    network(driver, False)
    return driver


def network(driver, on):
    driver.execute_cdp_cmd("Network.emulateNetworkConditions",
                           {"offline": not on, "latency": 0, "downloadThroughput": -1 if on else 0, "uploadThroughput": -1 if on else 0})


def chequers(width, height, side=10):
    """A PNG of black and white squares."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    lines = b"".join(b"\0" + bytes(255 * ((x // side + y // side) % 2) for x in range(width)) for y in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b""))


class Walks:
    """Two short walks along one street, and every kind of run made of them."""

    def __init__(self, folder):
        self.folder = folder
        small = ["--length-m", 25, "--width", 320, "--height", 180]
        check("simulate", *small, "--speed", "slow-fast", "-o", folder / "day")
        check("simulate", *small, "--speed", "fast-slow", "--condition", "rain", "--gait-seed", 2, "-o", folder / "rain")
        self.day, self.rain = folder / "day/walk.mp4", folder / "rain/walk.mp4"
        self.truth = ["--query-truth", folder / "rain/truth.csv", "--reference-truth", folder / "day/truth.csv"]
        check("build", self.day, "-o", folder / "route.db", "--truth", folder / "day/truth.csv", "--sampling-n", 2)
        # Half of the matches are refused, so that there is something to choose from.
        self.run = self.localised("run", "--search", "lines", "--accept-score", 1.5)

    def localised(self, name, *options):
        check("localise", self.rain, "--route", self.folder / "route.db", "-o", self.folder / name, *options)
        return self.folder / name

    def evaluated(self, run):
        check("evaluate", run, *self.truth, "--tolerance-m", 2)
        return run


class ReportsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="retrace-browser-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.walks = Walks(cls.folder)
        SCREENSHOTS.mkdir(parents=True, exist_ok=True)
        cls.driver = browser()
        cls.addClassCleanup(cls.driver.quit)

    def script(self, text, *arguments):
        return self.driver.execute_script(text, *arguments)

    def all(self, selector):
        return self.driver.find_elements(By.CSS_SELECTOR, selector)

    def open(self, path, charts=0, matrices=0, strips=0, players=0):
        """Opens a report and checks what holds for every one of them."""
        self.assertLess(path.stat().st_size, 15e6)
        self.colours("light")
        self.driver.get_log("browser")  # what Chromium has to say of reading canvases back, as this test does
        self.driver.get(path.as_uri())
        self.assertEqual([entry["message"] for entry in self.driver.get_log("browser")], [])
        fetched = [line for line in self.driver.get_log("performance") if '"Network.requestWillBeSent"' in line["message"]]
        for line in fetched:
            self.assertRegex(line["message"], r'"url":"(file|data|about|chrome):')
        for kind, count in (("chart", charts), ("matrix", matrices), ("strip", strips), ("player", players)):
            self.assertEqual(len(self.all(f"figure.{kind}[data-drawn=true]")), count, kind)
        for canvas in self.all("canvas"):
            self.assertGreater(self.script(INKED, canvas), 0.002, canvas.get_attribute("aria-label"))
            self.assertTrue(canvas.get_attribute("aria-label"))
        for picture in self.all("img"):
            self.assertTrue(picture.get_attribute("alt"))
        self.assertEqual(len(self.all("h1")), 1)
        self.nothing_sticks_out(1200)
        self.reached_by_keys()
        self.in_the_dark()
        self.screenshot(path.parent.name + "-" + path.stem)
        self.on_a_phone(path)

    def nothing_sticks_out(self, width):
        """The page does not scroll sideways; a wide table scrolls in its own box, which keys reach."""
        self.assertLessEqual(self.script("return document.documentElement.scrollWidth"), width)
        wide = self.script("""return [...document.querySelectorAll('main *')].filter(e => e.getBoundingClientRect().right > arguments[0]
            && !e.closest('.scroll, .strip ol')).map(e => e.outerHTML.slice(0, 120))""", width)
        self.assertEqual(wide, [])

    def on_a_phone(self, path):
        """The same page on a narrow screen, loaded anew; every figure is drawn within it."""
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": PHONE, "height": 844, "deviceScaleFactor": 2, "mobile": True})
        try:
            self.driver.get(path.as_uri())
            self.nothing_sticks_out(PHONE)
            self.assertTrue(self.script("""return [...document.querySelectorAll('.scroll')].every(
                box => box.scrollWidth <= box.clientWidth || box.tabIndex === 0)"""))
            for canvas in self.all("canvas"):
                self.assertGreater(self.script(INKED, canvas), 0.002, canvas.get_attribute("aria-label"))
                # Axes and legend leave at least half of a figure to what it shows.
                area = self.script("const c = Chart.getChart(arguments[0]); return c && c.chartArea.height / c.height", canvas)
                self.assertGreater(area or 1, 0.5, canvas.get_attribute("aria-label"))
            self.screenshot("phone-" + path.parent.name, PHONE)
        finally:
            self.driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})

    def colours(self, scheme):
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia",
                                    {"features": [{"name": "prefers-color-scheme", "value": scheme}]})

    def reached_by_keys(self):
        """Tab comes to every canvas, list and button, and each shows that it has the focus."""
        wanted = self.script("return document.querySelectorAll('canvas, .strip ol, button').length")
        self.script("document.activeElement.blur(); window.scrollTo(0, 0);")
        reached = set()
        for _ in range(wanted + 60):
            self.driver.switch_to.active_element.send_keys(Keys.TAB)
            element = self.driver.switch_to.active_element
            if element.id in reached:
                break
            if element.tag_name in ("canvas", "ol", "button"):
                reached.add(element.id)
                self.assertTrue(self.script("return arguments[0].matches(':focus-visible')", element))
        self.assertEqual(len(reached), wanted)

    def in_the_dark(self):
        canvases = self.all("canvas")
        light = [self.script(DIGEST, canvas) for canvas in canvases]
        self.colours("dark")
        background = self.script("return getComputedStyle(document.body).backgroundColor")
        self.assertEqual(background, "rgb(22, 23, 27)")
        for canvas, before in zip(canvases, light):
            # The page hears of the change a little later.
            WebDriverWait(self.driver, 10).until(lambda _, c=canvas, b=before: self.script(DIGEST, c) != b,
                                                 canvas.get_attribute("aria-label"))
        self.screenshot("dark")
        self.colours("light")

    def screenshot(self, name, width=1200):
        height = self.script("return document.documentElement.scrollHeight")
        picture = self.driver.execute_cdp_cmd("Page.captureScreenshot", {
            "captureBeyondViewport": True, "clip": {"x": 0, "y": 0, "width": width, "height": height, "scale": 1}})
        (SCREENSHOTS / f"{name}.png").write_bytes(base64.b64decode(picture["data"]))

    def zooms(self, figure, canvas):
        before = self.script(DIGEST, canvas)
        figure.find_element(By.CSS_SELECTOR, "button[aria-label='zoom in']").click()
        self.assertEqual(figure.get_attribute("data-zoom"), "2.00")
        self.assertNotEqual(self.script(DIGEST, canvas), before)
        canvas.send_keys("+")
        self.assertEqual(figure.get_attribute("data-zoom"), "4.00")
        canvas.send_keys("0")
        self.assertEqual(figure.get_attribute("data-zoom"), "1.00")
        self.assertEqual(self.script(DIGEST, canvas), before)

    def reads_points_by_keys(self, figure):
        canvas = figure.find_element(By.TAG_NAME, "canvas")
        canvas.send_keys(Keys.ARROW_RIGHT)
        self.assertIn("point 1 of", figure.find_element(By.CSS_SELECTOR, ".reading").text)

    def test_localise(self):
        self.open(self.walks.run / "report.html", charts=5, matrices=1, strips=1)
        self.assertIn("retrace evaluate", self.script("return document.body.textContent"))

    def test_evaluate(self):
        run = self.walks.evaluated(self.walks.localised("evaluated", "--search", "lines", "--accept-score", 1.5))
        self.open(run / "report.html", charts=10, matrices=1, strips=1)
        self.assertIn("Max-F1", self.script("return document.querySelector('dl.headline').textContent"))

        matrix = self.all("figure.matrix")[0]
        canvas = matrix.find_element(By.TAG_NAME, "canvas")
        self.zooms(matrix, canvas)
        before = self.script(DIGEST, canvas)
        matrix.find_element(By.CSS_SELECTOR, "input[value=raw]").click()
        self.assertEqual(matrix.get_attribute("data-picture"), "raw")
        self.assertNotEqual(self.script(DIGEST, canvas), before)
        for layer in ("truth", "found", "accepted", "refused"):
            before = self.script(DIGEST, canvas)
            matrix.find_element(By.CSS_SELECTOR, f"input[value={layer}]").click()
            self.assertNotEqual(self.script(DIGEST, canvas), before, layer)

        zoomable = [f for f in self.all("figure.chart") if f.find_elements(By.TAG_NAME, "button")]
        self.zooms(zoomable[0], zoomable[0].find_element(By.TAG_NAME, "canvas"))
        self.reads_points_by_keys(zoomable[0])

        strip = self.all("figure.strip")[0]
        everything = len(strip.find_elements(By.TAG_NAME, "li"))
        for name, state in (("accepted", "accepted"), ("refused", "refused")):
            strip.find_element(By.CSS_SELECTOR, f"button[data-filter={name}]").click()
            items = strip.find_elements(By.TAG_NAME, "li")
            self.assertTrue(0 < len(items) < everything)
            self.assertEqual({item.get_attribute("class") for item in items}, {state})
        pictures = self.script("return [...document.querySelectorAll('.strip img')].map(i => i.decode().then(() => i.naturalWidth))")
        self.assertTrue(pictures)

    def test_build(self):
        page = self.folder / "day.html"
        check("build", self.walks.day, "-o", self.folder / "reported.db", "--report", page)
        self.open(page, charts=6)
        self.assertEqual(len(self.all("figure.picture img")), 3)
        chart = self.all("figure.chart")[2]  # a picture alone: nothing to read by arrows
        self.zooms(chart, chart.find_element(By.TAG_NAME, "canvas"))

    def test_odometry(self):
        walk = self.folder / "odometry"
        check("odometry", self.walks.day, "-o", walk)
        self.open(walk / "report.html", charts=11)
        chart = self.all("figure.chart")[1]
        self.zooms(chart, chart.find_element(By.TAG_NAME, "canvas"))
        self.reads_points_by_keys(chart)

        check("evaluate-odometry", walk, "--truth", self.folder / "day/truth.csv")
        self.open(walk / "report.html", charts=13)
        self.assertIn("True steps", self.script("return document.querySelector('dl.headline').textContent"))

    def test_odometry_over_a_map(self):
        """A true path of two points, drawn on a map of chequers, under the trajectory."""
        walk = self.folder / "mapped"
        walk.mkdir()
        (walk / "trajectory.tum").write_text("".join(f"{i} 0 {i} 0 0 0 0 1\n" for i in range(30)))
        (walk / "steps.csv").write_text("step,frame,time_s,leg\n1,1,1,left\n")
        (walk / "way.csv").write_text("x_px,y_px\n50,90\n50,32\n")
        image = walk / "map.png"
        image.write_bytes(chequers(100, 100))
        evaluate = ["evaluate-odometry", walk, "--truth", walk / "way.csv", "--map-scale-m-per-px", 0.5]
        check(*evaluate)
        self.open(walk / "report.html", charts=3)
        plain = self.script(INKED, self.all("canvas")[0])
        check(*evaluate, "--map-image", image)
        self.open(walk / "report.html", charts=3)
        self.assertGreater(self.script(INKED, self.all("canvas")[0]), plain + 0.05)

    def test_follow(self):
        """Plays by button and keys, and text of the route and of file names is text only."""
        names, walk = self.folder / "names.csv", self.folder / "<img src=x onerror=alert(1)>.mp4"
        names.write_text("distance_m,name\n10,<script>alert(1)</script>\n")
        shutil.copy(self.walks.rain, walk)
        check("build", self.walks.day, "-o", self.folder / "named.db", "--truth", self.folder / "day/truth.csv", "--places", names,
              "--name", "</script><script>alert(2)</script>")
        out = self.folder / "followed"
        check("follow", walk, "--route", self.folder / "named.db", "-o", out)
        self.open(out / "report.html", players=1)
        self.assertEqual(len(self.all("main script:not([type='application/json'])")), 0)
        figure, canvas = self.all("figure.player")[0], self.all("figure.player canvas")[0]
        frame = lambda: int(figure.get_attribute("data-frame"))
        self.assertEqual(frame(), 0)
        canvas.send_keys(Keys.END)
        last = frame()
        self.assertGreater(last, 0)
        self.assertIn("on the route", figure.find_element(By.CSS_SELECTOR, ".reading").text)
        for image in figure.find_elements(By.TAG_NAME, "img"):
            self.assertGreater(self.script("return arguments[0].decode().then(() => arguments[0].naturalWidth)", image), 100)
        before = self.script(DIGEST, canvas)
        canvas.send_keys(Keys.ARROW_LEFT)
        self.assertLess(frame(), last)
        figure.find_element(By.CSS_SELECTOR, "input[type=range]").send_keys(Keys.HOME)
        self.assertEqual(frame(), 0)
        self.assertNotEqual(self.script(DIGEST, canvas), before)
        canvas.send_keys(Keys.SPACE)
        self.assertEqual(figure.get_attribute("data-playing"), "true")
        WebDriverWait(self.driver, 10).until(lambda _: frame() > 0)
        figure.find_element(By.TAG_NAME, "button").click()
        self.assertIsNone(figure.get_attribute("data-playing"))

    def test_live(self):
        """The page of a walk that goes on: moments come, an earlier one can be looked at, and the end is said."""
        names = self.folder / "stops.csv"
        names.write_text("distance_m,name\n5,<img src=x onerror=alert(1)>\n19,\"bakery & \"\"bench\"\"\"\n")
        check("build", self.walks.day, "-o", self.folder / "live.db", "--truth", self.folder / "day/truth.csv", "--places", names,
              "--name", "</script><script>alert(2)</script>")
        live = LiveFollow(video_y4m(self.walks.rain), self.folder / "live.db")
        self.addCleanup(live.stop)
        network(self.driver, True)
        self.addCleanup(network, self.driver, False)
        self.addCleanup(self.driver.get_log, "performance")
        self.colours("light")
        self.driver.get_log("browser")
        self.driver.get_log("performance")
        self.driver.get(live.url)
        figure, canvas = self.all("figure.player")[0], self.all("figure.player canvas")[0]
        slider, status = (figure.find_element(By.CSS_SELECTOR, selector) for selector in ("input[type=range]", ".status"))
        until = lambda true, text: WebDriverWait(self.driver, 30).until(lambda _: true(), text)
        frame = lambda: int(figure.get_attribute("data-frame") or -1)
        until(lambda: figure.get_attribute("data-live") == "open", "no connection")
        self.assertGreater(self.script(INKED, canvas), 0.002)  # the route, before anything is known of the walk
        half = len(live.pictures) // 2
        live.feed(live.pictures[:half], rate_hz=60)
        until(lambda: frame() > half - 30, "the newest moment is not shown")
        self.assertIn("on the route", figure.find_element(By.CSS_SELECTOR, ".reading").text)
        for image in figure.find_elements(By.TAG_NAME, "img"):
            self.assertGreater(self.script("return arguments[0].decode().then(() => arguments[0].naturalWidth)", image), 100)
        self.nothing_sticks_out(1200)
        self.screenshot("live")
        # An earlier moment stays while others come, and End goes on with what is now.
        slider.send_keys(Keys.HOME)
        earlier, before = frame(), self.script(DIGEST, canvas)
        self.assertLess(earlier, half)
        live.feed_on(pictures=live.pictures[half:], rate_hz=25)
        length = int(slider.get_attribute("max"))
        until(lambda: int(slider.get_attribute("max")) > length + 5, "no more moments come")
        self.assertEqual(frame(), earlier)
        canvas.send_keys(Keys.END)
        until(lambda: frame() > half and frame() > earlier, "what is now is not shown")
        self.assertNotEqual(self.script(DIGEST, canvas), before)
        said = set()
        until(lambda: said.add(status.text) or any("bakery" in text for text in said), "the place's name is not said")
        self.assertIn('passing bakery & "bench"', said)
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": PHONE, "height": 844, "deviceScaleFactor": 2, "mobile": True})
        self.addCleanup(self.driver.execute_cdp_cmd, "Emulation.clearDeviceMetricsOverride", {})
        shown = frame()
        until(lambda: frame() > shown, "no more moments come")
        self.nothing_sticks_out(PHONE)
        self.assertGreater(self.script(INKED, canvas), 0.002)
        self.screenshot("phone-live", PHONE)
        live.feeder.join()
        self.assertEqual(live.finish(), 0, live.messages)
        until(lambda: figure.get_attribute("data-live") == "ended", "the end is not said")
        self.assertEqual(status.text, "the walk has ended")
        self.assertEqual([entry for entry in self.driver.get_log("browser") if entry["level"] == "SEVERE"], [])
        self.assertEqual(len(self.all("main script:not([type='application/json'])")), 0)
        for line in self.driver.get_log("performance"):
            if '"Network.requestWillBeSent"' in line["message"]:
                self.assertRegex(line["message"], rf'"url":"({live.url}|data:)')

    def test_sweep(self):
        check("sweep", self.walks.rain, "--reference", self.walks.day, *self.walks.truth, "--tolerance-m", 2, "-o",
              self.folder / "sweep", "--sequence-length", "5,10", "--search-range-rad", "0,0.2,0.4", "--vary",
              "enhance=local,standardise")
        # Two motion sources, each against range and against length; and the further setting.
        self.open(self.folder / "sweep/report.html", charts=5)
        self.assertEqual(len(self.all("table.heat")), 2)
        self.assertGreaterEqual(len(self.all("td.best")), 2)
        shades = {cell.value_of_css_property("background-color") for cell in self.all("table.heat td")}
        self.assertGreater(len(shades), 1)

    def test_compare(self):
        runs = [self.walks.evaluated(self.walks.localised(name, *options))
                for name, options in (("short", ["--sequence-length", 3]), ("long", ["--sequence-length", 20]))]
        check("compare", *runs, "-o", self.folder / "comparison", "--segment-s", 2)
        self.open(self.folder / "comparison/report.html", charts=4, matrices=2)
        self.assertEqual(len(self.all("dl.headline > div")), 2)

    def nothing_of_it_runs(self, path, times):
        """The payload is there as text, so many times at least, and nothing of it ran, was built or was fetched."""
        self.driver.get_log("performance")
        self.driver.get(path.as_uri())
        fetched = [line["message"] for line in self.driver.get_log("performance") if '"Network.requestWillBeSent"' in line["message"]]
        for message in fetched:
            self.assertRegex(message, r'"url":"(file|data|about|chrome):')
        self.assertIsNone(self.script("return window.ran ?? null"))
        self.assertEqual(self.all("main svg, main [onerror], main [onload], main script:not([type='application/json'])"), [])
        for picture in self.all("img"):
            self.assertRegex(picture.get_attribute("src") or "data:", "^data:")
        shown = self.script("""return document.body.textContent + document.title
            + [...document.querySelectorAll('[aria-label]')].map(e => e.ariaLabel).join(' ')""")
        self.assertGreaterEqual(shown.count("window.ran"), times)

    def edited(self, path, change):
        document = json.loads(path.read_text())
        change(document)
        path.write_text(json.dumps(document))

    def test_text_of_files_is_text_only(self):
        """Script in the names of files and traverses, in settings, cells and warnings of a run stays text in its reports."""
        walk, route = self.folder / (FILE_PAYLOAD + ".mp4"), self.folder / (FILE_PAYLOAD + ".db")
        shutil.copy(self.walks.rain, walk)
        check("build", self.walks.day, "-o", route, "--truth", self.folder / "day/truth.csv", "--name", PAYLOAD)
        run = self.folder / FILE_PAYLOAD
        check("localise", walk, "--route", route, "-o", run)
        self.nothing_of_it_runs(run / "report.html", 4)  # both names, the traverse's in titles and figures

        config = run / "config.toml"
        config.write_text(config.read_text() + f"\n# {PAYLOAD}\nmask = \"{PAYLOAD}\"\n{PAYLOAD} = 1\n")
        self.edited(run / "summary.json", lambda summary: summary["warnings"].append(PAYLOAD))

        def from_elsewhere(data):
            data["traverses"][0]["pictures"]["raw"] = "https://localhost/raw.png"
            data["pairs"][0]["query"] = (SCREENSHOTS / "none.png").resolve().as_uri()
            data["pairs"][0][PAYLOAD] = PAYLOAD
            data["unit"] = PAYLOAD
            data["motion"] = PAYLOAD
        self.edited(run / "report_data.json", from_elsewhere)
        self.walks.evaluated(run)
        self.nothing_of_it_runs(run / "report.html", 6)

        check("compare", run, self.walks.evaluated(self.walks.localised("plain")), "-o", self.folder / "compared", "--segment-s", 2)
        self.nothing_of_it_runs(self.folder / "compared/report.html", 3)

        odometry = self.folder / "<svg onload=window.ran=1>"
        check("odometry", walk, "-o", odometry)
        def named(summary):
            summary["warnings"].append(PAYLOAD)
            summary["unit"] = summary["step_signal"] = PAYLOAD
        self.edited(odometry / "summary.json", named)
        frames = (odometry / "frames.csv").read_text().splitlines()
        source = frames[0].split(",").index("source")
        cells = frames[2].split(",")
        cells[source] = '"' + PAYLOAD.replace('"', '""') + '"'
        (odometry / "frames.csv").write_text("\n".join(frames[:2] + [",".join(cells)] + frames[3:]) + "\n")
        check("evaluate-odometry", odometry, "--truth", self.folder / "rain/truth.csv")
        self.nothing_of_it_runs(odometry / "report.html", 3)

    def test_a_page_may_fetch_nothing(self):
        """Whatever came to run in a page could send nothing away: the browser is told to refuse it."""
        self.driver.get((self.walks.run / "report.html").as_uri())
        for attempt, rule in (("new Image().src = 'http://localhost:1/x.png'", "img-src"),
                              ("fetch('http://localhost:1/').catch(() => 0)", "connect-src"),
                              ("document.body.append(Object.assign(document.createElement('iframe'), {src: 'http://localhost:1/'}))",
                               "frame-src")):
            refused = self.driver.execute_async_script(f"""
                const done = arguments[0];
                addEventListener('securitypolicyviolation', event => done(event.effectiveDirective), {{once: true}});
                setTimeout(() => done('nothing'), 5000);
                {attempt};""")
            self.assertEqual(refused, rule)
        self.driver.get_log("performance")  # of what was asked for and refused

    def test_hovering_the_curve_shows_the_threshold(self):
        run = self.walks.evaluated(self.walks.localised("hovered"))
        self.driver.get((run / "report.html").as_uri())
        shown = self.script("""
            const figure = document.querySelector('figure.chart'), chart = Chart.getChart(figure.querySelector('canvas'));
            const curve = chart.data.datasets.findIndex(d => d.label === 'every threshold');
            const point = chart.getDatasetMeta(curve).data[0], box = chart.canvas.getBoundingClientRect();
            chart.canvas.dispatchEvent(new MouseEvent('mousemove', {clientX: box.left + point.x, clientY: box.top + point.y, bubbles: true}));
            return new Promise(done => setTimeout(() => done(chart.tooltip.body.flatMap(b => b.lines).join(' ')), 200));""")
        self.assertRegex(shown, r"threshold \d")

    def test_prints(self):
        self.driver.get((self.walks.run / "report.html").as_uri())
        pdf = base64.b64decode(self.driver.execute_cdp_cmd("Page.printToPDF", {"printBackground": False})["data"])
        (SCREENSHOTS / "run.pdf").write_bytes(pdf)
        self.assertTrue(pdf.startswith(b"%PDF"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
