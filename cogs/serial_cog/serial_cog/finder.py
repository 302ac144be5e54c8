"""Finds the port of an Arduino by its USB id."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

ARDUINO, ARDUINO_ORG, FTDI, CH340, CP210X = 0x2341, 0x2A03, 0x0403, 0x1A86, 0x10C4
KNOWN_VENDORS = (ARDUINO, ARDUINO_ORG, FTDI, CH340, CP210X)
"""USB vendor ids, first those of Arduinos only, then those of any USB serial chip."""

WANTED = "an Arduino by its USB id (2341, 2a03, 0403 FTDI, 1a86 CH340, 10c4 CP210x)"


class PortInfo(Protocol):
    """The attributes of a listed port; pyserial's ListPortInfo has them."""

    device: str
    vid: int | None
    pid: int | None
    serial_number: str | None


TTYS = Path("/sys/class/tty")
"""Every serial port of a Linux system has an entry here."""

USB_NAMES = ("ttyUSB", "ttyACM")

Lister = Callable[[], Iterable[Any]]


def list_ports() -> Iterable[Any]:
    """Return the serial ports of this machine; empty without a USB port."""
    # Nothing plugged in is the usual case while waiting for an Arduino, and cheap to detect.
    if TTYS.is_dir() and not any(each.name.startswith(USB_NAMES) for each in TTYS.iterdir()):
        return ()
    # The import costs memory, and a configured port never needs it.
    from serial.tools.list_ports import comports

    return comports()


@dataclass(frozen=True, slots=True)
class UsbId:
    """The part of an id that stays the same when a device gets another port name."""

    vendor: int
    product: int | None
    serial_number: str | None

    @classmethod
    def of(cls, port: PortInfo) -> UsbId | None:
        """Return the id of a port; None if it is not a USB device."""
        if port.vid is None:
            return None
        return cls(port.vid, port.pid, port.serial_number)


def find(ports: Iterable[PortInfo], known: UsbId | None) -> list[PortInfo]:
    """Return the ports that may be an Arduino, most likely first.

    Order: the device used before, then the rarer vendor, then the port's name.
    """
    likely = [port for port in ports if port.vid in KNOWN_VENDORS]

    def rank(port: PortInfo) -> tuple[bool, int, str]:
        return UsbId.of(port) != known, KNOWN_VENDORS.index(port.vid or 0), port.device

    return sorted(likely, key=rank)
