"""The Ground Station Proxy as a whole: two ports, the aircraft between them, its tick."""

from typing import Any, Protocol

from up.log import UpLogger
from up.system.addresses import is_private, is_wildcard
from up_proxy.config import ProxyConfig
from up_proxy.door import Door, DoorLimits
from up_proxy.fleet import Fleet
from up_proxy.heartbeat import Heartbeat
from up_proxy.hello import Side
from up_proxy.journal import Journal
from up_proxy.listener import ListenError, listen
from up_proxy.metrics import door_metrics, fleet_metrics, process_metrics
from up_proxy.metrics_page import render
from up_proxy.metrics_server import TcpReactor, serve_metrics
from up_proxy.opening import Opening
from up_proxy.poller import Poller
from up_proxy.poller import Reactor as SocketReactor

_log = UpLogger.get_logger("proxy")


class PlainRefusedError(Exception):
    """The configured address is public, and plain traffic on it was not accepted."""


class ProxyReactor(TcpReactor, SocketReactor, Protocol):
    """The part of the reactor that the program uses."""

    def callWhenRunning(self, callable: Any) -> Any:  # noqa: N802 - Twisted's name
        """Call when the reactor runs."""

    def addSystemEventTrigger(self, phase: str, event: str, callable: Any) -> Any:  # noqa: N802
        """Call when the reactor stops."""

    def callFromThread(self, callable: Any) -> Any:  # noqa: N802 - Twisted's name
        """Call soon, also from a signal handler."""

    def stop(self) -> None:
        """End `run`."""

    def run(self, installSignalHandlers: bool = True) -> None:  # noqa: N803 - Twisted's name
        """Serve until stopped."""


class Proxy:
    """Relays between airborne and ground side; `start` and `stop` do not wait."""

    def __init__(self, reactor: ProxyReactor, config: ProxyConfig) -> None:
        self._reactor = reactor
        self._config = config
        self._poller = Poller(reactor, reactor.seconds)
        limits = config.limits
        self._journal = Journal(reactor)
        self.fleet = Fleet(self._poller, self._journal, limits.aircraft, limits.listeners)
        self._doors: list[Door] = []
        self._metrics_port: Any = None
        self._heartbeat = Heartbeat(reactor, self._tick)

    @property
    def airborne_port(self) -> int:
        """The port that aircraft connect to."""
        return self._doors[0].port

    @property
    def ground_port(self) -> int:
        """The port that grounds connect to."""
        return self._doors[1].port

    def start(self) -> None:
        """Open the ports.

        Raises ListenError if a port cannot be opened, PlainRefusedError if the address is public
        and `i_accept_plain` is false; no port stays open then.
        """
        config = self._config
        self._check_address()
        try:
            for side, port in (
                (Side.AIRBORNE, config.airborne_port),
                (Side.GROUND, config.ground_port),
            ):
                self._doors.append(self._door(side, port))
            if config.metrics:
                self._metrics_port = serve_metrics(self._reactor, config.metrics_port, self.page)
        except ListenError:
            for door in self._doors:
                door.end()
            self._doors.clear()
            raise
        for door in self._doors:
            door.open()
        if self._metrics_port is not None:
            _log.info("metrics page listens on port {port}", port=self._metrics_port.getHost().port)
        self._poller.start()
        self._heartbeat.start()

    def stop(self) -> None:
        """Close every port and connection."""
        self._heartbeat.stop()
        if self._metrics_port is not None:
            self._metrics_port.stopListening()
        for door in self._doors:
            door.close()
        self._poller.reap()
        self._poller.stop()
        self._journal.stop()

    def is_healthy(self) -> bool:
        """Return whether both ports are open."""
        return len(self._doors) == 2 and all(door.is_open() for door in self._doors)

    def page(self) -> str:
        """Return the metrics page."""
        air, ground = self._doors
        now_s = self._poller.tick()
        return render(
            [
                *door_metrics(air, ground),
                *fleet_metrics(self.fleet, now_s),
                *process_metrics(self._heartbeat),
            ]
        )

    def _door(self, side: Side, port: int) -> Door:
        config = self._config
        limits = config.limits
        label = f"{side.value} port"
        listener = listen(label, config.address, port, limits.user_timeout_ms)
        # The queue of an aircraft is bounded by pausing the ground, never by dropping lines.
        queue_bytes = limits.queue_bytes if side is Side.GROUND else 0
        door_limits = DoorLimits(
            limits.connections, limits.per_address, queue_bytes, config.i_accept_plain
        )
        opening = Opening(side, self.fleet, self._poller)
        return Door(listener, opening, self._poller, self._reactor, side, door_limits)

    def _check_address(self) -> None:
        address = self._config.address
        try:
            public = not is_wildcard(address) and not is_private(address)
        except ValueError:
            raise ListenError(f"cannot listen on address {address!r}: not an address") from None
        if public and not self._config.i_accept_plain:
            raise PlainRefusedError(
                f"address {address} is public and the proxy speaks the plain protocol: set "
                "'i_accept_plain: true' in proxy.yml to accept that"
            )

    def _tick(self) -> None:
        now_s = self._poller.tick()
        for door in self._doors:
            door.sweep(now_s)
        self.fleet.sweep(now_s)
        self._poller.reap()
