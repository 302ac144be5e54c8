"""What a MAVLink client costs: packing, per second of 100 messages, and an answer's way."""

import time
from collections.abc import Iterable
from statistics import median
from typing import Any

from twisted.internet.task import Clock

from bench.table import LeftOutError, Row, limited
from up.protocols.general_message import GeneralMessage
from up_mavlink.address import read_address
from up_mavlink.dialect import is_available
from up_mavlink.endpoint import Endpoint, Settings
from up_mavlink.personas import BY_NAME

MESSAGES_HZ, FRAMES_HZ = 100, 10
SECONDS, QUICK_SECONDS = 60, 5
MAX_PERCENT = 1.0
MAX_ANSWER_MS = 100.0
STREAMED = (30, 33, 24, 74, 65, 36, 1, 147, 245, 2)
"""Ten messages: attitude, position, GPS, HUD, receiver, servos, status, battery, landed, time."""
RETURN_TO_LAUNCH = 20
FRAME = {
    "armed": True, "in_flight": True, "flight_mode": "SETPOINT", "vetoes": [],
    "flight_control": {"mode": "LOITER"}, "system": {"clock_ms": 1000},
    "orientation": {"roll": 9.0, "pitch": -4.0, "yaw": 350.0},
    "rates": {"roll": 0.0, "pitch": 0.0, "yaw": 10.0},
    "navigation": {"latitude": 48.0, "longitude": 17.5, "altitude": 250.5, "height": 50.0,
                   "speed": 10.0, "course": 90.0, "climb": 1.5, "heading": 95.0, "airspeed": 12.0},
    "location": {"latitude": 48.0, "longitude": 17.5, "altitude": 251.0},
    "rx": dict.fromkeys(("ailerons", "elevator", "throttle", "rudder", "aux1", "aux2"), 1500),
    "servo": dict.fromkeys(("ailerons", "elevator", "throttle", "rudder"), 1500),
    "arduino": {"flight_battery_v": 11.1, "imu_valid": True, "receiver_valid": True},
    "age_ms": {"location": 10, "navigation": 10, "orientation": 5, "rx": 5, "servo": 5},
}  # fmt: skip


class _Port:
    """Carries out every Command immediately."""

    problem = ""
    endpoint: Any = None

    def send(self, message: GeneralMessage) -> None:
        self.endpoint.on_message(GeneralMessage("up.ack", {"id": message.id}))


def rows(quick: bool) -> Iterable[Row]:
    """Yield the figures of one client."""
    if not is_available():
        raise LeftOutError("pymavlink is not installed")
    from pymavlink.dialects.v20 import common as m

    clock, port, sent = Clock(), _Port(), list[bytes]()
    settings = Settings(read_address("udpin:127.0.0.1:0"), BY_NAME["ardupilot"])
    reactor: Any = clock
    port.endpoint = endpoint = Endpoint(reactor, settings, port)
    session = endpoint.open("bench", sent.append, endpoint.codec())
    assert session is not None
    ground = m.MAVLink(None, srcSystem=255)

    def command(number: int, *params: float) -> bytes:
        fields = [*params, *[0.0] * (7 - len(params))]
        return bytes(m.MAVLink_command_long_message(1, 1, number, 0, *fields).pack(ground))

    for number in STREAMED:
        session.on_bytes(command(511, number, 1e6 / FRAMES_HZ))
    sent.clear()
    seconds = QUICK_SECONDS if quick else SECONDS
    began = time.process_time()
    for _ in range(seconds * FRAMES_HZ):
        clock.advance(1 / FRAMES_HZ)
        endpoint.on_frame(FRAME, 1)
    cpu_s = time.process_time() - began
    rate_hz = len(sent) / seconds
    percent = 100 * cpu_s / seconds * MESSAGES_HZ / rate_hz
    yield limited("MAVLink client, 100 messages/s: CPU", "%", percent, MAX_PERCENT)
    delays_ms = []
    for _ in range(200):
        clock.advance(1.0)
        packet = command(RETURN_TO_LAUNCH)
        began = time.perf_counter()
        session.on_bytes(packet)
        delays_ms.append((time.perf_counter() - began) * 1000)
    what = "MAVLink command to its answer, without the aircraft"
    yield limited(what, "ms", median(delays_ms), MAX_ANSWER_MS)
