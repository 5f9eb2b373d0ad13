#!/usr/bin/env python3
"""The live page of `retrace follow --view`: what it serves, to whom, and that nobody who asks holds the walk up."""

import http.client
import json
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.live_follow import REQUEST, LiveFollow, grey_y4m  # noqa: E402
from support.retrace_cli import RETRACE, check, draw_walk, run, street, write_truth  # noqa: E402

SLOW = 200
PATIENCE_S = 60  # a run that hangs is found by this, however slow the machine


def spoken(client):
    """Everything that a socket still has to say."""
    client.settimeout(PATIENCE_S)
    text = b""
    try:
        while part := client.recv(1 << 16):
            text += part
    except ConnectionResetError:
        pass
    return text


class Listener:
    """Reads what a socket says as it comes."""

    def __init__(self, client):
        self.text = b""
        self.thread = threading.Thread(target=self.listen, args=(client,))
        self.thread.start()

    def listen(self, client):
        self.text = spoken(client)

    def said(self):
        self.thread.join()
        return self.text


def events(text):
    """The data of the events in an answer, without the chunks' sizes around them."""
    head, _, body = text.partition(b"\r\n\r\n")
    assert b"200 OK" in head.splitlines()[0] and b"text/event-stream" in head, head
    plain = b""
    while body:
        size, _, body = body.partition(b"\r\n")
        count = int(size or b"0", 16)
        if count == 0 or len(body) < count:
            break
        plain, body = plain + body[:count], body[count + 2:]
    return [one.decode() for one in plain.split(b"\n\n") if one and not one.startswith(b":")]


def moments(text):
    return [json.loads(one[len("data: "):]) for one in events(text) if one.startswith("data: ")]


class ViewTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="retrace-view-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        wall, reference_at, query_at = street(), [1.5 * i for i in range(400)], [i for i in range(600)]
        reference = draw_walk(cls.folder / "reference", wall, reference_at)
        cls.query = draw_walk(cls.folder / "query", wall, query_at, gain=0.7)
        truth = write_truth(cls.folder / "reference.csv", reference_at)
        cls.route, names = cls.folder / "route.db", cls.folder / "names.csv"
        names.write_text("distance_m,name\n3,</script><script>alert(1)</script>\n")
        check("build", reference, "-o", cls.route, "--truth", truth, "--places", names)
        cls.y4m = grey_y4m(cls.query)
        cls.lines = subprocess.run([RETRACE, "follow", "-", "--route", cls.route], input=cls.y4m[0] + b"".join(cls.y4m[1]),
                                   capture_output=True, check=True).stdout.decode().splitlines()

    def follow(self, *arguments):
        live = LiveFollow(self.y4m, self.route, *arguments)
        self.addCleanup(live.stop)
        return live

    def client(self, live, request=None, narrow=False):
        """A socket that has asked for the events, or sent `request`."""
        client = socket.socket()
        self.addCleanup(client.close)
        if narrow:
            client.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        client.settimeout(PATIENCE_S)
        client.connect((live.address, live.port))
        client.sendall(REQUEST.format("/events", live.address).encode() if request is None else request)
        return client

    def ask(self, live, path, method="GET", **headers):
        connection = http.client.HTTPConnection(live.address, live.port, timeout=PATIENCE_S)
        self.addCleanup(connection.close)
        connection.request(method, path, headers={name.replace("_", "-"): value for name, value in headers.items()})
        answer = connection.getresponse()
        return answer, answer.read()

    def over(self, live):
        """The run ends well, with the same lines as without anyone who looks."""
        self.assertEqual(live.finish(PATIENCE_S), 0, live.messages)
        self.assertEqual(live.lines, self.lines)
        with self.assertRaises(ConnectionRefusedError):
            socket.create_connection((live.address, live.port))

    def test_serves_the_page_and_the_walk_as_it_goes(self):
        live = self.follow()
        self.assertEqual(live.address, "127.0.0.1")
        answer, page = self.ask(live, "/")
        self.assertEqual((answer.status, answer.getheader("Content-Type")), (200, "text/html; charset=utf-8"))
        self.assertIn("default-src 'none'", answer.getheader("Content-Security-Policy"))
        self.assertIn(b'data-kind="player"', page)
        self.assertNotIn(b"<script>alert", page)
        listener = Listener(self.client(live))
        live.feed(rate_hz=150)
        self.assertEqual(live.finish(PATIENCE_S), 0)
        self.assertEqual(live.lines, self.lines)
        told = events(text := listener.said())
        self.assertEqual(told[-1], "event: end\ndata:")
        self.assertGreater(len(told), 10)
        said = [json.loads(line) for line in self.lines]
        for moment in moments(text):  # each is a line of the output, with a picture
            line = said[moment["frame"]]
            self.assertEqual(moment["state"], line["state"])
            self.assertEqual("distance_m" in moment, "distance_m" in line)
            if "distance_m" in line:
                self.assertAlmostEqual(moment["distance_m"], line["distance_m"], delta=0.001)
                self.assertRegex(moment["reference"], r"^references/0/\d+\.jpg$")
            self.assertTrue(moment["query"].startswith("data:image/jpeg;base64,"))
        frames = [moment["frame"] for moment in moments(text)]
        self.assertEqual(frames, sorted(set(frames)))
        self.assertIn("found", [moment.get("said", {}).get("event") for moment in moments(text)])

    def test_a_page_s_pictures_and_nothing_else(self):
        live = self.follow()
        answer, picture = self.ask(live, "/references/0/3.jpg")
        self.assertEqual((answer.status, answer.getheader("Content-Type"), picture[:2]), (200, "image/jpeg", b"\xff\xd8"))
        for path in ("/references/1/0.jpg", "/references/0/99999.jpg", "/references/0/99999999999999999999999.jpg",
                     "/references/0/-1.jpg", "/references/0/3.png", "/references/0/3.jpg.exe", "/references/", "/references/0",
                     "/../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "//etc/passwd", "/follow.jsonl", "/" + "a" * 3000, "/%00"):
            self.assertEqual(self.ask(live, path)[0].status, 404, path)
        self.over_after_feeding(live)

    def over_after_feeding(self, live):
        live.feed()
        self.over(live)

    def test_bad_requests_do_no_harm(self):
        live = self.follow()
        for method in ("POST", "PUT", "DELETE", "PATCH", "OPTIONS", "HEAD", "BREW"):
            answer, _ = self.ask(live, "/", method)
            self.assertIn(answer.status, (400, 405), method)
        # A page of another site that has its name lead here.
        self.assertEqual(self.ask(live, "/", Host="evil.example")[0].status, 403)
        self.assertEqual(self.ask(live, "/", Host=f"127.evil.example:{live.port}")[0].status, 403)
        self.assertEqual(self.ask(live, "/events", Host=f"evil.example:{live.port}")[0].status, 403)
        self.assertEqual(self.ask(live, "/", Host=f"localhost:{live.port}")[0].status, 200)
        self.assertEqual(self.ask(live, "/", Range="bytes=0-10,5-3,-")[0].status // 100 in (2, 4), True)
        head = f"Host: {live.address}\r\n".encode()
        for request in (b"\r\n\r\n", b"\0" * 5000, bytes(range(256)) * 20, b"GET\r\n\r\n", b"GET / HTTP/9.9\r\n" + head + b"\r\n",
                        b"GET / HTTP/1.1\r\n\r\n", b"GET /" + b"x" * 100000 + b" HTTP/1.1\r\n" + head + b"\r\n",
                        b"GET / HTTP/1.1\r\n" + head + b"A: " + b"b" * 100000 + b"\r\n\r\n",
                        b"GET / HTTP/1.1\r\n" + head + b"A: b\r\n" * 5000 + b"\r\n",
                        b"POST / HTTP/1.1\r\n" + head + b"Content-Length: 99999999999999999999\r\n\r\n" + b"x" * 5000,
                        b"POST / HTTP/1.1\r\n" + head + b"Transfer-Encoding: chunked\r\n\r\nffffffffffffffff\r\nx"):
            try:
                spoken(self.client(live, request))
            except (BrokenPipeError, ConnectionResetError):  # hung up on before all of it was sent
                pass
            self.assertEqual(self.ask(live, "/")[0].status, 200, request[:40])
        try:  # headers without end are cut off
            answer = spoken(self.client(live, b"GET / HTTP/1.1\r\n" + head + b"A: b\r\n" * 200000 + b"\r\n"))
        except (BrokenPipeError, ConnectionResetError):
            answer = b""
        self.assertNotIn(b"200 OK", answer)
        half = [self.client(live, b"GET / HT") for _ in range(20)]
        self.over_after_feeding(live)
        for client in half:
            self.assertEqual(spoken(client).count(b"200 OK"), 0)

    def test_slow_clients_wait_for_nobody_and_nobody_for_them(self):
        live = self.follow()
        began = time.monotonic()
        slow = [self.client(live, narrow=True) for _ in range(SLOW)]
        self.assertLess(time.monotonic() - began, 5)  # a connection that has to be tried again takes a second
        quick = Listener(self.client(live))
        self.assertEqual(self.ask(live, "/")[0].status, 200)  # there is room for more
        live.feed(rate_hz=60)
        self.over(live)  # none of them has read a byte
        seen = [moment["frame"] for moment in moments(quick.said())]
        self.assertGreater(len(seen), 50)
        for client in slow[::20]:
            frames = [moment["frame"] for moment in moments(spoken(client))]
            self.assertLess(len(frames), len(seen))
            self.assertEqual(frames, sorted(set(frames)))

    def test_who_wakes_up_is_told_the_newest_next(self):
        live = self.follow()
        sleeper, quick = self.client(live, narrow=True), Listener(self.client(live))
        began, fed = time.monotonic(), 0
        while time.monotonic() < began + 5 and fed < 300:  # after ten seconds the sleeper would be dropped
            live.feed(live.pictures[fed:fed + 1], rate_hz=60)
            fed += 1
        sleeper = Listener(sleeper)
        live.feed(live.pictures[fed:], rate_hz=100)
        self.over(live)
        everything, woken = moments(quick.said()), moments(sleeper.said())
        self.assertEqual(events(sleeper.said())[-1], "event: end\ndata:")
        frames = [moment["frame"] for moment in woken]
        left_out = [sum(a < moment["frame"] < b for moment in everything) for a, b in zip(frames, frames[1:])]
        self.assertGreater(max(left_out), 3)
        self.assertEqual(frames[-1], everything[-1]["frame"])

    def test_too_many_are_sent_away(self):
        live = self.follow()
        clients = [self.client(live, narrow=True) for _ in range(250)]
        deadline = time.monotonic() + PATIENCE_S
        while (answer := self.ask(live, "/")[0].status) != 503 and time.monotonic() < deadline:
            time.sleep(0.05)  # until all of those are being answered
        self.assertEqual(answer, 503)
        for client in clients[:50]:
            client.close()
        live.feed(rate_hz=300)  # writing to them shows that they are gone
        while (answer := self.ask(live, "/")[0].status) == 503 and time.monotonic() < deadline:
            time.sleep(0.05)
        self.assertEqual(answer, 200)
        self.over(live)

    def test_ends_with_the_run(self):
        for number, code in ((signal.SIGINT, 0), (signal.SIGTERM, 0)):
            live = self.follow()
            reader, asleep, half = self.client(live), self.client(live, narrow=True), self.client(live, b"GET /")
            feeder = live.feed_on(rate_hz=60)
            deadline = time.monotonic() + PATIENCE_S
            while len(live.lines) < 100 and time.monotonic() < deadline:
                time.sleep(0.02)
            live.process.send_signal(number)
            self.assertEqual(live.process.wait(PATIENCE_S), code)
            feeder.join()
            live.finish()
            self.assertEqual(live.lines, self.lines[:len(live.lines)])
            self.assertEqual(events(spoken(reader))[-1], "event: end\ndata:")
            self.assertEqual(spoken(half), b"")
            spoken(asleep)
        # Who closes the lines ends the run, as without a page.
        process = subprocess.Popen([RETRACE, "follow", str(self.query), "--route", str(self.route), "--view", "0"],
                                   stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        process.stdout.readline()
        process.stdout.close()
        self.assertIn(process.wait(PATIENCE_S), (-signal.SIGPIPE, 0))

    def test_no_other_address_unless_asked(self):
        live = self.follow()
        for address in ("127.0.0.2", "::1"):
            with self.assertRaises(OSError):
                socket.create_connection((address, live.port), timeout=PATIENCE_S)
        taken = run("follow", self.query, "--route", self.route, "--view", live.port)
        self.assertEqual((taken.returncode, len(taken.stderr.splitlines())), (1, 1), taken.stderr)
        self.assertIn(f"--view {live.port}", taken.stderr)
        self.over_after_feeding(live)
        elsewhere = self.follow("--view-address", "127.0.0.2")
        self.assertEqual(self.ask(elsewhere, "/")[0].status, 200)
        self.over_after_feeding(elsewhere)

    def test_is_refused_where_it_cannot_be(self):
        for arguments, says in ((("--view-address", "127.0.0.1"), "--view"), (("--view", "-1"), "--view"), (("--view", "65536"), "--view"),
                                (("--view", "x"), "--view")):
            done = run("follow", self.query, "--route", self.route, *arguments)
            self.assertEqual((done.returncode, done.stdout), (2, ""), arguments)
            self.assertIn(says, done.stderr)
        done = run("follow", self.query, "--route", self.route, "--view", 0, "--view-address", "192.0.2.1")
        self.assertEqual((done.returncode, done.stdout, len(done.stderr.splitlines())), (1, "", 1), done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
