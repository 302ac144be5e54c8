"""The ports that a process has open, according to the kernel."""

from __future__ import annotations

import re
from pathlib import Path

_TCP_LISTEN = "0A"
_SOCKET = re.compile(r"socket:\[([0-9]+)\]")


def listening_ports(pid: int, proc: Path = Path("/proc")) -> frozenset[int] | None:
    """Return the TCP ports that a process listens on and the UDP ports that it has bound.

    None if this user may not inspect the process. Source: proc_pid_net(5), proc_pid_fd(5).
    """
    process = proc / str(pid)
    sockets: set[str] = set()
    try:
        for entry in (process / "fd").iterdir():
            # A descriptor may be closed in the meantime.
            try:
                match = _SOCKET.fullmatch(str(entry.readlink()))
            except FileNotFoundError:
                continue
            if match:
                sockets.add(match[1])
        ports = {
            port
            for table in ("tcp", "tcp6", "udp", "udp6")
            for inode, port in _rows(process / "net" / table, listening=table.startswith("tcp"))
            if inode in sockets
        }
    except OSError:
        return None
    return frozenset(ports)


def _rows(table: Path, *, listening: bool) -> list[tuple[str, int]]:
    try:
        lines = table.read_text("ascii").splitlines()[1:]
    except FileNotFoundError:
        return []  # a kernel without IPv6
    rows = []
    for line in lines:
        fields = line.split()
        if not listening or fields[3] == _TCP_LISTEN:
            rows.append((fields[9], int(fields[1].rpartition(":")[2], 16)))
    return rows
