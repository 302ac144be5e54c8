"""Black Box Mode through a runner: the phone requests a Raspilot on a server."""

from __future__ import annotations

import json
import os
import signal
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import yaml

from up_simulator.harness.participants import ParticipantError
from up_simulator.harness.programs import RealRunner
from up_simulator.in_process.phone import InProcessPhone
from up_simulator.link.relay import LOOPBACK
from up_simulator.phone.address import RaspberryPi, Runner, spawn
from up_simulator.scenario.real_reactor import RealReactor

AIRCRAFT = "default"
LOG_TAIL_BYTES = 16_384


class RunnerDaemon:
    """The instance that a runner has started for our aircraft; the runner watches it."""

    def __init__(self, runner: RealRunner, run_folder: Path) -> None:
        self._runner = runner
        self._folder = run_folder

    @property
    def is_running(self) -> bool:
        pid = self._pid()
        return pid is not None and Path("/proc", str(pid)).exists()

    @property
    def log(self) -> Sequence[str]:
        try:
            data = (self._folder / ".logs" / f"{AIRCRAFT}.log").read_bytes()
        except OSError:
            return []
        return data[-LOG_TAIL_BYTES:].decode("utf-8", "replace").splitlines()

    def start(self) -> None:
        """Start the runner; the phone's request starts the instance."""
        self._runner.start()
        self._runner.wait_for_port()

    def stop(self) -> None:
        """Send the instance the signal to end: the runner does not restart it."""
        self._signal(signal.SIGTERM)

    def kill(self) -> None:
        """Kill it; the runner restarts it."""
        self._signal(signal.SIGKILL)

    def freeze(self) -> None:
        """Suspend it: the watchdog of the runner will detect it."""
        self._signal(signal.SIGSTOP)

    def thaw(self) -> None:
        self._signal(signal.SIGCONT)

    def check(self) -> None:
        self._runner.check()

    def end(self) -> None:
        self._runner.stop()

    def _pid(self) -> int | None:
        try:
            record = json.loads((self._folder / AIRCRAFT / "state.json").read_text("utf-8"))
        except (OSError, ValueError):
            return None
        process = record.get("process") if isinstance(record, dict) else None
        pid = process[0] if isinstance(process, list) and process else None
        return pid if isinstance(pid, int) and pid > 1 else None

    def _signal(self, number: int) -> None:
        pid = self._pid()
        if pid is None:
            raise ParticipantError("the runner has not started a Raspilot yet")
        with suppress(ProcessLookupError):
            os.kill(pid, number)


class RunnerPhone(InProcessPhone):
    """A phone whose cellular link leads to a runner, and from there to the instance's ports.

    ``relay`` puts the cellular link before a port and returns the address for connections. All
    links use TCP: a Black Box takes no datagrams.
    """

    def __init__(
        self,
        reactor: RealReactor,
        flight: Any,
        port: Callable[[], int],
        relay: Callable[[int], int],
        *,
        orientation: Any,
        seed: int,
    ) -> None:
        self._runner_port = port
        self._relay = relay
        self._relayed: dict[int, int] = {}
        self._real = reactor
        simulated: Any = reactor
        super().__init__(
            simulated,
            flight,
            orientation=orientation,
            seed=seed,
            general_port=0,
            orientation_port=0,
        )

    async def find(self) -> RaspberryPi:
        """Request an instance from the runner; return where the link to it begins."""
        runner = Runner(LOOPBACK, self._runner_port(), AIRCRAFT)
        place = await spawn(self._real.host(), runner)
        return RaspberryPi(
            LOOPBACK,
            self._by_link(place.general_port),
            self._by_link(place.orientation_port),
        )

    def _by_link(self, port: int) -> int:
        """Return where the link to a port begins: the same one at every attempt."""
        if port not in self._relayed:
            self._relayed[port] = self._relay(port)
        return self._relayed[port]


def write_runner_config(
    folder: Path, run_folder: Path, files: dict[str, dict[str, Any]], proxy: dict[str, Any]
) -> None:
    """Write ``runner.yml`` and the instance's own files below it; raises OSError."""
    instance = folder / "blackbox"
    instance.mkdir(parents=True, exist_ok=True)
    for name, values in files.items():
        (instance / name).write_text(yaml.safe_dump(values, sort_keys=False), encoding="utf-8")
    runner = {
        "port": 0,
        "address": LOOPBACK,
        "i_accept_root": True,
        "run folder": str(run_folder),
        "stop instances on exit": True,
        "proxy": {"host": LOOPBACK, **proxy},
    }
    (folder / "runner.yml").write_text(yaml.safe_dump(runner, sort_keys=False), encoding="utf-8")
