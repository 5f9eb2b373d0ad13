"""`retrace follow --view` on pictures that a test hands over as it likes."""

import pathlib
import subprocess
import threading
import time

from support.retrace_cli import RETRACE

REQUEST = "GET {} HTTP/1.1\r\nHost: {}\r\nAccept-Encoding: gzip\r\n\r\n"


def grey_y4m(folder):
    """The header and the pictures of a folder of PGM images, as Y4M."""
    pictures = []
    for i in range(len(list(pathlib.Path(folder).glob("*.pgm")))):
        head, _, pixels = (folder / f"{i}.pgm").read_bytes().partition(b" 255\n")
        width, height = map(int, head.split()[1:3])
        pictures.append(b"FRAME\n" + pixels)
    return b"YUV4MPEG2 W%d H%d F30:1 Cmono\n" % (width, height), pictures


def video_y4m(path):
    """The same of a video."""
    raw = subprocess.run(["ffmpeg", "-v", "error", "-i", path, "-pix_fmt", "yuv420p", "-f", "yuv4mpegpipe", "-"],
                         capture_output=True, check=True).stdout
    header, _, rest = raw.partition(b"\n")
    sizes = {field[:1]: field[1:] for field in header.split()[1:]}
    size = int(sizes[b"W"]) * int(sizes[b"H"]) * 3 // 2 + len(b"FRAME\n")
    return header + b"\n", [rest[i:i + size] for i in range(0, len(rest), size)]


class LiveFollow:
    """A run that is under way. `feed` gives it pictures; its lines are in `lines` once it is over."""

    def __init__(self, y4m, route, *arguments):
        self.header, self.pictures = y4m
        self.process = subprocess.Popen([RETRACE, "follow", "-", "--route", str(route), "--view", "0", *map(str, arguments)],
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        said = self.process.stderr.readline().decode()
        if not said.startswith("the page is at http://"):
            self.process.kill()
            raise AssertionError(said + self.process.stderr.read().decode())
        self.url = said.split()[-1]
        self.address, self.port = self.url[len("http://"):-1].rsplit(":", 1)
        self.port = int(self.port)
        self.lines, self.messages = [], []
        self.readers = [threading.Thread(target=self.keep, args=pair) for pair in
                        ((self.process.stdout, self.lines), (self.process.stderr, self.messages))]
        for reader in self.readers:
            reader.start()
        self.process.stdin.write(self.header)

    def keep(self, stream, lines):
        lines.extend(line.decode().rstrip("\n") for line in stream)

    def feed(self, pictures=None, rate_hz=None):
        """Hands over pictures, all by default, at a rate or as fast as they are taken."""
        for picture in self.pictures if pictures is None else pictures:
            self.process.stdin.write(picture)
            self.process.stdin.flush()
            if rate_hz:
                time.sleep(1 / rate_hz)

    def feed_on(self, **options):
        """The same in a thread."""
        def until_over():
            try:
                self.feed(**options)
            except (BrokenPipeError, ValueError):  # it ended before
                pass
        self.feeder = threading.Thread(target=until_over)
        self.feeder.start()
        return self.feeder

    def finish(self, timeout=60):
        """No more pictures: waits for the end and returns the exit code."""
        try:
            self.process.stdin.close()
        except BrokenPipeError:
            pass
        code = self.process.wait(timeout)
        for reader in self.readers:
            reader.join()
        return code

    def stop(self):
        """For the end of a test that failed."""
        self.process.kill()
        for stream in (self.process.stdin, self.process.stdout, self.process.stderr):
            try:
                stream.close()
            except (BrokenPipeError, RuntimeError):
                pass
        self.process.wait()
