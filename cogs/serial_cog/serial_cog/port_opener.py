"""Opens the Arduino's port under its current name."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from serial_cog.finder import WANTED, Lister, PortInfo, UsbId, find, list_ports
from up.protocols.serial_port import SerialPortError, open_serial

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
        """Open the port."""
        return self._open_configured() if self._port else self._open_found()

    @property
    def wanted(self) -> str:
        """Return the searched port, for messages."""
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
            raise SerialPortError(f"no serial port found: looking for {WANTED}")
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
