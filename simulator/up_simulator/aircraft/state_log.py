"""The log of the true state of a flight, as CSV."""

from __future__ import annotations

from dataclasses import MISSING, fields
from pathlib import Path

from up_simulator.aircraft.flight import FlightState, Servos

COLUMNS = tuple(field.name for field in fields(FlightState) if field.default is MISSING)
SERVO_COLUMNS = ("ailerons_us", "elevator_us", "throttle_us", "rudder_us")
DECIMALS = {"latitude_deg": 8, "longitude_deg": 8, "time_s": 3}
PERIOD_S = 0.02


class StateLog:
    """A CSV line for every 20 ms of flight, flushed immediately.

    Columns are ``COLUMNS``, then the four servo positions (us). Raises ``OSError`` when it cannot
    be written.
    """

    def __init__(self, path: Path) -> None:
        self._file = path.open("w", encoding="ascii", buffering=1)
        self._file.write(",".join(COLUMNS + SERVO_COLUMNS) + "\n")
        self._next_s = 0.0

    def record(self, state: FlightState, servos_us: Servos) -> None:
        """Write a line when the next 20 ms are over."""
        if state.time_s < self._next_s - 1e-9:
            return
        self._next_s = state.time_s + PERIOD_S
        values = [f"{getattr(state, name):.{DECIMALS.get(name, 3)}f}" for name in COLUMNS]
        self._file.write(",".join([*values, *map(str, servos_us)]) + "\n")

    def close(self) -> None:
        self._file.close()
