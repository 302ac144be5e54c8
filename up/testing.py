"""Tools for testing modules: a small system whose time only the test advances."""

import math
import queue
import time
from collections.abc import Callable, Coroutine
from pathlib import Path
from typing import Any, TypeVar

from twisted.internet.defer import Deferred
from twisted.internet.task import Clock

from up.base_module import BaseModule
from up.commands.orientation_command import OrientationCommand
from up.context import Context
from up.flight_modes.flight_mode import FlightSituation
from up.flight_modes.navigation_state import LocalFrame, NavigationState, Point
from up.life_cycle import LifeCycle
from up.loading.order import order
from up.loading.plan import Plan
from up.mode import Mode
from up.up import Up

_M = TypeVar("_M", bound=BaseModule)

THREAD_LIMIT_S = 30.0
_STEP_S = 0.005


class StillClock(Clock):
    """A reactor without sockets, whose time stands still until ``advance``.

    Calls from threads wait until the test runs them with ``take_call``.
    """

    def __init__(self) -> None:
        super().__init__()
        self._handed_over: queue.Queue[Callable[[], Any]] = queue.Queue()

    def callFromThread(self, call: Callable[..., Any], *args: Any, **kwargs: Any) -> None:  # noqa: N802
        """Queue a call for the thread that moves the clock."""
        self._handed_over.put(lambda: call(*args, **kwargs))

    def take_call(self, timeout_s: float = THREAD_LIMIT_S) -> None:
        """Wait for a thread's next call and run it; raises queue.Empty after the timeout."""
        self._handed_over.get(timeout=timeout_s)()


class Bench:
    """A system of the given module classes, initialized; ``clock`` moves its time.

    Reads configuration from a folder, which may be empty. Raises BootError as a boot would.
    """

    def __init__(
        self, *modules: type[BaseModule], config_folder: Path, mode: Mode = Mode.AUTO
    ) -> None:
        self.clock = StillClock()
        context = Context(self.clock, mode, config_folder)
        built = [cls() for cls in modules]
        for module in built:
            module.bind(context)
        self.up = Up(Plan(modules=order(built)), context)
        self.up.initialize()
        self._life = LifeCycle(self.up)

    def module(self, cls: type[_M]) -> _M:
        """Return the module of a class; raises LookupError if it is not in the system."""
        found = self.up.get_module(cls)
        if found is None:
            raise LookupError(f"{cls.__name__} is not in this system")
        return found

    def start(self) -> None:
        self._finish(self._life.start())

    def stop(self) -> None:
        self._finish(self._life.stop())

    def advance(self, *steps_s: float) -> None:
        self.clock.pump(steps_s)

    def _finish(self, work: Coroutine[Any, Any, None]) -> None:
        outcome: list[Any] = []
        Deferred.fromCoroutine(work).addBoth(outcome.append)
        deadline_s = time.monotonic() + THREAD_LIMIT_S
        while not outcome:
            if time.monotonic() > deadline_s:
                raise TimeoutError(f"not done after {THREAD_LIMIT_S:.0f} s")
            # Threads need real time to end; the modules' own limits use the fake clock's.
            time.sleep(_STEP_S)
            self.clock.advance(_STEP_S)
        if hasattr(outcome[0], "raiseException"):
            outcome[0].raiseException()


def situation_at(
    north_m: float = 0.0,
    east_m: float = 0.0,
    *,
    altitude_m: float = 200.0,
    course_deg: float = 0.0,
    time_s: float = 0.0,
    **given: Any,
) -> FlightSituation:
    """Return what a flight mode sees in level flight at 11 m/s in calm air.

    ``given`` are other fields of FlightSituation, such as ``home`` and ``target``.
    """
    course = math.radians(course_deg)
    velocity_m_s = Point(11.0 * math.cos(course), 11.0 * math.sin(course))
    state = NavigationState(
        time_s=time_s,
        frame=LocalFrame(48.0, 17.0),
        position=Point(north_m, east_m),
        velocity_m_s=velocity_m_s,
        altitude_m=altitude_m,
        climb_m_s=0.0,
        wind_m_s=Point(0.0, 0.0),
        airspeed_m_s=11.0,
        heading_deg=course_deg,
        roll_deg=0.0,
        pitch_deg=0.0,
        position_sd_m=2.0,
        altitude_sd_m=3.0,
        wind_sd_m_s=0.5,
        airspeed_sd_m_s=0.5,
        heading_sd_deg=2.0,
        fix_age_s=0.5,
    )
    orientation = OrientationCommand(0.0, 0.0, course_deg, 0.0, 0.0, 0.0, sequence=1)
    return FlightSituation(time_s, orientation, **{"navigation": state, **given})
