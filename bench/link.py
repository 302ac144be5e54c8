"""What the link to the proxy costs: MB an hour at IP level, and CPU of a packed frame.

Each flight is flown twice: with all layers together (packed telemetry, end-to-end envelope, TLS on
both hops), and plain.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterable
from itertools import count
from typing import Any

from mission_control_cog.thinning import Thinning

from bench.table import LeftOutError, Row, compared
from bench.timing import Limit, rounds_ns
from up.protocols.binary_line import to_body, to_line
from up.protocols.general_message import decode, encode
from up.protocols.packed_dictionary import DICTIONARY
from up.protocols.packed_telemetry import Packer, Unpacker

SECONDS, QUICK_SECONDS = 60.0, 12.0
ROUNDS, CALLS = 5, 400
LIMIT_S = 180.0
FLIGHTS = (
    ("10 Hz, everything shown", "watched", None, 11.0, 9.9),
    ("budget 5 MB/h", "watched", 5.0, 5.0, 4.0),
    ("budget 2.7 MB/h", "watched", 2.7, 2.7, 4.0),
    ("no ground station", "unwatched", None, 0.2, 0.0),
)
SENT_US, RECEIVED_US = 100.0, 30.0


def rows(quick: bool = False) -> Iterable[Row]:
    yield from cpu_rows()
    for tool in ("unshare", "ip", "nft"):
        if os.geteuid() or shutil.which(tool) is None:
            raise LeftOutError(f"the uplink's data: needs root and {tool}")
    for what, watched, budget, limit, least_hz in FLIGHTS:
        flights = {each: fly(watched, each, budget, quick) for each in ("protected", "plain")}
        ours, plain = (each["mb_per_hour"] for each in flights.values())
        rate_hz = flights["protected"]["frames_hz"]
        yield Row(
            f"uplink at IP level, all layers, {what}",
            f"{ours:.2f} MB/h, {rate_hz:.1f} frames/s",
            "plain",
            f"{plain:.2f} MB/h, {flights['plain']['frames_hz']:.1f} frames/s",
            f"{ours / plain:.2f}x",
            target=f"<= {limit:g} MB/h" + (f" at {least_hz:g} Hz" if least_hz else ""),
            met=ours <= limit and rate_hz >= least_hz,
        )


def fly(watched: str, security: str, budget: float | None, quick: bool) -> dict[str, float]:
    """Return what the uplink of a flight has cost: MB an hour, and its frames a second."""
    command = ["unshare", "--net", sys.executable, "-m", "bench.link_flight"]
    command += [str(QUICK_SECONDS if quick else SECONDS), watched, security]
    command += [] if budget is None else [str(budget)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT_S, check=False)
    if done.returncode:
        raise RuntimeError(f"link, {security}: {done.stderr.strip().splitlines()[-1]}")
    found = json.loads(done.stdout)
    return {
        "mb_per_hour": found["bytes"] / found["seconds"] * 3600 / 1e6,
        "frames_hz": found["frames"] / found["seconds"],
    }


def cpu_rows() -> Iterable[Row]:
    """Yield the CPU of a frame, packed beside plain JSON, sent and received."""
    message: dict[str, Any] = json.loads(DICTIONARY)
    name, content, number = message["name"], message["data"], count()
    thinning, packer = Thinning(), Packer()

    def changed() -> tuple[dict[str, Any], float]:
        tick = next(number)
        orientation = {"roll": tick % 90 / 1.7, "pitch": tick % 40 / 1.3, "yaw": tick / 3.1}
        return {**content, "orientation": orientation, "altitude": tick / 7}, tick / 10

    def plain() -> bytes:
        return encode(name, changed()[0], None, 7)

    def packed() -> bytes:
        new, now_s = changed()
        frame = encode(name, thinning.apply(new, now_s), None, 7, is_compact=True)
        return to_line(packer.pack(frame[:-1], now_s))

    line, unpacker = plain(), Unpacker()
    packer.restart()
    body = packed()[:-1]
    works = (packed, plain, lambda: decode(unpacker.unpack(to_body(body))), lambda: decode(line))
    us = [[ns / 1000 for ns in each] for each in rounds_ns(works, ROUNDS, CALLS)]
    for what, ours, theirs, limit in (
        ("sent", us[0], us[1], SENT_US),
        ("received", us[2], us[3], RECEIVED_US),
    ):
        yield compared(f"CPU of a frame, packed, {what}", "us", ours, "plain JSON", theirs)
        more = [mine - other for mine, other in zip(ours, theirs, strict=True)]
        yield compared(f"CPU of packing a frame, {what}", "us", more, limit=Limit(limit))
