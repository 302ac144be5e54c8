"""All aircraft with connections, by name; ``handshake.py`` admits a second one of a name."""

from collections.abc import Callable
from functools import partial
from math import ceil

from up.log import Limited
from up.protocols.proxy_lines import FULL, HelloError
from up.quick_dataclass import dataclass
from up.system.clock import Clock, Timer, cancel
from up_proxy.aircraft import AircraftSession
from up_proxy.config import LimitsConfig
from up_proxy.loop_tick import TICK_S
from up_proxy.poller import Poller

LOG_INTERVAL_S = 10.0
"""Minimum time between two log lines of one kind about one aircraft."""
MAX_LOG_KEYS = 100
"""More kinds than this in one interval share one line."""
STEP_AIRCRAFT, MAX_STEPS = 32, 50
"""Aircraft in a step of a sweep, about half a millisecond, until there are MAX_STEPS of them."""


@dataclass(slots=True)
class Totals:
    """Counters since the start, including aircraft that are gone."""

    air_bytes: int = 0
    ground_bytes: int = 0
    dropped_lines: int = 0
    rejected_lines: int = 0

    def add(self, counted: "AircraftSession | Totals") -> None:
        self.air_bytes += counted.air_bytes
        self.ground_bytes += counted.ground_bytes
        self.dropped_lines += counted.dropped_lines
        self.rejected_lines += counted.rejected_lines


class AircraftRegistry:
    """Creates an aircraft when its first connection names it, removes it after its last one."""

    def __init__(
        self,
        clock: Clock,
        poller: Poller,
        limits: LimitsConfig,
        make: Callable[[str, Poller, Limited], AircraftSession],
    ) -> None:
        self._clock = clock
        self._poller = poller
        self._log = Limited(clock, LOG_INTERVAL_S, MAX_LOG_KEYS)
        self._make = make
        self.limits = limits
        self._sessions: dict[str, AircraftSession] = {}
        self._steps_left = 0
        self._timers: list[Timer] = []
        self._gone = Totals()

    def __len__(self) -> int:
        return len(self._sessions)

    def aircraft(self) -> list[AircraftSession]:
        return list(self._sessions.values())

    def totals(self) -> Totals:
        totals = Totals()
        totals.add(self._gone)
        for session in self._sessions.values():
            totals.add(session)
        return totals

    def session(self, name: str) -> AircraftSession:
        """Return the aircraft of this name, creating it if it is unknown.

        Raises HelloError with code `full` if there are too many.
        """
        session = self._sessions.get(name)
        if session is None:
            if len(self._sessions) >= self.limits.aircraft:
                raise HelloError(FULL, "too many aircraft on this proxy")
            session = self._sessions[name] = self._make(name, self._poller, self._log)
        return session

    def check_room(self, session: AircraftSession, token: str | None = None) -> None:
        """Raise HelloError with code `full` if no further ground may listen.

        A ground that takes free control, or resumes it with its token, is always accepted.
        """
        lease = session.grounds.lease
        listeners = len(session.grounds.connections) - (lease.owner is not None)
        if listeners >= self.limits.listeners and not (
            lease.is_free(self._poller.now_s) or lease.is_resumed_by(token)
        ):
            raise HelloError(FULL, "too many grounds for this aircraft")

    def sweep(self) -> None:
        """Detect silent peers, and remove aircraft without connections, within TICK_S.

        A few at a time, spread over this time, and lines go in between: no line waits for the
        whole, nor does the other work of a full core.
        """
        if self._steps_left or not self._sessions:
            return
        everyone = self.aircraft()
        count = self._steps_left = min(MAX_STEPS, ceil(len(everyone) / STEP_AIRCRAFT))
        self._timers = [
            self._clock.callLater(
                TICK_S * number / count,
                self._poller.do_later,
                partial(self._sweep_some, everyone[number::count]),
            )
            for number in range(count)
        ]

    def _sweep_some(self, sessions: list[AircraftSession]) -> None:
        self._steps_left -= 1
        if not self._steps_left:
            self._timers.clear()  # they have references to all aircraft
        now_s = self._poller.now_s
        for session in sessions:
            session.grounds.keep_paused_alive(now_s)
            session.sweep()
            if session.is_deserted(now_s):
                session.close()
                self._gone.add(session)
                del self._sessions[session.name]
        self._poller.reap()

    def stop(self) -> None:
        cancel(*self._timers)
        self._log.stop()
