"""A runner behind the cellular link."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

from twisted.internet.defer import Deferred
from twisted.internet.protocol import Factory
from twisted.protocols.basic import LineOnlyReceiver

from up_simulator.phone.address import (
    LONGEST_ANSWER,
    NotFoundError,
    Runner,
    ask_runner,
    read_spawn_answer,
)

LOOPBACK = "127.0.0.1"


class RunnerDoor:
    """Forwards requests to a runner, and its answers back, with the ports replaced.

    A phone with its own sockets connects to the address in the answer: ``by_link`` maps a port of
    the instance to the port at which the link to it begins.
    """

    def __init__(
        self, reactor: Any, runner_port: Callable[[], int], by_link: Callable[[int], int]
    ) -> None:
        self._reactor = reactor
        self._runner_port = runner_port
        self._by_link = by_link
        self._listening: Any = None

    def start(self) -> int:
        """Listen, unless it does already; return the port."""
        if self._listening is None:
            factory: Any = Factory()
            factory.noisy = False
            factory.protocol = lambda: _Request(self)
            self._listening = self._reactor.listenTCP(0, factory, interface=LOOPBACK)
        port: int = self._listening.getHost().port
        return port

    def stop(self) -> None:
        """Listen no more."""
        listening, self._listening = self._listening, None
        if listening is not None:
            listening.stopListening()

    async def answer(self, request: bytes) -> bytes:
        """Return the runner's answer as the link has it; raises NotFoundError."""
        runner = Runner(LOOPBACK, self._runner_port(), "")
        answer = await ask_runner(self._reactor, runner, request)
        try:
            place = read_spawn_answer(answer, LOOPBACK)
        except NotFoundError:
            # The runner's reason is left to the phone.
            return answer
        ports = {
            "general": self._by_link(place.general_port),
            "orientation": self._by_link(place.orientation_port),
        }
        return json.dumps({**json.loads(answer), "ports": ports}).encode("ascii")


class _Request(LineOnlyReceiver):
    """A phone's connection."""

    delimiter = b"\n"
    MAX_LENGTH = LONGEST_ANSWER

    def __init__(self, door: RunnerDoor) -> None:
        self._door = door

    def lineReceived(self, line: bytes) -> None:  # noqa: N802 - Twisted's name
        """Pass a request on."""
        done = Deferred.fromCoroutine(self._door.answer(line))
        done.addCallbacks(self.sendLine, lambda _failure: self._hang_up())

    def _hang_up(self) -> None:
        transport: Any = self.transport
        transport.loseConnection()
