"""An aircraft that the firmware flies in real time, and that flies again after a crash."""

from __future__ import annotations

import math
from collections.abc import Callable

from up.system.clock import Clock
from up_simulator.aircraft import Start
from up_simulator.aircraft.dynamics import FlightDynamics
from up_simulator.harness.real_time import RealTimeWorld
from up_simulator.harness.user_log import Log
from up_simulator.harness.world import World
from up_simulator.radio.choice import is_initially_armed
from up_simulator.radio.sticks import Radio
from up_simulator.sensors.ubx_receiver import Line

RELAUNCH_DELAY_S = 3.0
LANDED_DELAY_S = 20.0
"""Enough for the aircraft to notice that it stands, after 10 s, and for the user to see it."""
MIN_BATTERY_PERCENT = 12.0
BATTERY_PERIOD_S = 1.0


class FirmwareAircraft:
    """A world with its radio; ``radio_name`` decides whether the pilot arms on the ground.

    A crash is reported, and 3 s later the aircraft is in the air again with a freshly powered
    board; after a landing it stands for 20 s before. A nearly empty battery is replaced in flight,
    with a report: it would end every long session. ``describe_pilot`` returns the mode and the
    owner of the sticks for the reports.
    Raises ``BoardCrashedError``.
    """

    def __init__(
        self,
        flight: FlightDynamics,
        world: World,
        line: Line,
        radio: Radio,
        clock: Clock,
        radio_name: str,
        log: Log,
        describe_pilot: Callable[[], str] = lambda: "",
    ) -> None:
        self._flight = flight
        self._clock = clock
        self._log = log
        self._arms = is_initially_armed(radio_name)
        self._ended_s: float | None = None
        self._battery_s = 0.0
        self._describe_pilot = describe_pilot
        self._end = ""
        world.boot(arms=self._arms)
        self.real_time = RealTimeWorld(world, line, radio, clock, log)

    def advance(self) -> None:
        """Fly until now. Raises ``BoardCrashedError``."""
        self.real_time.advance()
        flight, now_s = self._flight, self._clock.seconds()
        if flight.crash is None and not flight.is_landed:
            self._watch_battery()
        elif self._ended_s is None:
            self._ended_s = now_s
            self._report_end()
        elif now_s - self._ended_s >= self._delay_s:
            self._ended_s = None
            self.real_time.relaunch(self._launch)
            self._log(f"relaunched in the air after the {self._end}", code="relaunched")

    @property
    def _delay_s(self) -> float:
        return LANDED_DELAY_S if self._flight.is_landed else RELAUNCH_DELAY_S

    def _report_end(self) -> None:
        flight, pilot = self._flight, self._describe_pilot()
        self._end = "landing" if flight.is_landed else f"crash{pilot and f' ({pilot})'}"
        again = f"relaunch in {self._delay_s:.0f} s"
        if flight.is_landed:
            state = flight.state
            away_m = math.hypot(state.north_m, state.east_m)
            text = f"landed {away_m:.0f} m from the launch{pilot and f' ({pilot})'}; {again}"
            self._log(text, code="landed", distance_m=round(away_m, 1))
        else:
            text = f"{flight.crash}{pilot and f' ({pilot})'}; {again}"
            self._log(text, code="crashed", crash=flight.crash)

    def _watch_battery(self) -> None:
        # Reading the whole state costs more than a step of the flight.
        if self.real_time.world.time_s < self._battery_s:
            return
        self._battery_s = self.real_time.world.time_s + BATTERY_PERIOD_S
        state = self._flight.state
        if state.battery_percent < MIN_BATTERY_PERCENT:
            self._flight.change_battery()
            minutes = self.real_time.world.time_s / 60
            text = f"the battery is empty after {minutes:.0f} min: changed in flight"
            self._log(text, code="battery_changed")

    def _launch(self, world: World) -> None:
        self._flight.launch(Start())
        world.board.reset("power")
        world.boot(arms=self._arms)
