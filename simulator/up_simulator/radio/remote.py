"""A radio that another program can take over, through a socket in the file system."""

from __future__ import annotations

import socket
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

from up_simulator.aircraft.flight import FlightState
from up_simulator.radio.arming_again import ArmingAgain
from up_simulator.radio.remote_words import LONGEST, Seen, read_sticks_of, write_seen
from up_simulator.radio.sticks import Radio, RadioError, Sticks

FRESH_S = 1.0
DATAGRAMS_MOST = 16


class RemoteRadio:
    """Passes the sticks of the sender at ``path``, without one those of ``pilot``.

    One sender at a time: the first, until it is silent for a second or gives the sticks back.
    ``mode`` returns the board's mode if known. With ``is_armed``, the board's report, ``pilot``
    arms it again after a sender has disarmed it. ``say`` takes one line for the user. Raises
    ``RadioError`` when the socket cannot be made.
    """

    def __init__(
        self,
        path: Path,
        pilot: Radio,
        say: Callable[[str], None],
        mode: Callable[[], str] = lambda: "",
        is_armed: Callable[[], bool | None] | None = None,
    ) -> None:
        self._path = path
        self._pilot = pilot
        self._say = say
        self._mode = mode
        self._arming = None if is_armed is None else ArmingAgain(is_armed)
        self._sender: Any = None
        self._heard_s = float("-inf")
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
            raise RadioError(f"no radio can be taken over at {path}: {error}") from None

    @property
    def is_taken(self) -> bool:
        """Return whether a remote sender has the sticks."""
        return self._taken is not None

    def sticks(self, time_s: float, state: FlightState) -> Sticks:
        """Return the sticks of their present owner."""
        own = self._pilot.sticks(time_s, state)
        for _ in range(DATAGRAMS_MOST):
            try:
                datagram, sender = self._socket.recvfrom(LONGEST)
            except OSError:
                break
            self._hear(datagram, sender, time_s, state)
        if self._taken is not None and time_s - self._heard_s > FRESH_S:
            self._give_back(time_s)
        if self._taken is None and self._arming is not None:
            own = self._arming.sticks(time_s, own)
        self._now = own if self._taken is None else self._taken
        return self._now

    def close(self) -> None:
        """Remove the socket."""
        self._socket.close()
        with suppress(OSError):
            self._path.unlink()
        self._pilot.close()

    def _hear(self, datagram: bytes, sender: Any, time_s: float, state: FlightState) -> None:
        try:
            sticks = read_sticks_of(datagram)
        except ValueError:
            return
        is_others = self._taken is not None and sender != self._sender
        if sticks is not None and not is_others:
            if self._taken is None:
                self._say("another pilot has taken the sticks")
            self._taken, self._sender, self._heard_s = sticks, sender, time_s
        elif self._taken is not None and not is_others:
            self._give_back(time_s)
        if sender:
            with suppress(OSError):
                answer = Seen(state, self._taken or self._now, self._mode(), is_others)
                self._socket.sendto(write_seen(answer), sender)

    def _give_back(self, time_s: float) -> None:
        if self._arming is not None and self._taken is not None:
            self._arming.begin(time_s, self._taken)
        self._taken = self._sender = None
        self._say("the first pilot has the sticks again")
