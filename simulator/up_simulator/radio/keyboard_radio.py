"""The keyboard of a terminal as a radio, with a status line of the flight."""

from __future__ import annotations

import select
from collections.abc import Callable
from contextlib import suppress

from up_simulator.aircraft.flight import FlightState
from up_simulator.radio.keyboard import HELP, KeyboardSticks, KeyReader
from up_simulator.radio.sticks import Sticks
from up_simulator.radio.terminal import KeyTerminal

SHOW_PERIOD_S = 0.1


class KeyboardRadio:
    """Reads the terminal's keys; ``q``, or the end of input, calls ``on_leave``.

    ``mode`` returns the board's mode, if it is known better than from the switch. Raises
    ``RadioError`` without a terminal.
    """

    def __init__(
        self,
        on_leave: Callable[[], None],
        start: Sticks | None = None,
        mode: Callable[[], str] = lambda: "",
    ) -> None:
        self._terminal = KeyTerminal()
        self._keys = KeyReader()
        self._keyboard = KeyboardSticks(start)
        self._on_leave = on_leave
        self._mode = mode
        self._is_left = False
        self._shown_s = float("-inf")
        self._terminal.echo(HELP)

    def sticks(self, time_s: float, state: FlightState) -> Sticks:
        for key in self._waiting():
            if key == "q":
                self._leave()
            elif key == "?":
                self._terminal.echo(HELP)
            else:
                self._keyboard.press(key, time_s)
        sticks = self._keyboard.sticks(time_s)
        if time_s - self._shown_s >= SHOW_PERIOD_S:
            self._shown_s = time_s
            self._terminal.show(status_line(sticks, state, self._mode()))
        return sticks

    def close(self) -> None:
        self._terminal.leave()

    def _waiting(self) -> list[str]:
        if self._is_left:
            return []
        with suppress(OSError, ValueError):
            if not select.select([self._terminal], [], [], 0)[0]:
                return []
        data = self._terminal.read()
        if not data:
            self._leave()
        return self._keys.feed(data)

    def _leave(self) -> None:
        if not self._is_left:
            self._is_left = True
            self._on_leave()


def status_line(sticks: Sticks, state: FlightState, mode: str = "") -> str:
    """Return sticks, switch, mode, attitude and height in one line for 80 columns.

    The mode that flies is named where it is another than the switch's.
    """
    part = [round((each - 1500) / 5) for each in (sticks.ailerons, sticks.elevator, sticks.rudder)]
    armed = "armed" if sticks.is_armed else "disarmed"
    flies = sticks.mode if mode in ("", sticks.mode) else f"{sticks.mode}, flies {mode}"
    return (
        f"a{part[0]:+4d} e{part[1]:+4d} r{part[2]:+4d} t{(sticks.throttle - 1000) // 10:3d}%"
        f" {flies} {armed}"
        f" bank {state.roll_deg:+.0f} pitch {state.pitch_deg:+.0f}"
        f" {state.height_m:.0f} m {state.airspeed_m_s:.0f} m/s"
    )
