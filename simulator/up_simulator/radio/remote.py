"""A radio that another program can take over, through a socket in the file system."""

from __future__ import annotations

import socket
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

from up_simulator.aircraft.flight import FlightState
from up_simulator.harness.user_log import Log
from up_simulator.radio.remote_messages import (
    MAX_DATAGRAM,
    Snapshot,
    read_sticks_of,
    write_snapshot,
)
from up_simulator.radio.sticks import LOWEST_US, Radio, RadioError, Sticks

FRESH_S = 1.0
MAX_DATAGRAMS = 16


LOW_S, HIGH_S = 0.7, 0.7
"""How long AUX2 stays on each side: the board accepts it after 300 ms, and reports it later."""


class RemoteRadio:
    """Passes the sticks of the sender at ``path``, without one those of ``pilot``.

    One sender at a time: the first, until it is silent for a second or releases the sticks.
    ``mode`` returns the board's mode if known. With ``is_armed``, the board's report, ``pilot``
    arms it again after a sender has disarmed it. Raises
    ``RadioError`` when the socket cannot be made.
    """

    def __init__(
        self,
        path: Path,
        pilot: Radio,
        log: Log,
        mode: Callable[[], str] = lambda: "",
        is_armed: Callable[[], bool | None] | None = None,
    ) -> None:
        self._path = path
        self._pilot = pilot
        self._log = log
        self._mode = mode
        self._arming = None if is_armed is None else Rearming(is_armed)
        self._sender: Any = None
        self._last_rx_s = float("-inf")
        self._taken: Sticks | None = None
        self._now = Sticks()
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self._socket.setblocking(False)
        try:
            if path.is_socket():
                path.unlink()
            self._socket.bind(str(path))
        except OSError as error:
            self._socket.close()
            text = f"cannot listen for a radio at {path}: {error}"
            raise RadioError(text, "socket_unusable") from None

    @property
    def is_taken(self) -> bool:
        return self._taken is not None

    def sticks(self, time_s: float, state: FlightState) -> Sticks:
        own = self._pilot.sticks(time_s, state)
        for _ in range(MAX_DATAGRAMS):
            try:
                datagram, sender = self._socket.recvfrom(MAX_DATAGRAM)
            except OSError:
                break
            self._receive(datagram, sender, time_s, state)
        if self._taken is not None and time_s - self._last_rx_s > FRESH_S:
            self._release(time_s)
        if self._taken is None and self._arming is not None:
            own = self._arming.sticks(time_s, own)
        self._now = own if self._taken is None else self._taken
        return self._now

    def close(self) -> None:
        self._socket.close()
        with suppress(OSError):
            self._path.unlink()
        self._pilot.close()

    def _receive(self, datagram: bytes, sender: Any, time_s: float, state: FlightState) -> None:
        try:
            sticks = read_sticks_of(datagram)
        except ValueError:
            return
        is_taken_by_other = self._taken is not None and sender != self._sender
        if sticks is not None and not is_taken_by_other:
            if self._taken is None:
                self._log("another pilot has taken the sticks", code="sticks_taken")
            self._taken, self._sender, self._last_rx_s = sticks, sender, time_s
        elif self._taken is not None and not is_taken_by_other:
            self._release(time_s)
        if sender:
            with suppress(OSError):
                answer = Snapshot(state, self._taken or self._now, self._mode(), is_taken_by_other)
                self._socket.sendto(write_snapshot(answer), sender)

    def _release(self, time_s: float) -> None:
        if self._arming is not None and self._taken is not None:
            self._arming.begin(time_s, self._taken)
        self._taken = self._sender = None
        self._log("the first pilot has the sticks again", code="sticks_released")


class Rearming:
    """Holds the throttle low and moves AUX2 from low to high, until the board is armed.

    ``is_armed`` returns the board's report, None before the first.
    """

    def __init__(self, is_armed: Callable[[], bool | None]) -> None:
        self._is_armed = is_armed
        self._begun_s: float | None = None

    def begin(self, time_s: float, left: Sticks) -> None:
        """Begin where it is needed: ``left`` is how the other pilot left the sticks."""
        if not left.is_armed or self._is_armed() is False:
            self._begun_s = time_s

    def sticks(self, time_s: float, own: Sticks) -> Sticks:
        """Return the pilot's ``own`` sticks, or those that arm while that is under way."""
        if self._begun_s is None or not own.is_armed:
            return own
        passed_s = time_s - self._begun_s
        if passed_s < LOW_S:
            return replace(own, throttle=LOWEST_US, aux2=LOWEST_US)
        is_over = passed_s >= LOW_S + HIGH_S
        if self._is_armed() or (is_over and self._is_armed() is None):
            self._begun_s = None
            return own
        if is_over:
            self._begun_s = time_s
        return replace(own, throttle=LOWEST_US)
