"""The configuration that the showcase writes: everything on this machine, the Pi controls."""

from __future__ import annotations

import socket
from dataclasses import astuple, dataclass
from pathlib import Path

_TRIES = 20
# Gains of the virtual glider (aircraft/airframes/glider/airframe.yml).
PIDS = """\
# Gains for the virtual glider; the ground's tuning is saved here.
units: degrees per second
rate:
  ailerons: {p: 2.1, i: 0.0, d: 0.0}
  elevator: {p: 1.0, i: 0.0, d: 0.0}
  rudder: {p: 0.5, i: 0.0, d: 0.0}
stabilize:
  ailerons: {p: 2.0, i: 0.0, d: 0.0}
  elevator: {p: 4.1, i: 0.0, d: 0.0}
  rudder: {p: 0.0, i: 0.0, d: 0.0}
"""


@dataclass(frozen=True, slots=True)
class Ports:
    """The TCP ports of a run."""

    airborne: int = 3003
    ground: int = 3004
    orientation: int = 50000
    general: int = 50001
    discovery: int = 3001
    metrics: int = 9303


def choose_ports(any_ports: bool = False) -> Ports:
    """Return the usual ports where they are free, any free ones where not."""
    held: list[socket.socket] = []
    try:
        return Ports(*(_free_port(port, any_ports, held) for port in astuple(Ports())))
    finally:
        for each in held:
            each.close()


def _free_port(wanted: int, any_port: bool, held: list[socket.socket]) -> int:
    """Return a port that is free for TCP and for UDP, and hold it until all are chosen."""
    for port in (0,) * _TRIES if any_port else (wanted, *(0,) * _TRIES):
        stream, datagrams = socket.socket(), socket.socket(type=socket.SOCK_DGRAM)
        held += [stream, datagrams]
        stream.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            stream.bind(("", port))
            bound: int = stream.getsockname()[1]
            datagrams.bind(("", bound))
        except OSError:
            continue
        return bound
    raise OSError("no port is free")


def write_config(folder: Path, board: Path, ports: Ports) -> None:
    """Write the files of a run; gains that an earlier run saved stay."""
    folder.mkdir(parents=True, exist_ok=True)
    files = {
        "config.yml": "flight controller: raspberry\n",
        "arduino.yml": f"port: {board}\n",
        "android.yml": f"general port: {ports.general}\norientation port: {ports.orientation}\n",
        "discovery.yml": f"port: {ports.discovery}\n",
        "mission_control.yml": (
            "remote_server:\n"
            "  url: 127.0.0.1\n"
            f"  port: {ports.airborne}\n"
            "# On loopback nobody else listens: the ground may arm and tune.\n"
            "role: pilot\n"
            "tune_in_flight: true\n"
        ),
        "proxy.yml": (
            f"airborne port: {ports.airborne}\n"
            f"ground port: {ports.ground}\n"
            f"metrics port: {ports.metrics}\n"
        ),
    }
    if not (folder / "pids.yml").exists():
        (folder / "pids.yml").write_text(PIDS, encoding="utf-8")
    for name, text in files.items():
        head = "# Written by 'make run', at every start.\n"
        (folder / name).write_text(head + text, encoding="utf-8")
