"""Where am I, now: OpenCV's camera, a line each time the place changes. Ctrl-C ends it.

    python3 live.py route.db [camera number, or a video]
"""

import sys
import time

import cv2

import retrace

source = sys.argv[2] if len(sys.argv) > 2 else "0"
camera = cv2.VideoCapture(int(source) if source.isdigit() else source)
follower = retrace.Follower(retrace.Route.open(sys.argv[1]))
began, told = time.monotonic(), None
try:
    while True:
        there_is, picture = camera.read()
        if not there_is:
            break
        live = source.isdigit()
        now = follower.push(picture, time.monotonic() - began if live else camera.get(cv2.CAP_PROP_POS_MSEC) / 1000 + 1e-6)
        place = (now["state"], round(now.get("distance_m", 0)))
        if place != told:
            told = place
            print(f"{now['time_s']:7.1f} s  {now['state']}", f"{now['distance_m']:.1f} m, {now['probability']:.2f}" if "distance_m" in now else "")
except KeyboardInterrupt:
    pass
