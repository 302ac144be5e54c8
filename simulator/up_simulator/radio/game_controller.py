"""A game controller, or a real transmitter on a USB cable, as a radio."""

from __future__ import annotations

import errno
import os
from dataclasses import replace
from pathlib import Path

from up_simulator.aircraft.flight import FlightState
from up_simulator.harness.user_log import Log, no_log
from up_simulator.radio.axis_map import AxisMap, JsEventReader, MappedSticks
from up_simulator.radio.sticks import RadioError, Sticks

DEVICES = Path("/dev/input")
RETRY_S = 1.0
_READ_SIZE = 4096
_MAX_READS = 64


class GameController:
    """Reads Linux's joystick device; while it is unplugged, the receiver gets no pulses.

    A device that is plugged in again is used again. Raises
    ``RadioError`` if the device is missing or unreadable at the start.
    """

    def __init__(self, device: Path, axis_map: AxisMap, log: Log = no_log) -> None:
        self._device = device
        self._sticks = MappedSticks(axis_map)
        self._log = log
        self._reader = JsEventReader()
        self._tried_s = float("-inf")
        self._file: int | None = _open(device)

    def sticks(self, time_s: float, state: FlightState) -> Sticks:
        if self._file is None and time_s - self._tried_s >= RETRY_S:
            self._tried_s = time_s
            self._reopen()
        self._read(time_s)
        return self._sticks.now

    def close(self) -> None:
        if self._file is not None:
            os.close(self._file)
            self._file = None

    def _read(self, time_s: float) -> None:
        # A device with endless data must not block the flight.
        for _ in range(_MAX_READS):
            if self._file is None:
                return
            try:
                data = os.read(self._file, _READ_SIZE)
            except BlockingIOError:
                return
            except OSError as error:
                if error.errno not in (errno.ENODEV, errno.EIO, errno.ENXIO):
                    raise
                data = b""
            if not data:
                self._on_unplugged(time_s)
                return
            for event in self._reader.feed(data):
                self._sticks.take(event)

    def _on_unplugged(self, time_s: float) -> None:
        self.close()
        self._tried_s = time_s
        self._sticks.now = replace(self._sticks.now, is_on=False)
        text = f"{self._device} was unplugged: no pulses for the receiver until it is back"
        self._log(text, code="controller_lost")

    def _reopen(self) -> None:
        try:
            self._file = _open(self._device)
        except RadioError:
            return
        self._reader = JsEventReader()
        self._sticks.now = replace(self._sticks.now, is_on=True)
        self._log(f"{self._device} is back", code="controller_back")


def controller_device(name: str) -> Path:
    """Return the device of ``js0``; a path stays unchanged."""
    return Path(name) if "/" in name else DEVICES / name


def _open(device: Path) -> int:
    try:
        return os.open(device, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
    except FileNotFoundError:
        found = ", ".join(sorted(each.name for each in DEVICES.glob("js*")))
        there = f"there is {found}" if found else "no game controller is plugged in"
        raise RadioError(f"{device} is missing: {there}", "controller_missing") from None
    except PermissionError:
        text = f"cannot read {device}: add yourself to the group 'input' and log in again"
        raise RadioError(text, "controller_forbidden") from None
    except OSError as error:
        raise RadioError(f"{device} cannot be opened: {error.strerror}") from None
