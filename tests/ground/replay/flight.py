"""A flight on disk, with telemetry ten times a second."""

import math

from tests.flightlog.logs import LogMaker
from tests.ground.aircraft import frame

LENGTH_S = 30.0


def data_at(time_s):
    """Return the telemetry of a moment: armed from 5 to 25 s, failsafe from 10 to 12 s."""
    data = frame(armed=5 <= time_s < 25, altitude=100 + time_s)
    data["arduino"]["failsafe"] = 10 <= time_s < 12
    data["location"] = {
        "latitude": 50 + time_s / 1e3,
        "longitude": 14.0 + math.sin(time_s) / 1e3,
        "altitude": 100 + time_s,
    }
    return data


def write_flight(path, length_s=LENGTH_S, gap=(0.0, 0.0)):
    maker = LogMaker()
    maker.writer.add_metadata("flight", {"aircraft": "kite"})
    for number in range(round(length_s * 10) + 1):
        time_s = number / 10
        if time_s == 20.0:
            maker.add(time_s, "black_box.mark", text="thermal \x1b[2J")
        if not gap[0] < time_s < gap[1]:
            maker.add(time_s, "up.telemetry.update", **data_at(time_s), _beacon=1000 + number)
    path.write_bytes(maker.finished())
    return path
