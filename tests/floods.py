"""How long telemetry pauses while a peer floods the daemon: the longest gap between two frames.

``python -m tests.floods`` prints the figures; they depend on the machine, so no test asserts them.
The tests of each rule count work instead.
"""

from __future__ import annotations

import contextlib
import itertools
import socket
import struct
import subprocess
import sys
import time

from bench.daemon import ROOT, daemon
from bench.ground import Ground
from bench.processes import environment, wait_until
from bench.startup import wait_for_ports

ROUNDS = 3
SECONDS = 3.0
SETTLE_S = 1.0
KEYS = b",".join(b'"%x":0' % number for number in range(2000))
PLACE = '{"name":"up.location.update","data":{"latitude":50.1,"longitude":14.4},"id":"%d"}\n'
RECORD = '{"name":"black_box.record","data":{"topic":"bench","content":{"x":1}},"id":"%d"}\n'
MESSAGES = {
    "locations": [(PLACE % number).encode() for number in range(1000)],
    "refused records": [(RECORD % number).encode() for number in range(1000)],
    "repeated keys in 16 KiB": [b'{"name":"a","data":{' + KEYS + b',"7cf":0}}\n'],
    "empty datagrams": [b""],
    "orientation": [struct.pack(">6f", 1, 2, 3, 4, 5, 6)],
}
FLOODS = (
    # what, transport, messages a second
    ("locations", "tcp", 10_000),
    ("locations", "udp", 10_000),
    ("refused records", "udp", 10_000),
    ("repeated keys in 16 KiB", "tcp", 20),
    ("repeated keys in 16 KiB", "udp", 20),
    ("empty datagrams", "udp", 100_000),
    ("orientation", "tcp", 20_000),
    ("orientation", "udp", 20_000),
)


def send(what: str, transport: str, port: int, rate_hz: int, seconds: float) -> None:
    """Send a flood to a port of this computer, in bursts of 10 ms."""
    kind = socket.SOCK_STREAM if transport == "tcp" else socket.SOCK_DGRAM
    burst = max(1, rate_hz // 100)
    endless = itertools.cycle(MESSAGES[what])
    with socket.socket(socket.AF_INET, kind) as peer, contextlib.suppress(OSError):
        peer.connect(("127.0.0.1", port))
        began_s = time.monotonic()
        sent = 0
        while (now_s := time.monotonic() - began_s) < seconds:
            if sent > now_s * rate_hz:
                time.sleep(0.001)
                continue
            messages = [next(endless) for _ in range(burst)]
            sent += burst
            if transport == "tcp":
                peer.sendall(b"".join(messages))
            else:
                for message in messages:
                    peer.send(message)


def longest_gap_ms(what: str, transport: str, rate_hz: int) -> float:
    """Return the longest time between two frames of telemetry, before, in and after a flood."""
    with Ground() as ground, daemon(proxy_port=ground.port) as running:
        wait_for_ports(running.ports)
        wait_until(lambda: ground.frames > 5, "telemetry on the ground")
        time.sleep(SETTLE_S)
        port = running.ports.orientation if what == "orientation" else running.ports.general
        words = (what, transport, str(port), str(rate_hz))
        command = (sys.executable, "-m", "tests.floods", *words)
        with subprocess.Popen(command, cwd=ROOT, env=environment()) as sender:
            frames, seen_s = ground.frames, time.monotonic()
            longest_s, end_s = 0.0, seen_s + SECONDS + 2 * SETTLE_S
            while (now_s := time.monotonic()) < end_s:
                longest_s = max(longest_s, now_s - seen_s)
                if ground.frames != frames:
                    frames, seen_s = ground.frames, now_s
                time.sleep(0.001)
        if sender.returncode:
            raise RuntimeError("the sender failed")
        return longest_s * 1000


def main() -> None:
    """Print the least of some rounds, as noise only adds; the first row is that noise alone."""
    for what, transport, rate_hz in (("locations", "tcp", 1), *FLOODS):
        gaps_ms = sorted(longest_gap_ms(what, transport, rate_hz) for _ in range(ROUNDS))
        spread = " ".join(f"{gap_ms:.0f}" for gap_ms in gaps_ms)
        print(f"{rate_hz:6d} Hz {what}, {transport}: {spread} ms", flush=True)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        send(sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4]), SECONDS)
    else:
        main()
