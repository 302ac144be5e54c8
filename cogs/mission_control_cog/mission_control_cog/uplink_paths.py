"""Several network interfaces for the link to the proxy: health, failover, return."""

import errno
import socket
from collections.abc import Callable, Sequence
from typing import Any

from twisted.internet.defer import Deferred
from twisted.internet.error import ConnectError
from twisted.internet.protocol import Factory, Protocol
from twisted.python.failure import Failure

from mission_control_cog.path_selector import PROBE_S, PathSelector
from up.protocols.tcp_options import Answered, answered
from up.system.clock import Timer, cancel

CHECK_S = 0.1
SILENCE_S = 0.8
"""Sent bytes without an acknowledgement for this long: the path is silent."""
ROUND_TRIPS = 3
"""... and for as many round trips: a slow path is not a silent one."""
ATTEMPT_LIMIT_S = 2.0
"""Of an attempt, TLS included, while another path is healthy."""
PROBE_BYTES = 232
"""IP bytes of opening and resetting a connection."""


class InterfaceError(ConnectError):
    """A network interface that cannot carry the link; its text advises the user."""

    def __init__(self, name: str, error: OSError) -> None:
        super().__init__(error.errno)  # type: ignore[no-untyped-call]
        is_missing = error.errno == errno.ENODEV
        self.code = "interface_missing" if is_missing else "interface_unusable"
        what = "does not exist now" if is_missing else f"cannot be used ({error.strerror})"
        self._text = (
            f"the network interface {name} {what}: plug it in, or correct interfaces in"
            " mission_control.yml ('ip link' lists those of this computer)"
        )

    def __str__(self) -> str:
        return self._text


class OnInterface:
    """The reactor of an endpoint whose connections use one network interface alone.

    Since Linux 5.7 this needs no rights. The interface needs a route to the proxy.
    """

    def __init__(self, reactor: Any, name: str) -> None:
        self._reactor = reactor
        self._name = name

    def connectTCP(self, *args: Any, **kwargs: Any) -> Any:  # noqa: N802 - Twisted's name
        """Begin to connect; Twisted sends the first packet in its next turn."""
        connector = self._reactor.connectTCP(*args, **kwargs)
        client = connector.transport
        try:
            handle = client.getHandle()
        except AttributeError:
            return connector  # without a socket the attempt fails
        try:
            handle.setsockopt(socket.SOL_SOCKET, socket.SO_BINDTODEVICE, self._name.encode())
        except OSError as error:
            client.failIfNotConnected(InterfaceError(self._name, error))
        return connector


def client_endpoint(reactor: Any, address: str, port: int, limit_s: float) -> Any:
    """Return the endpoint of an IPv4 or IPv6 address."""
    # Imported here: an aircraft without a server need not wait for it.
    from twisted.internet.endpoints import TCP4ClientEndpoint, TCP6ClientEndpoint

    make: Any = TCP6ClientEndpoint if ":" in address else TCP4ClientEndpoint
    return make(reactor, address, port, limit_s)


class UplinkPaths:
    """Selects the interface of each attempt, and ends a link that another one would carry better.

    ``leave`` gets a code and a reason, and connects by another path while the link still exists.
    """

    def __init__(
        self,
        reactor: Any,
        interfaces: Sequence[str],
        return_after_s: float,
        leave: Callable[[str, str], object],
    ) -> None:
        self._reactor = reactor
        self._names = tuple(interfaces)
        self._selector = PathSelector(len(self._names), return_after_s)
        self._leave = leave
        self._peer = ("", 0)
        self._transport: Any = None
        self._attempted = 0
        self._is_leaving = False
        self._probe_bytes = 0
        self._silent_checks = 0
        self._checked_s = 0.0
        self._probed_s = 0.0
        self._timer: Timer | None = None

    @property
    def name(self) -> str:
        """The interface of the link, or of the newest attempt."""
        return self._names[self._attempted if self._transport is None else self._selector.current]

    def start(self) -> None:
        self._checked_s = self._probed_s = self._reactor.seconds()
        self._timer = self._reactor.callLater(CHECK_S, self._check)

    def stop(self) -> None:
        cancel(self._timer)

    def next(self, address: str, port: int) -> tuple[OnInterface, float | None]:
        """Return the reactor for an attempt and the limit of its duration in s, None: no limit."""
        self._peer, now_s = (address, port), self._reactor.seconds()
        path = self._attempted = self._selector.next(now_s)
        limit_s = ATTEMPT_LIMIT_S if self._selector.has_other(path, now_s) else None
        return OnInterface(self._reactor, self._names[path]), limit_s

    def failed(self) -> None:
        self._is_leaving = False
        self._selector.failed(self._attempted, self._reactor.seconds())

    def made(self, transport: Any) -> None:
        """Watch the link of the attempt, which is ready."""
        self._transport, self._silent_checks, self._is_leaving = transport, 0, False
        self._selector.carries(self._attempted, self._reactor.seconds())

    def ended(self) -> None:
        self._transport = None
        if not self._is_leaving:
            self._selector.lost(self._reactor.seconds())
        self._is_leaving = False

    def leave(self, code: str, reason: str) -> None:
        """Begin to connect by another path; `failed`, `made` or `ended` ends it."""
        self._is_leaving = True
        self._leave(code, reason)

    def take_probe_bytes(self) -> int:
        """Return what the probes have cost since the last call."""
        taken, self._probe_bytes = self._probe_bytes, 0
        return taken

    def _check(self) -> None:
        self._timer = self._reactor.callLater(CHECK_S, self._check)
        now_s, selector = self._reactor.seconds(), self._selector
        since_s, self._checked_s = now_s - self._checked_s, now_s
        if now_s - self._probed_s >= PROBE_S and self._peer[0]:
            self._probed_s = now_s
            for path in range(len(self._names)):
                if path != selector.current or self._transport is None:
                    self._probe(path)
        if self._transport is None or self._is_leaving:
            return
        answer = answered(self._transport)
        if answer is None or not answer.is_awaited or answer.age_s < since_s:
            self._silent_checks = 0
            selector.answered(selector.current, now_s)
        else:
            # Counted, not measured: a program that slept must first give its peer time.
            self._silent_checks += 1
        if self._is_silent(answer) and selector.has_other(selector.current, now_s):
            selector.lost(now_s)
            self.leave("path_silent", f"no answer by {self.name} for {SILENCE_S:g} s")
        elif selector.has_better(now_s):
            self.leave("better_path", f"a better path than {self.name} is back")

    def _is_silent(self, answer: Answered | None) -> bool:
        limit_s = max(SILENCE_S, ROUND_TRIPS * answer.round_trip_s) if answer else SILENCE_S
        return self._silent_checks * CHECK_S >= limit_s

    def _probe(self, path: int) -> None:
        self._probe_bytes += PROBE_BYTES
        address, port = self._peer
        reactor = OnInterface(self._reactor, self._names[path])
        endpoint = client_endpoint(reactor, address, port, ATTEMPT_LIMIT_S)
        factory: Any = Factory.forProtocol(Protocol)
        factory.noisy = False
        connecting: Deferred[Any] = endpoint.connect(factory)
        connecting.addCallback(self._on_probed, path)
        connecting.addErrback(self._on_probe_failed, path)

    def _on_probed(self, probe: Any, path: int) -> None:
        probe.transport.abortConnection()
        self._selector.answered(path, self._reactor.seconds())

    def _on_probe_failed(self, failure: Failure, path: int) -> None:
        failure.trap(ConnectError)
        self._selector.failed(path, self._reactor.seconds())
