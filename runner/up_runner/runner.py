"""The runner as a service: listens, manages the instances and reports to its supervisor."""

from __future__ import annotations

import os
from collections.abc import Mapping
from fnmatch import fnmatchcase
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

from twisted.internet.defer import Deferred, succeed
from twisted.internet.error import CannotListenError
from twisted.internet.protocol import ServerFactory
from twisted.logger import Logger
from twisted.python.failure import Failure

from up.config import ConfigErrors
from up.config.keys_file import KEYS
from up.key_ring import KeyRing
from up.system.figures import text_of
from up.system.metrics_page import serve_metrics
from up.system.notify import Notifier, WatchdogPinger
from up.system.peer_filter import PeerFilter
from up.tls.errors import TLSError
from up.tls.files import TLSFiles
from up.tls.protocol import TLSServerFactory
from up_cluster.config import ClusterError
from up_runner.config import RunnerConfig
from up_runner.instance_config import InstanceConfig
from up_runner.instance_host import InstanceHost
from up_runner.instances import STOPPING, Instances
from up_runner.paths import Paths
from up_runner.request import Request
from up_runner.request_gate import RequestGate
from up_runner.request_server import RequestServer
from up_runner.response import Response, failed
from up_runner.run_folder import CannotStart, RunFolder

if TYPE_CHECKING:
    from up_runner.pool.pool import Pool

LISTEN_BACKLOG = 1024
"""With a short one a burst of connections delays a phone's by the kernel's repetition of 1 s."""
_SUPERVISED = ("NOTIFY_SOCKET", "INVOCATION_ID", "UPSTART_JOB")


