"""Finds the Arduino's port and opens it under its current name."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, Protocol

from up.protocols.serial_port import SerialPortError, open_serial
from up.quick_dataclass import dataclass

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


RENAMED_PREFIXES = ("/dev/ttyUSB", "/dev/ttyACM")
"""Names given in the order of plugging in; a device may return under another one."""


class PortOpener:
    """Opens the configured port, or without one the most likely Arduino.

    The USB id of the opened port is remembered, so that a device that returns under another name is
    found again. ``path`` is the last opened port. Calling it returns a descriptor and raises
    SerialPortError with one sentence.
    """

    def __init__(
        self,
        port: str,
        baud_rate: int,
        lister: Lister = list_ports,
        open_port: Callable[[str, int], int] = open_serial,
    ) -> None:
        self.path = ""
        self._port = port
        self._baud_rate = baud_rate
        self._lister = lister
        self._open_port = open_port
        self._known: UsbId | None = None
        self._silent: set[str] = set()

    def __call__(self) -> int:
        return self._open_configured() if self._port else self._open_found()

    @property
    def wanted(self) -> str:
        return self._port or WANTED

    def has_another(self) -> bool:
        """Return whether there is an untried port that was not silent before.

        After all ports were tried, all count as untried again.
        """
        if self._port:
            return False
        others = [port for port in self._found() if port.device != self.path]
        if others and all(port.device in self._silent for port in others):
            self._silent.clear()
        return bool(others)

    def pass_over(self) -> None:
        """Try another port next time: this one sends no frames."""
        self._silent.add(self.path)
        self._known = None

    def _open_configured(self) -> int:
        path = self._port
        if self._known is not None and not Path(path).exists():
            path = self._renamed() or path
        descriptor = self._open_port(path, self._baud_rate)
        self._remember(path)
        return descriptor

    def _open_found(self) -> int:
        ports = self._found()
        if not ports:
            raise SerialPortError(
                f"no serial port found: looking for {WANTED}", code="port_missing"
            )
        failure: SerialPortError | None = None
        for port in sorted(ports, key=lambda each: each.device in self._silent):
            try:
                descriptor = self._open_port(port.device, self._baud_rate)
            except SerialPortError as error:
                failure = failure or error
                continue
            self.path = port.device
            self._known = UsbId.of(port)
            return descriptor
        assert failure is not None
        raise failure

    def _found(self) -> list[PortInfo]:
        return find(self._lister(), self._known)

    def _remember(self, path: str) -> None:
        self.path = path
        if path.startswith(RENAMED_PREFIXES):
            matching = [port for port in self._lister() if port.device == path]
            self._known = UsbId.of(matching[0]) if matching else None

    def _renamed(self) -> str:
        matching = [port for port in self._lister() if UsbId.of(port) == self._known]
        return matching[0].device if len(matching) == 1 else ""
