"""All aircraft with connections, by name; ``handshake.py`` admits a second one of a name."""

from collections.abc import Callable
from functools import partial

from up.log import Limited
from up.protocols.proxy_lines import FULL, HelloError
from up.quick_dataclass import dataclass
from up.system.clock import Clock
from up_proxy.aircraft import AircraftSession
from up_proxy.config import LimitsConfig
from up_proxy.poller import Poller

LOG_INTERVAL_S = 10.0
"""Minimum time between two log lines of one kind about one aircraft."""
MAX_LOG_KEYS = 100
"""More kinds than this in one interval share one line."""
MIN_STEP, MAX_STEPS = 16, 50
"""The least number of aircraft in a step of a sweep, and the most steps of one."""


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
        self._poller = poller
        self._log = Limited(clock, LOG_INTERVAL_S, MAX_LOG_KEYS)
        self._make = make
        self.limits = limits
        self._sessions: dict[str, AircraftSession] = {}
        self._unswept: list[AircraftSession] = []
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
        """Detect silent peers, and remove aircraft without connections: lines go in between."""
        if not self._unswept and self._sessions:
            self._unswept = self.aircraft()
            self._sweep_some(max(MIN_STEP, len(self._unswept) // MAX_STEPS))

    def _sweep_some(self, count: int) -> None:
        some, self._unswept = self._unswept[:count], self._unswept[count:]
        if self._unswept:
            self._poller.do_later(partial(self._sweep_some, count))
        now_s = self._poller.now_s
        for session in some:
            session.grounds.keep_paused_alive(now_s)
            session.sweep()
            if session.is_deserted(now_s):
                session.close()
                self._gone.add(session)
                del self._sessions[session.name]
        self._poller.reap()

    def stop(self) -> None:
        self._log.stop()
