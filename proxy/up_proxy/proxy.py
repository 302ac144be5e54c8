"""The Ground Station Proxy as a whole: two ports, the aircraft between them, its tick."""

from typing import Any

from up.log import UpLogger
from up.protocols.proxy_lines import Side
from up.system.peer_filter import PeerFilter
from up_proxy.acceptor import Acceptor
from up_proxy.config import ProxyConfig
from up_proxy.handshake import Handshake
from up_proxy.listener import StartError, listen
from up_proxy.loop_tick import LoopTick
from up_proxy.metrics import render
from up_proxy.metrics_server import serve_metrics
from up_proxy.poller import Poller
from up_proxy.registry import AircraftRegistry

_log = UpLogger.get_logger("proxy")


class Proxy:
    """Relays between airborne and ground side; `start` and `stop` do not wait."""

    def __init__(self, reactor: Any, config: ProxyConfig) -> None:
        self._reactor = reactor
        self._config = config
        self._poller = Poller(reactor, reactor.seconds)
        limits = config.limits
        self.registry = AircraftRegistry(reactor, self._poller, limits.aircraft, limits.listeners)
        self._acceptors: list[Acceptor] = []
        self._metrics_port: Any = None
        self._loop_tick = LoopTick(reactor, self._tick)

    @property
    def airborne_port(self) -> int:
        return self._acceptors[0].port

    @property
    def ground_port(self) -> int:
        return self._acceptors[1].port

    def start(self) -> None:
        """Open the ports.

        Raises StartError: code `cannot_listen`, or `bad_address` for an address that is invalid
        or, without `i_accept_plain`, public; no port stays open then.
        """
        config = self._config
        peers = PeerFilter(config.i_accept_plain, "proxy.yml: i_accept_plain")
        if refusal := peers.refusal_of(config.address):
            raise StartError("bad_address", f"{refusal} (proxy.yml: address)", status=2)
        try:
            for side, port in (
                (Side.AIRBORNE, config.airborne_port),
                (Side.GROUND, config.ground_port),
            ):
                self._acceptors.append(self._acceptor(side, port))
            if config.metrics:
                self._metrics_port = serve_metrics(self._reactor, config.metrics_port, self.page)
        except StartError:
            for acceptor in self._acceptors:
                acceptor.end()
            self._acceptors.clear()
            raise
        for acceptor in self._acceptors:
            acceptor.open()
        if self._metrics_port is not None:
            _log.info(
                "metrics page listens on port {port}",
                code="port_open",
                side="metrics",
                port=self._metrics_port.getHost().port,
            )
        self._poller.start()
        self._loop_tick.start()

    def stop(self) -> None:
        self._loop_tick.stop()
        if self._metrics_port is not None:
            self._metrics_port.stopListening()
        for acceptor in self._acceptors:
            acceptor.close()
        self._poller.reap()
        self._poller.stop()
        self.registry.stop()

    def is_healthy(self) -> bool:
        return len(self._acceptors) == 2 and all(acceptor.is_open() for acceptor in self._acceptors)

    def page(self) -> str:
        air, ground = self._acceptors
        return render(air, ground, self.registry, self._loop_tick, self._poller.tick())

    def _acceptor(self, side: Side, port: int) -> Acceptor:
        config = self._config
        label = f"{side.value} port"
        listener = listen(label, config.address, port, config.limits.user_timeout_ms)
        handshake = Handshake(side, self.registry, self._poller)
        return Acceptor(listener, handshake, self._poller, self._reactor, side, config)

    def _tick(self) -> None:
        now_s = self._poller.tick()
        for acceptor in self._acceptors:
            acceptor.sweep(now_s)
        self.registry.sweep(now_s)
        self._poller.reap()
