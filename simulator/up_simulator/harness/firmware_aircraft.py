"""An aircraft that the firmware flies in real time, and that flies again after a crash."""

from __future__ import annotations

from collections.abc import Callable

from up_simulator.aircraft import Start
from up_simulator.aircraft.flight import Clock, FlightSource
from up_simulator.firmware.board import FirmwareBoard
from up_simulator.harness.real_time import RealTimeWorld, SerialLine
from up_simulator.harness.user_log import Log
from up_simulator.harness.world import World
from up_simulator.radio.choice import is_initially_armed
from up_simulator.radio.sticks import Radio

RELAUNCH_DELAY_S = 3.0
MIN_BATTERY_PERCENT = 12.0
BATTERY_PERIOD_S = 1.0


class FirmwareAircraft:
    """A world with its radio; ``radio_name`` decides whether the pilot arms on the ground.

    A crash is reported, and 3 s later the aircraft is in the air again with a freshly powered
    board. A nearly empty battery is replaced in flight, with a report: it would end every long
    session. ``describe_pilot`` returns the mode and the owner of the sticks for the crash report.
    Raises ``BoardCrashedError``.
    """

    def __init__(
        self,
        flight: FlightSource,
        board: FirmwareBoard,
        line: SerialLine,
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
        self._crashed_s: float | None = None
        self._battery_s = 0.0
        self._describe_pilot = describe_pilot
        self._cause = ""
        world = World(flight, board)
        world.boot(arms=self._arms)
        self.real_time = RealTimeWorld(world, line, radio, clock, log)

    def advance(self) -> None:
        """Fly until now. Raises ``BoardCrashedError``."""
        self.real_time.advance()
        if self._flight.crash is None:
            self._watch_battery()
            return
        now_s = self._clock.seconds()
        if self._crashed_s is None:
            self._crashed_s = now_s
            self._cause = f" ({self._describe_pilot()})" if self._describe_pilot() else ""
            text = f"{self._flight.crash}{self._cause}; relaunch in {RELAUNCH_DELAY_S:.0f} s"
            self._log(text, code="crashed", crash=self._flight.crash)
        elif now_s - self._crashed_s >= RELAUNCH_DELAY_S:
            self._crashed_s = None
            self.real_time.relaunch(self._launch)
            self._log(f"relaunched in the air after the crash{self._cause}", code="relaunched")

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
