"""An aircraft that the firmware flies in real time, and that flies again after a crash."""

from __future__ import annotations

from collections.abc import Callable

from up_simulator.aircraft import Start
from up_simulator.firmware.board import FirmwareBoard
from up_simulator.harness.clock import Clock
from up_simulator.harness.flight_source import Aloft
from up_simulator.harness.real_time import RealTimeWorld, SerialLine
from up_simulator.harness.world import World
from up_simulator.radio.choice import is_armed_at_first
from up_simulator.radio.sticks import Radio

LIES_S = 3.0
BATTERY_LEAST_PERCENT = 12.0
BATTERY_PERIOD_S = 1.0


class FirmwareAircraft:
    """A world with its radio; ``radio_name`` decides whether the pilot arms on the ground.

    A crash is reported, and 3 s later the aircraft is in the air again with a freshly powered
    board. A nearly empty battery is replaced in flight, with a report: it would end every long
    session. ``who`` returns the mode and the owner of the sticks for the crash report. ``say``
    takes one line for the user. Raises ``BoardCrashedError``.
    """

    def __init__(
        self,
        flight: Aloft,
        board: FirmwareBoard,
        line: SerialLine,
        radio: Radio,
        clock: Clock,
        radio_name: str,
        say: Callable[[str], None],
        who: Callable[[], str] = lambda: "",
    ) -> None:
        self._flight = flight
        self._clock = clock
        self._say = say
        self._arms = is_armed_at_first(radio_name)
        self._crashed_s: float | None = None
        self._battery_s = 0.0
        self._who = who
        self._why = ""
        world = World(flight, board)
        world.boot(arms=self._arms)
        self.real_time = RealTimeWorld(world, line, radio, clock, say)

    def keep(self) -> None:
        """Fly until now. Raises ``BoardCrashedError``."""
        self.real_time.keep()
        if self._flight.crash is None:
            self._watch_battery()
            return
        now_s = self._clock.seconds()
        if self._crashed_s is None:
            self._crashed_s = now_s
            self._why = f" ({self._who()})" if self._who() else ""
            self._say(f"{self._flight.crash}{self._why}; in {LIES_S:.0f} s it flies again")
        elif now_s - self._crashed_s >= LIES_S:
            self._crashed_s = None
            self.real_time.begin_again(self._launch)
            self._say(f"launched again in the air, after the crash{self._why}")

    def _watch_battery(self) -> None:
        # Reading the whole state costs more than a step of the flight.
        if self.real_time.world.time_s < self._battery_s:
            return
        self._battery_s = self.real_time.world.time_s + BATTERY_PERIOD_S
        state = self._flight.state
        if state.battery_percent < BATTERY_LEAST_PERCENT:
            self._flight.change_battery()
            minutes = self.real_time.world.time_s / 60
            self._say(f"the battery is empty after {minutes:.0f} min: changed in flight")

    def _launch(self, world: World) -> None:
        self._flight.launch(Start())
        world.board.reset("power")
        world.boot(arms=self._arms)
