"""The requirements for every instance, and the delay before one is restarted."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping, Sequence

from up.quick_dataclass import dataclass
from up_runner.config import Restarts, RunnerConfig
from up_runner.response import Problem

ASLEEP = "asleep"
"""The code of an instance that sleeps until the next request for its aircraft."""


@dataclass(frozen=True, slots=True)
class Policy:
    """The requirements for every instance; times in seconds.

    `exit_delay_s` None: a lost phone never stops it. `always_restart`: it may be in flight, so it
    restarts after any exit status. It is not ready before it has announced its `needed_ports`.
    `sleeps`: after `exit_delay_s` it sleeps, and only while it reports that it is not armed.
    """

    start_limit_s: float
    watchdog_s: float | None
    exit_delay_s: float | None
    restarts: Restarts
    always_restart: bool
    needed_ports: tuple[str, ...] = ()
    sleeps: bool = False

    def unbound(self, ports: Mapping[str, int], found: frozenset[int] | None) -> list[str]:
        """Return the ports that are missing: not announced, or not among those of the kernel."""
        missing = [name for name in self.needed_ports if name not in ports]
        if found is not None:
            missing += [f"{name} {port}" for name, port in ports.items() if port not in found]
        return missing

    def late_start(self, unbound: Sequence[str]) -> Problem:
        """Return the problem of a start that reached its limit; `unbound` of one that was ready."""
        limit = f"within {self.start_limit_s:g} s"
        if unbound:
            text = f"Raspilot reported ready but has not bound its port {unbound[0]} {limit}"
            return Problem("port_not_bound", text)
        return Problem("not_ready", f"Raspilot did not report ready {limit}")

    def hung(self) -> Problem:
        return Problem("hung", f"Raspilot hung: no sign of life for {self.watchdog_s:g} s")

    def phone_gone(self) -> Problem:
        code = ASLEEP if self.sleeps else "phone_gone"
        return Problem(code, f"its phone was gone for {self.exit_delay_s:g} s")


def policy_of(config: RunnerConfig) -> Policy:
    """Return the requirements of a configuration for every instance.

    Only a black box stops with its phone or after failures: the others may be in flight.
    """
    black_box = config.mode == "black box"
    pool = config.pool
    exit_delay_s = config.exit_delay_s if black_box and config.exit_on_connection_lost else None
    sleeps = black_box and bool(pool.servers and pool.sleep_after_s) and exit_delay_s is None
    return Policy(
        start_limit_s=config.start_limit_s,
        watchdog_s=config.watchdog_s or None,
        exit_delay_s=pool.sleep_after_s if sleeps else exit_delay_s,
        restarts=config.restarts,
        always_restart=not black_box,
        # Without this port no phone can reach it.
        needed_ports=("general",) if black_box else (),
        sleeps=sleeps,
    )


class Backoff:
    """Counts the ends of one instance within the period of `restarts`."""

    def __init__(self, restarts: Restarts, *, gives_up: bool) -> None:
        self._restarts = restarts
        self._gives_up = gives_up
        self._ends: deque[float] = deque(maxlen=1000)

    @property
    def count(self) -> int:
        """Return how many ends were within the period at the last one."""
        return len(self._ends)

    def next_delay_s(self, now_s: float) -> float | None:
        """Count an end at `now_s` and return the delay before the restart, None to give up.

        An end older than the period no longer counts: the delays start again.
        """
        restarts = self._restarts
        while self._ends and now_s - self._ends[0] >= restarts.period_s:
            self._ends.popleft()
        self._ends.append(now_s)
        if self._gives_up and len(self._ends) > restarts.limit:
            return None
        # 2**30 periods exceed any bound; a larger exponent would only overflow.
        doublings = min(len(self._ends) - 1, 30)
        return min(restarts.delay_s * 2.0**doublings, restarts.max_delay_s)