class Runner:
    """All parts of one runner, connected."""

    def __init__(
        self,
        reactor: Any,
        config: RunnerConfig,
        config_folder: Path,
        environ: Mapping[str, str] = os.environ,
    ) -> None:
        self._reactor = reactor
        self._config = config
        self._config_folder = config_folder.absolute()
        self._paths = Paths.of(config, config_folder, environ, os.geteuid())
        self._stops_instances = config.stop_instances_on_exit
        if self._stops_instances is None:
            self._stops_instances = not any(environ.get(name) for name in _SUPERVISED)
        self._log = Logger(namespace="runner")
        self._notifier = Notifier.from_environment(environ)
        self._pinger = WatchdogPinger(reactor, lambda: True, self._notifier, environ)
        self._run_folder = RunFolder(self._paths.run)
        is_safe = config.i_accept_plain or bool(config.tls)
        self._gate = RequestGate(config.security, accepts_plain=is_safe)
        self._keys = KeyRing(reactor, self._config_folder, self._gate.use)
        self.instance_host = self._host(environ)
        self.instances = Instances(self.instance_host, config, self._on_change)
        self.server = RequestServer(
            reactor, self._handle, self._encode, config.connections, self._gate
        )
        self._pool: Pool | None = None
        self._port: Any = None
        self._metrics_port: Any = None

    @property
    def port(self) -> int:
        return int(self._port.getHost().port)

    def start(self) -> None:
        """Take the run folder, listen, find older instances; raises CannotStart."""
        self._read_keys()
        self._check()
        factory = self._factory()
        self._run_folder.take()
        try:
            if self._config.pool.servers:
                self._pool = self._new_pool()
            self._open(factory)
        except CannotStart:
            self._run_folder.release()
            raise
        self.instances.open()
        if self._pool is not None:
            self._pool.start()
        self._log.info("listens on port {port}", code="port_open", port=self.port)
        self._notifier.ready(self.instances.summary())
        self._pinger.start()
        if self._config.autostart.aircraft:
            self._autostart()

    async def stop(self) -> None:
        """Close the port, and stop the instances or leave them to the next runner."""
        self._notifier.stopping()
        if self._port is not None:
            await self._port.stopListening()
            self.server.close()
            if self._stops_instances and len(self.instances):
                self._log.info("stops its instances", code="stopping_instances")
                await self.instances.stop_all()
            elif len(self.instances):
                text = "leaves its instances running: {all}"
                self._log.info(text, code="leaving_instances", all=self.instances.summary())
            self.instances.close()
            if self._pool is not None:
                await self._pool.stop()
        if self._metrics_port is not None:
            await self._metrics_port.stopListening()
        self._pinger.stop()
        self._keys.stop()
        self._run_folder.release()

    def _open(self, factory: ServerFactory) -> None:
        port, address = self._config.port, self._config.address
        try:
            self._port = self._reactor.listenTCP(port, factory, LISTEN_BACKLOG, address)
        except CannotListenError as error:
            raise CannotStart(
                "cannot_listen",
                f"cannot listen on port {port}: {error.socketError}; "
                "set another port in runner.yml or with --port",
            ) from None
        if self._config.metrics_port is not None:
            self._open_metrics(self._config.metrics_port)

    def _open_metrics(self, port: int) -> None:
        def page() -> str:
            pool = () if self._pool is None else self._pool.figures()
            return text_of([*self.instances.figures(), *self.server.figures(), *pool])

        try:
            self._metrics_port = serve_metrics(self._reactor, port, page, self._unready_code)
        except CannotListenError as error:
            self._port.stopListening()
            text = f"cannot listen on port {port}: {error.socketError}; set another metrics port"
            raise CannotStart("cannot_listen", text) from None
        port = self._metrics_port.getHost().port
        self._log.info("metrics page on port {port}", code="metrics_open", port=port)

    def _unready_code(self) -> str:
        """Return why it accepts no new instance; empty: it does, here or elsewhere in the pool."""
        if self.instances.is_closed:
            return STOPPING.code
        return "" if self._pool is None else self._pool.unready_code()

    def _new_pool(self) -> Pool:
        from up_runner.pool.pool import Pool

        host, folder = self.instance_host, self._config_folder
        try:
            return Pool(self._reactor, self._config, folder, self.instances, host)
        except (ClusterError, TLSError) as fault:
            raise CannotStart(fault.code, f"{fault} (runner.yml: pool)") from None

    def _read_keys(self) -> None:
        try:
            KEYS.load(self._config_folder)
        except ConfigErrors as errors:
            raise CannotStart("keys_faulty", str(errors)) from None
        self._keys.start()
        if self._config.security == "require" and self._keys.is_empty:
            text = "every request needs a key, and there is none: run 'up keys add'"
            self._log.error(text, code="keys_missing")

    def _factory(self) -> ServerFactory:
        if not self._config.tls:
            return self.server
        try:
            files = TLSFiles(self._config_folder / self._config.tls)
            return TLSServerFactory(self._reactor, files, self.server, clients=True)
        except TLSError as fault:
            raise CannotStart(fault.code, f"{fault} (runner.yml: tls)") from None

    def _host(self, environ: Mapping[str, str]) -> InstanceHost:
        config, paths = self._config, self._paths
        black_box = config.mode == "black box"
        instance_config = InstanceConfig(
            paths.base,
            paths.profiles,
            config.settable,
            # In the aircraft, the phone expects the default ports of its Raspberry Pi.
            config.dynamic_ports if black_box else {},
            config.persisted_files,
            self._proxy_settings(),
            self._config_folder / KEYS.filename,
        )
        inherited = {
            name: value
            for name, value in environ.items()
            if any(fnmatchcase(name, pattern) for pattern in config.environment)
        }
        return InstanceHost(
            self._reactor, config, paths, self._run_folder, instance_config, inherited
        )

    def _proxy_settings(self) -> Mapping[str, Mapping[str, Any]]:
        """Return the settings with which an instance uses the proxy named in the answers."""
        proxy = self._config.proxy
        server: dict[str, Any] = {"url": proxy.host, "port": proxy.airborne_port}
        if proxy.tls:
            # Otherwise that of the base stays: nothing here makes a protected link plain.
            server["tls"] = str(self._config_folder / proxy.tls)
        return {"mission_control.yml": {"remote_server": server}} if proxy.host else {}

    def _check(self) -> None:
        peers = PeerFilter(self._gate.accepts_public, "runner.yml: i_accept_plain")
        if refusal := peers.refusal_of(self._config.address):
            raise CannotStart("bad_address", f"{refusal} (runner.yml: address)")
        if os.geteuid() == 0 and not self._config.i_accept_root:
            raise CannotStart(
                "root",
                "it runs as root, and so would every instance; start it as another user, or set "
                "i_accept_root: true in runner.yml",
            )
        if self._paths.script is None:
            if find_spec("raspilot") is None and not self._config.python:
                raise CannotStart(
                    "no_script",
                    "Raspilot is not installed for this Python; install it, or set application "
                    "root in runner.yml",
                )
        elif not self._paths.script.is_file():
            raise CannotStart(
                "no_script",
                f"no such script: {self._paths.script}; "
                "application root and script path in runner.yml name it",
            )
        if not self._paths.base.is_dir():
            self._log.warn(
                "no such folder: {base}; instances start with their defaults",
                code="no_base",
                base=str(self._paths.base),
            )

    def _autostart(self) -> None:
        wanted = self._config.autostart
        request = Request(wanted.aircraft, wanted.profile or None)
        starting = Deferred.fromCoroutine(self.instances.spawn(request, keep=True))
        starting.addCallbacks(self._on_autostart, self._on_bug)

    def _on_autostart(self, response: Response) -> None:
        if response.error:
            self._log.error(
                "{name}: {error}",
                code=response.error.code,
                name=response.instance,
                error=str(response.error),
            )

    def _on_bug(self, failure: Failure) -> None:
        self._log.failure("a bug in the runner", failure, code="runner_bug")

    def _handle(self, request: Request) -> Deferred[Response]:
        if self._pool is not None:
            return Deferred.fromCoroutine(self._pool.handle(request))
        missing = set(request.labels) - set(self._config.pool.labels)
        if missing and request.action == "spawn":
            text = f"this host lacks the labels {', '.join(missing)}"
            return succeed(failed(request.aircraft, "no_runner", text))
        if request.action == "status":
            return succeed(self.instances.status(request.aircraft))
        return Deferred.fromCoroutine(self.instances.spawn(request))

    def _encode(self, response: Response, host: str) -> bytes:
        proxy = self._config.proxy
        where = {
            "host": proxy.host,
            "airborne": proxy.airborne_port,
            "ground": proxy.ground_port,
        }
        return response.encode(host, where if proxy.host else None)

    def _on_change(self) -> None:
        self._notifier.status(self.instances.summary())
