"""Live telemetry for Foxglove: CPU of `up-ground foxglove` for a frame, while one client watches.

The peer is the same program with a plain WebSocket in place of Foxglove's server; both run side by
side on the frames of one aircraft.
"""

import json
import sys
import tempfile
from collections.abc import Iterable, Sequence
from importlib.util import find_spec
from itertools import count, pairwise
from pathlib import Path
from typing import Any

from twisted.internet.error import ConnectError
from twisted.internet.protocol import Factory, Protocol
from twisted.internet.task import LoopingCall

from bench.daemon import ROOT
from bench.processes import cpu_s, running
from bench.table import LeftOutError, Row, compared
from bench.timing import Limit
from tests.ground.foxglove_client import Client, connected, ended
from tests.support.reactor import reactor, run_in_reactor, sleep, until
from up.protocols.general_message import encode
from up.protocols.packed_dictionary import DICTIONARY
from up_simulator.harness.ports import choose_ports

SECONDS, QUICK_SECONDS = 5.0, 2.0
ROUNDS, QUICK_ROUNDS = 12, 3
PERIOD_S = 0.1
TRIES = 300
TARGET = Limit(1.5)
LOOPBACK = "127.0.0.1"
UP_GROUND = Path(sys.executable).with_name("up-ground")


class Aircraft(Factory):
    """Sends the same changing frame to all grounds, ten times a second."""

    noisy = False

    def __init__(self) -> None:
        self.grounds: list[Any] = []
        self._numbers = count(1)
        self._frame: dict[str, Any] = json.loads(DICTIONARY)

    def buildProtocol(self, addr: Any) -> Protocol:  # noqa: N802 - Twisted's name
        ground = Protocol()
        self.grounds.append(ground)
        return ground

    def send(self) -> None:
        tick, data = next(self._numbers), self._frame["data"]
        system = {**data["system"], "clock_ms": round(reactor.seconds() * 1000)}
        orientation = {"roll": tick % 90 / 1.7, "pitch": tick % 40 / 1.3, "yaw": tick / 3.1 % 360}
        data = {**data, "system": system, "orientation": orientation, "altitude": tick / 7}
        line = encode(self._frame["name"], data, None, tick)
        for ground in self.grounds:
            if ground.connected:
                ground.transport.write(line)


async def client_of(port: int) -> Any:
    """Return a client of a server that is starting."""
    for _ in range(TRIES):
        try:
            return await connected(f"{LOOPBACK}:{port}")
        except ConnectError:
            await sleep(PERIOD_S)
    raise RuntimeError(f"a server did not start within {TRIES * PERIOD_S:g} s")


def frames_at(client: Client) -> int:
    """Return the number of frames that a client got, from either server."""
    plain = sum("orientation" in each for each in client.told)
    return plain or len(client.taken.get(1, ()))


async def measure(folder: str, seconds: float, rounds: int) -> list[list[float]]:
    """Return the CPU microseconds of a frame of both programs, in each round."""
    aircraft, ports = Aircraft(), choose_ports(any_ports=True)
    listening = reactor.listenTCP(0, aircraft, interface=LOOPBACK)
    port = str(listening.getHost().port)
    state = ("env", f"XDG_STATE_HOME={folder}")
    address = (LOOPBACK, "--port", port, "--direct", "foxglove")
    ours = (*state, UP_GROUND, "--host", *address, "--listen", f"{LOOPBACK}:{ports.page}")
    peers = (*state, sys.executable, "-m", "bench.foxglove_peer", port, str(ports.uplink))
    loop = LoopingCall(aircraft.send)
    with running(ours) as mine, running(peers, cwd=ROOT) as peer:
        clients = [await client_of(each) for each in (ports.page, ports.uplink)]
        await clients[0].subscribe()
        loop.start(PERIOD_S)
        await until(lambda: all(map(frames_at, clients)), what="frames of both")

        def spent() -> list[tuple[float, int]]:
            pids = (mine.pid, peer.pid)
            return [(cpu_s(pid), frames_at(at)) for pid, at in zip(pids, clients, strict=True)]

        figures = [spent()]
        for _ in range(rounds):
            await sleep(seconds)
            figures.append(spent())
        loop.stop()
        for each in clients:
            await ended(each)
    for each in aircraft.grounds:
        each.transport.abortConnection()
    await listening.stopListening()
    return [_us_a_frame(values) for values in zip(*figures, strict=True)]


def _us_a_frame(figures: Sequence[tuple[float, int]]) -> list[float]:
    return [
        (after_s - before_s) / (frames - before) * 1e6
        for (before_s, before), (after_s, frames) in pairwise(figures)
    ]


def rows(quick: bool = False) -> Iterable[Row]:
    if find_spec("foxglove") is None:
        raise LeftOutError("foxglove-sdk is not installed")
    seconds, rounds = (QUICK_SECONDS, QUICK_ROUNDS) if quick else (SECONDS, ROUNDS)
    with tempfile.TemporaryDirectory() as folder:
        mine, theirs = run_in_reactor(measure, folder, seconds, rounds, timeout_s=200.0)
    what = "Foxglove, CPU of a frame at 10 Hz to one client"
    yield compared(what, "us", mine, "JSON to a plain WebSocket", theirs, TARGET)
