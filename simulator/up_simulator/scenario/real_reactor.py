"""The reactor of Twisted, run in small steps by the loop of a flight in real time."""

from __future__ import annotations

import time
from typing import Any

from up_simulator.harness.participants import ParticipantError
from up_simulator.in_process.host import LiteralResolver
from up_simulator.link.model import LinkModel
from up_simulator.link.relay import LOOPBACK, LinkRelay, LinkRelayError

LATEST_S = 0.25


class RealReactor:
    """Has the interface of the simulated reactor for the stubs of phone and ground.

    ``link`` puts a relay before a port: connections to the port pass the link to its ``targets``
    entry.
    """

    def __init__(self) -> None:
        from twisted.internet import reactor as default_reactor

        reactor: Any = default_reactor
        # The reactor's own clock is wall-clock time, and a flight must not see its jumps.
        reactor.seconds = time.monotonic
        # Twisted's own resolver has threads, for which the program would wait at its end.
        reactor.installNameResolver(LiteralResolver())
        if not reactor.running:
            reactor.startRunning(installSignalHandlers=False)
        self._reactor = reactor
        self.targets: dict[int, int] = {}
        self._relays: list[LinkRelay] = []
        self._due_s = time.monotonic()
        self.skipped_s = 0.0

    def seconds(self) -> float:
        return time.monotonic()

    def host(self, _name: str = "") -> Any:
        """Return the reactor: every program has the same one."""
        return self._reactor

    def link(self, port: int, up: LinkModel, down: LinkModel) -> None:
        """Put a link before a TCP port that has a target; raises ParticipantError."""
        if port in self.targets:
            self.relay(port, self.targets[port], up, down)

    def relay(self, port: int, target: int, up: LinkModel, down: LinkModel) -> int:
        """Listen on a port (0: any), carry everything to another one; return the port.

        Raises ParticipantError.
        """
        relay = LinkRelay(self._reactor, port, LOOPBACK, target, up, down)
        self._relays.append(relay)
        try:
            return relay.start()
        except LinkRelayError as error:
            raise ParticipantError(str(error)) from error

    def advance(self, step_s: float) -> None:
        """Serve sockets and timers until this step's real time is over.

        A flight that is late by more than 250 ms skips the time that it missed: ``skipped_s``.
        """
        self._due_s += step_s
        left_s = self._due_s - time.monotonic()
        self._reactor.iterate(max(0.0, left_s))
        while (left_s := self._due_s - time.monotonic()) > 0:
            self._reactor.iterate(left_s)
        if left_s < -LATEST_S:
            self.skipped_s -= left_s
            self._due_s -= left_s

    def stop(self) -> None:
        relays, self._relays = self._relays, []
        for relay in relays:
            # Each has closed all before it first waits for anything.
            _begin(relay)
        self._reactor.iterate(0)


def _begin(relay: LinkRelay) -> None:
    from twisted.internet.defer import Deferred

    Deferred.fromCoroutine(relay.stop()).addErrback(lambda _: None)
