"""Opens the line to the board: a serial port, or a TCP socket."""

import ipaddress
import socket

from up.protocols.serial_line import SerialLike
from up.protocols.serial_port import open_serial

SOCKET = "tcp:"
CONNECT_S = 0.05


def socket_problem(port: str) -> str:
    """Return the fault of ``tcp:ADDRESS:PORT``; empty: none."""
    host, _, number = port.removeprefix(SOCKET).rpartition(":")
    try:
        address = ipaddress.ip_address(host.strip("[]"))
    except ValueError:
        return f"{port!r} is not tcp:ADDRESS:PORT with a numeric address"
    # MSP has neither keys nor encryption: a program that reaches it moves the servos.
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
    try:
        # On this computer a connection is made or refused immediately.
        line = socket.create_connection((host.strip("[]"), int(number)), CONNECT_S)
    except OSError as error:
        raise OSError(f"no board on {port}: {error.strerror or error}") from error
    line.setblocking(False)
    line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    return line
