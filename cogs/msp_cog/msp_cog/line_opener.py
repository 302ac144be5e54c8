"""Opens the line to the board: a serial port, or a TCP socket."""

from __future__ import annotations

import errno
import ipaddress
import os
import socket

from up.protocols.serial_line import SerialLike
from up.protocols.serial_port import open_serial

SOCKET = "tcp:"


def socket_problem(port: str) -> str:
    """Return what is wrong with ``tcp:ADDRESS:PORT``; empty: nothing."""
    host, _, number = port.removeprefix(SOCKET).rpartition(":")
    try:
        address = ipaddress.ip_address(host)
    except ValueError:
        return f"{port!r} is not tcp:ADDRESS:PORT with a numeric address"
    # MSP has neither keys nor encryption: whoever reaches it moves the servos.
    if not address.is_loopback:
        return f"{host} is not this computer: MSP is not protected on a network"
    if not (number.isascii() and number.isdecimal() and 0 < int(number) < 65536):
        return f"{number!r} is not a port"
    return ""


def open_line(port: str, baud_rate: int) -> int | SerialLike:
    """Return the open line; raises OSError with one sentence."""
    if not port.startswith(SOCKET):
        return open_serial(port, baud_rate)
    host, _, number = port.removeprefix(SOCKET).rpartition(":")
    line = socket.socket(socket.AF_INET6 if ":" in host else socket.AF_INET)
    line.setblocking(False)
    line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    # It connects while the line waits for its first bytes.
    fault = line.connect_ex((host, int(number)))
    if fault not in (0, errno.EINPROGRESS):
        line.close()
        raise OSError(f"no board on {port}: {os.strerror(fault)}")
    return line
