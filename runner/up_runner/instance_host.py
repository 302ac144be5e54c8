"""The runner's machine as its instances use it: folders, logs, sockets, processes."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

from twisted.internet.defer import Deferred, DeferredLock
from twisted.internet.threads import deferToThreadPool
from twisted.logger import Logger

from up_runner import instance_state
from up_runner.config import RunnerConfig
from up_runner.instance_config import ConfigurationRefused, InstanceConfig
from up_runner.instance_state import InstanceState
from up_runner.log_keeper import LogKeeper
from up_runner.notify_listener import Notification, NotifyListener
from up_runner.paths import Paths
from up_runner.process import Process, listening_ports, sessions_with
from up_runner.request import NAME, Request
from up_runner.run_folder import RunFolder

NOTIFY = "notify"


class InstanceHost:
    """Machine access for the instances; operations that may block on the disk run in threads.

    `folder` holds the instances' configuration, `run_folder` their sockets and records; `environ`
    is the environment that they inherit.
    """

    def __init__(
        self,
        reactor: Any,
        config: RunnerConfig,
        paths: Paths,
        run_folder: RunFolder,
        instance_config: InstanceConfig,
        environ: Mapping[str, str],
    ) -> None:
        self.reactor = reactor
        self.run_folder = run_folder
        self.folder = paths.instances
        self.logs = LogKeeper(paths.logs, config.logs.size, config.logs.keep)
        self.on_change: Callable[[str], None] = lambda name: None
        self.permit: Callable[[str], Mapping[str, str]] = lambda name: {}
        """Returns more variables for a start, or raises ConfigurationRefused."""
        self._config = config
        self._paths = paths
        self._instance_config = instance_config
        self._environ = dict(environ)
        self._disk = DeferredLock()
        self._log = Logger(namespace="runner")

    def prepare(self, request: Request) -> Deferred[tuple[Path, int]]:
        """Return the instance's configuration folder and a descriptor for its log.

        Fails with ConfigurationRefused or OSError.
        """
        return self.on_disk(self._prepare, request)

    def listen(
        self, name: str, on_notification: Callable[[int, Notification], None]
    ) -> NotifyListener:
        """Bind the instance's notify socket; raises OSError."""
        self.run_folder.instance(name).mkdir(mode=0o700, exist_ok=True)
        socket = NotifyListener(self.reactor, self._notify_path(name), on_notification)
        socket.open()
        return socket

    def spawn(self, name: str, config: Path, log: int) -> Process:
        """Start the application and close the log's descriptor; raises OSError."""
        try:
            permitted = self.permit(name)
        except ConfigurationRefused:
            os.close(log)
            raise
        environ = dict(
            self._environ,
            NOTIFY_SOCKET=str(self._notify_path(name)),
            UP_PID_FILE=str(self._pid_path(name)),
            UP_INSTANCE=name,
            UP_MODE=self._config.mode,
            PYTHONUNBUFFERED="1",
            **permitted,
        )
        if self._config.watchdog_s:
            environ["WATCHDOG_USEC"] = str(round(self._config.watchdog_s * 1e6))
        try:
            script = self._paths.script
            if script is not None and not script.is_file():
                raise FileNotFoundError(f"no such script: {script}")
            program = ["-m", "raspilot"] if script is None else [str(script)]
            return Process.spawn(
                self.reactor,
                [str(self._paths.python), *program, "--config", str(config)],
                cwd=self._paths.root,
                environ=environ,
                log=log,
            )
        finally:
            os.close(log)

    def open_ports(self, pid: int) -> Deferred[frozenset[int] | None]:
        return self.in_thread(listening_ports, pid)

    def last_log_line(self, name: str) -> Deferred[str | None]:
        return self.in_thread(self.logs.last_log_line, name)

    def save(self, state: InstanceState) -> None:
        """Write the state for the next runner; log a failed write."""
        try:
            state.save(self.run_folder.instance(state.request.aircraft))
        except OSError as error:
            text = "cannot save the state of an instance: {error}"
            self._log.error(text, code="state_not_saved", error=str(error))

    def discard(self, name: str) -> None:
        """Remove the saved state: the next runner does not restart the instance."""
        instance_state.discard(self.run_folder.instance(name))
        with suppress(OSError):
            # A killed instance leaves its PID file behind.
            self._pid_path(name).unlink(missing_ok=True)

    def load(self, name: str) -> InstanceState | None:
        return instance_state.load(self.run_folder.instance(name))

    def running(self) -> Iterator[tuple[str, int]]:
        """Yield name and number of the processes that were started from this run folder.

        Finds them without a saved state: by the notify socket in their environment.
        """
        for pid, socket in sessions_with("NOTIFY_SOCKET", f"{self.run_folder.path}/"):
            name = Path(socket).parent.name
            if NAME.fullmatch(name) and socket == str(self._notify_path(name)):
                yield name, pid

    def on_disk(self, function: Callable[..., Any], *arguments: Any) -> Deferred[Any]:
        """Run in a thread, one at a time: it changes the instances' folders."""
        return self._disk.run(self.in_thread, function, *arguments)

    def in_thread(self, function: Callable[..., Any], *arguments: Any) -> Deferred[Any]:
        return deferToThreadPool(self.reactor, self.reactor.getThreadPool(), function, *arguments)

    def _prepare(self, request: Request) -> tuple[Path, int]:
        config = self._instance_config.build(request, self.folder / request.aircraft)
        return config, self.logs.open(request.aircraft)

    def _pid_path(self, name: str) -> Path:
        return self.run_folder.instance(name) / "pid"

    def _notify_path(self, name: str) -> Path:
        return self.run_folder.instance(name) / NOTIFY
