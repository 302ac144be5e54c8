"""The aircraft's companions: the daemon, the phone and the ground station, or none."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Protocol

from up_simulator.harness.participants import Ground, Phone, Raspilot
from up_simulator.scenario.event import Event
from up_simulator.scenario.line_board import LineBoard

AGAIN_S = 0.5


class Companions(Protocol):
    """The crew of a flight as a whole; a missing member stays None."""

    @property
    def raspilot(self) -> Raspilot | None:
        """Return the daemon."""

    @property
    def ground(self) -> Ground | None:
        """Return the ground station."""

    @property
    def phone(self) -> Phone | None:
        """Return the phone aboard."""

    @property
    def black_boxes(self) -> Mapping[str, bytes]:
        """Return the files, by name, that a real daemon has recorded; there once all have ended."""

    def start(self) -> None:
        """Start all members; raises CrewError."""

    def is_ready(self) -> bool:
        """Return whether the flight may begin: all expected members have connected."""

    def exchange(self, step_s: float) -> None:
        """Pass bytes and let this time go by; raises CrewError when a member has died."""

    def seconds(self) -> float:
        """Return the crew's time."""

    def carry_out(self, event: Event) -> None:
        """Carry out an event that concerns the crew; raises CrewError."""

    def stop(self) -> None:
        """End all members."""


class Nobody:
    """No Raspberry Pi: a listener on the serial line requests the board's streams."""

    raspilot: Raspilot | None = None
    ground: Ground | None = None
    phone: Phone | None = None
    black_boxes: Mapping[str, bytes] = MappingProxyType({})

    def __init__(self, board: LineBoard) -> None:
        self._board = board
        self._asked_s = -AGAIN_S

    def start(self) -> None:
        """Do nothing: no member has to start."""

    def is_ready(self) -> bool:
        """Return True: no member has to connect."""
        return True

    def exchange(self, step_s: float) -> None:
        """Listen; request again after a reset, which ends the streams."""
        board = self._board
        board.read()
        now_s = board.now_s
        is_silent = now_s - board.tap.status_s > AGAIN_S
        if is_silent and now_s - self._asked_s >= AGAIN_S:
            self._asked_s = now_s
            board.write(board.tap.start_bytes())

    def seconds(self) -> float:
        """Return the board's time."""
        return self._board.now_s

    def carry_out(self, event: Event) -> None:
        """Do nothing: no member is affected."""

    def stop(self) -> None:
        """Do nothing: no member has to end."""
