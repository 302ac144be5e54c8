"""The Ground Station Proxy as a whole: two ports, the aircraft between them, its tick."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

from twisted.internet.defer import Deferred, succeed
from twisted.internet.error import CannotListenError
from twisted.internet.task import deferLater

from up.log import UpLogger
from up.protocols.proxy_lines import CLUSTER, Side
from up.system.metrics_page import serve_metrics
from up.system.peer_filter import PeerFilter
from up.tls.errors import TLSError
from up.tls.files import TLSFiles
from up_cluster.config import ClusterError
from up_proxy.acceptor import Acceptor
from up_proxy.aircraft import AircraftSession
from up_proxy.config import ProxyConfig
from up_proxy.handshake import Handshake
from up_proxy.listener import StartError, cannot_listen, listen
from up_proxy.loop_tick import LoopTick
from up_proxy.metrics import quota_metrics, render
from up_proxy.poller import Poller
from up_proxy.registry import AircraftRegistry
from up_proxy.tenant_quota import TenantQuota

if TYPE_CHECKING:
    from up_proxy.cluster.node import ClusterNode

_log = UpLogger.get_logger("proxy")


class Proxy:
    """Relays between airborne and ground side; `start` and `stop` do not wait."""

    def __init__(self, reactor: Any, config: ProxyConfig, folder: Path = Path()) -> None:
        self._reactor = reactor
        self._config = config
        self._tls = TLSFiles(folder / config.tls.folder) if config.tls.folder else None
        self._poller = Poller(reactor, reactor.seconds)
        self._are_ports_closed = False
        self._quota = TenantQuota(reactor, config.quota)
        self._node = self._new_node(folder) if config.cluster.servers else None
        make = AircraftSession if self._node is None else self._node.new_session
        self.registry = AircraftRegistry(reactor, self._poller, config.limits, make)
        self._acceptors: list[Acceptor] = []
        self._metrics_port: Any = None
        self._loop_tick = LoopTick(reactor, self._tick)

    @property
    def airborne_port(self) -> int:
        """The plain port, if there is one, otherwise the TLS port."""
        return self._acceptors[0].port

    @property
    def ground_port(self) -> int:
        return self._acceptors[1].port

    @property
    def tls_ports(self) -> tuple[int, int]:
        """The TLS ports for aircraft and for grounds."""
        return self._acceptors[-2].port, self._acceptors[-1].port

    def start(self) -> None:
        """Open the ports.

        Raises StartError: code `cannot_listen`, `bad_address` for an address that is invalid
        or, without `i_accept_plain`, public, or that of a TLSError; no port stays open then.
        """
        config, tls = self._config, self._tls
        peers = PeerFilter(config.i_accept_plain or not self._is_plain, "proxy.yml: i_accept_plain")
        if refusal := peers.refusal_of(config.address):
            raise StartError("bad_address", f"{refusal} (proxy.yml: address)", status=2)
        try:
            if self._is_plain:
                self._acceptors.append(self._acceptor(Side.AIRBORNE, config.airborne_port))
                self._acceptors.append(self._acceptor(Side.GROUND, config.ground_port))
            if tls is not None:
                own = config.tls
                self._acceptors.append(self._acceptor(Side.AIRBORNE, own.airborne_port, tls))
                self._acceptors.append(self._acceptor(Side.GROUND, own.ground_port, tls))
            if config.metrics:
                self._metrics_port = self._serve_metrics(config.metrics_port)
        except (StartError, TLSError) as error:
            for acceptor in self._acceptors:
                acceptor.end()
            self._acceptors.clear()
            if isinstance(error, TLSError):
                raise StartError(error.code, f"{error} (proxy.yml: tls)", status=2) from None
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
        if self._node is not None:
            self._node.start()

    def stop(self) -> Deferred[None]:
        """Close everything; a node of a cluster gives up its aircraft to the others before."""
        self._loop_tick.stop()
        if self._metrics_port is not None:
            self._metrics_port.stopListening()
        self._close_acceptors()
        self._poller.reap()
        if self._node is None:
            self._finish()
            return succeed(None)
        # The poller may be what calls back: it is closed in the next round.
        stopped = self._node.stop()
        return stopped.addCallback(lambda _: deferLater(self._reactor, 0, self._finish))

    def _close_acceptors(self) -> None:
        if not self._are_ports_closed:
            for acceptor in self._acceptors:
                acceptor.close()
        self._are_ports_closed = True

    def _finish(self) -> None:
        self._poller.stop()
        self.registry.stop()

    def _new_node(self, folder: Path) -> "ClusterNode":
        from up_proxy.cluster.node import ClusterNode

        try:
            node = ClusterNode(
                self._reactor, self._poller, self._config.cluster, folder, self._quota
            )
        except (ClusterError, TLSError) as error:
            raise StartError(error.code, f"{error} (proxy.yml: cluster)", status=2) from None
        node.on_drain = self._close_acceptors
        return node

    def _serve_metrics(self, port: int) -> Any:
        try:
            return serve_metrics(self._reactor, port, self.page, self.unready_code)
        except CannotListenError as error:
            raise cannot_listen("metrics port", port, error.socketError) from None

    def is_healthy(self) -> bool:
        if self._are_ports_closed:
            return True  # by a drain: a restart would serve again
        return bool(self._acceptors) and all(acceptor.is_open() for acceptor in self._acceptors)

    def unready_code(self) -> str:
        """Return why it accepts no new connection; empty: it does."""
        if self._are_ports_closed:
            return "draining"
        if not self.is_healthy():
            return "port_closed"
        return CLUSTER if self._node is not None and not self._node.is_ready else ""

    def page(self) -> str:
        now_s = self._poller.tick()
        more = [*quota_metrics(self._quota), *(self._node.metrics() if self._node else ())]
        return render(self._acceptors, self.registry, self._loop_tick, now_s, more)

    @property
    def _is_plain(self) -> bool:
        return self._tls is None or self._config.tls.plain

    def _acceptor(self, side: Side, port: int, tls: TLSFiles | None = None) -> Acceptor:
        config = self._config
        if tls is not None:
            tls.server()
        label = f"{side.value} port"
        listener = listen(label, config.address, port, config.limits.user_timeout_ms)
        if self._node is None:
            handshake = Handshake(side, self.registry, self._poller, self._quota)
        else:
            handshake = self._node.new_handshake(side, self.registry)
        return Acceptor(listener, handshake, self._poller, self._reactor, side, config, tls)

    def _tick(self) -> None:
        now_s = self._poller.tick()
        for acceptor in self._acceptors:
            acceptor.sweep(now_s)
        self.registry.sweep()
        self._quota.update(self.registry)
        self._poller.reap()
