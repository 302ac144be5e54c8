"""One sensor of sensors.yml: absent, another chip, or working."""

from collections import Counter
from collections.abc import Callable
from typing import Any

from sensors_cog.sensor import Aircraft, I2cSensor, WrongChipError
from up.commands.command import BaseCommand

ABSENT, WRONG_CHIP, FAILED, WORKING = "absent", "wrong_chip", "failed", "working"
RETRY_S, RETRY_FAILED_S = 1.0, 30.0
MAX_ERRORS = 3
"""Errors of the bus in succession after which the chip is set up again: it may have lost power."""


class SensorSlot:
    """Begins and reads a sensor when it is due; its faults are counted, never raised.

    ``make`` opens the bus and returns the sensor; raises OSError. ``on_state`` gets the new state
    and its reason. All runs on the thread of the caller.
    """

    def __init__(self, make: Callable[[], I2cSensor], on_state: Callable[[str, str], Any]) -> None:
        self.due_s = 0.0
        self.state = ""
        self.newest: BaseCommand | None = None
        self.counters: Counter[str] = Counter()
        self._make = make
        self._on_state = on_state
        self._sensor: I2cSensor | None = None
        self._errors = 0

    def poll(self, now_s: float, aircraft: Aircraft) -> BaseCommand | None:
        """Return a valid measurement, if the sensor is due and has a new one."""
        if now_s < self.due_s:
            return None
        try:
            return self._measure(now_s, aircraft)
        except WrongChipError as error:
            self._lost(WRONG_CHIP, str(error), now_s)
        except OSError as error:
            self.counters["bus_errors"] += 1
            self._errors += 1
            if self.state != WORKING or self._errors >= MAX_ERRORS:
                self._lost(ABSENT, error.strerror or str(error), now_s)
        except Exception as error:  # noqa: BLE001 - a user's sensor must not stop the others
            self.counters["faults"] += 1
            self._lost(FAILED, f"{type(error).__name__}: {error}", now_s)
            self.due_s = now_s + RETRY_FAILED_S
        return None

    def _measure(self, now_s: float, aircraft: Aircraft) -> BaseCommand | None:
        sensor = self._sensor
        if sensor is None:
            self.due_s = now_s + RETRY_S
            sensor = self._make()
            sensor.begin()
            self._sensor = sensor
            self._errors = 0
            self.due_s = now_s + sensor.PERIOD_S
            self._enter(WORKING, "")
            return None
        self.due_s = now_s + sensor.PERIOD_S
        measured = sensor.read(aircraft)
        self._errors = 0
        self.counters["invalid" if measured is None else "readings"] += 1
        if measured is not None:
            self.newest = measured
        return measured

    def _lost(self, state: str, reason: str, now_s: float) -> None:
        self._sensor = self.newest = None
        self.due_s = now_s + RETRY_S
        self._enter(state, reason)

    def _enter(self, state: str, reason: str) -> None:
        if state != self.state:
            self.state = state
            self._on_state(state, reason)
