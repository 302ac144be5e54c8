"""Raspilot as a user runs it, ``python main.py --config DIR``, with its own configuration."""

import json
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from bench.processes import running
from up_simulator.harness.ports import Ports, choose_ports

ROOT = Path(__file__).resolve().parents[1]
MAIN = ROOT / "main.py"
FLIGHTS = "flights"
CONTROL = Path(__file__).with_name("control_run.py")


@dataclass(frozen=True, slots=True)
class Daemon:
    """A running daemon: its pid, its ports, its log and its folder of flights."""

    pid: int
    ports: Ports
    log: Path
    flights: Path


def write_config(
    folder: Path,
    ports: Ports,
    serial: str = "",
    proxy_port: int = 0,
    priority: int = 0,
    is_recorded: bool = True,
    has_metrics: bool = False,
) -> None:
    """Write a configuration: the Raspberry Pi flies, everything else as shipped."""
    recorder = {"enabled": is_recorded, "folder": str(folder / FLIGHTS)}
    files = {
        "config.yml": f"flight controller: raspberry\nrealtime priority: {priority}\n",
        "android.yml": f"general port: {ports.general}\norientation port: {ports.orientation}\n",
        "discovery.yml": f"port: {ports.discovery}\n",
        "arduino.yml": f"port: {serial!r}\n",
        "black_box.yml": json.dumps(recorder),
        # Other programs' load must not turn this into a measurement of Panic Mode.
        "load_guard.yml": "panic threshold: 100.0\ncalm down threshold: 99.0\n",
    }
    if has_metrics:
        files["metrics.yml"] = f"port: {ports.metrics}\n"
    if proxy_port:
        files["mission_control.yml"] = f"remote_server:\n  url: 127.0.0.1\n  port: {proxy_port}\n"
    for name, text in files.items():
        (folder / name).write_text(text)
    (folder / "pids.yml").write_text((ROOT / "config" / "pids.yml").read_text())


@contextmanager
def daemon(
    serial: str = "",
    proxy_port: int = 0,
    priority: int = 0,
    program: Path = MAIN,
    is_recorded: bool = True,
    has_metrics: bool = False,
) -> Iterator[Daemon]:
    """Run the daemon on a serial port until the block ends."""
    ports = choose_ports(any_ports=True)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_config(folder, ports, serial, proxy_port, priority, is_recorded, has_metrics)
        log = folder / "log"
        with (
            log.open("w") as stream,
            running((sys.executable, program, "--config", folder), stream, ROOT) as process,
        ):
            yield Daemon(process.pid, ports, log, folder / FLIGHTS)
