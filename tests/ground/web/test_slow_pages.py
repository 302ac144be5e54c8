"""Pages that read slowly or not at all, over real sockets."""

import base64
import json
import os
import socket
import struct
import time
from itertools import pairwise

from tests.ground import aircraft as flying
from tests.ground.aircraft import Aircraft, frame, until
from tests.ground.web.page import Serve

TEXT, LONG = 0x1, 126


class SlowPage:
    """A WebSocket that reads on request."""

    def __init__(self, port):
        self.socket = socket.socket()
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        self.socket.settimeout(30)
        self.socket.connect(("127.0.0.1", port))
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall(
            f"GET /link HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\n"
            f"Connection: Upgrade\r\nSec-WebSocket-Key: {key}\r\n"
            "Sec-WebSocket-Version: 13\r\n\r\n".encode()
        )
        self.file = self.socket.makefile("rb")
        assert b"101" in self.file.readline()
        while self.file.readline() != b"\r\n":
            pass
        self.send(type="hello", name="slow")
        self.send(type="watch", aircraft=flying.NAME)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.file.close()
        self.socket.close()

    def send(self, **fields):
        payload = json.dumps(fields).encode()
        mask = os.urandom(4)
        masked = bytes(each ^ mask[place % 4] for place, each in enumerate(payload))
        self.socket.sendall(bytes((0x81, 0x80 | len(payload))) + mask + masked)

    def next(self):
        while True:
            kind, size = self.file.read(2)
            if size == LONG:
                (size,) = struct.unpack(">H", self.file.read(2))
            payload = self.file.read(size)
            if kind & 0x0F == TEXT:
                return json.loads(payload)

    def next_of(self, kind):
        while (message := self.next())["type"] != kind:
            pass
        return message


def test_a_page_that_reads_late_gets_the_newest_with_its_true_age(proxy, tmp_path):
    data = frame(counters={f"part{number}": {"count": number} for number in range(400)})
    with (
        Aircraft(proxy.airborne_port, data=data) as aircraft,
        Serve(tmp_path, proxy.ground_port) as server,
        SlowPage(server.port) as page,
    ):
        first = page.next_of("frame")["beacon"]
        # It reads nothing while much more is sent than any buffer on the way holds.
        until(lambda: aircraft.beacon > first + 60, "many frames")
        aircraft.is_quiet = True
        newest = aircraft.beacon
        # So that there is an age: the last frame waits where it is.
        quiet_s = time.monotonic()
        until(lambda: time.monotonic() > quiet_s + 0.3, "a moment")
        got = []
        while not got or got[-1]["beacon"] < newest:
            got.append(page.next_of("frame"))
        assert len(got) < 30, "a queue of old frames came"
        # Frames that waited in the server report it; one that did not is as old as its transit.
        assert max(each["age_ms"] for each in got) > 5
        skipped = [later["beacon"] - each["beacon"] for each, later in pairwise(got)]
        assert max(skipped) > 20


def test_a_page_that_reads_nothing_slows_nobody(proxy, tmp_path):
    with (
        Aircraft(proxy.airborne_port) as aircraft,
        Serve(tmp_path, proxy.ground_port) as server,
        SlowPage(server.port),
        SlowPage(server.port) as good,
    ):
        beacons = [good.next_of("frame")["beacon"] for _ in range(60)]
        # On a busy machine a frame may be replaced by the next; none comes twice or late.
        assert beacons == sorted(set(beacons))
        assert beacons[-1] - beacons[0] < 90
        assert aircraft.beacon >= beacons[-1]
