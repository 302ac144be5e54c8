"""Which of several paths to the proxy carries the link."""

from math import inf

from up.quick_dataclass import dataclass

PROBE_S = 5.0
"""Period of the probes of each path that does not carry the link."""
HEALTHY_S = 2.5 * PROBE_S
"""A path without a successful probe for longer is not healthy."""
MAX_DOUBLINGS = 4
STABLE_S = 300.0
"""A path that carried the link for longer begins without earlier losses."""


@dataclass(slots=True)
class _Path:
    healthy_since_s: float = inf
    answered_s: float = -inf
    failed_s: float = -inf
    losses: int = 0


class PathSelector:
    """Selects a path by number, 0 is the best; all times are monotonic seconds.

    The link leaves a silent path for any healthy one. It returns to a better path only after that
    was healthy for ``return_after_s`` without a break, twice as long after each loss: a path that
    comes and goes does not take the link with it.
    """

    def __init__(self, count: int, return_after_s: float) -> None:
        self.current = 0
        self._paths = [_Path() for _ in range(count)]
        self._return_after_s = return_after_s
        self._carries_since_s = inf

    def next(self, now_s: float) -> int:
        """Return the path of the next attempt.

        The best healthy one; without any, the one that failed longest ago.
        """
        return min(range(len(self._paths)), key=lambda path: self._rank(path, now_s))

    def carries(self, path: int, now_s: float) -> None:
        """Note that a path carries the link from now on: it is the current one."""
        self.current, self._carries_since_s = path, now_s
        self.answered(path, now_s)

    def answered(self, path: int, now_s: float) -> None:
        """Note an answer on a path: of a probe, or an acknowledgement of the link's data."""
        if not self.is_healthy(path, now_s):
            self._paths[path].healthy_since_s = now_s
        self._paths[path].answered_s = now_s

    def failed(self, path: int, now_s: float) -> None:
        self._paths[path].failed_s = now_s
        self._paths[path].healthy_since_s = inf

    def lost(self, now_s: float) -> None:
        """Note that the current path lost the link."""
        path = self._paths[self.current]
        if self._carries_since_s < inf:
            path.losses = 1 if now_s - self._carries_since_s > STABLE_S else path.losses + 1
        self._carries_since_s = inf
        self.failed(self.current, now_s)

    def is_healthy(self, path: int, now_s: float) -> bool:
        each = self._paths[path]
        return each.healthy_since_s <= now_s and now_s - each.answered_s <= HEALTHY_S

    def has_other(self, than: int, now_s: float) -> bool:
        """Return whether another path is healthy: reason enough to leave a silent one."""
        others = (path for path in range(len(self._paths)) if path != than)
        return any(self.is_healthy(path, now_s) for path in others)

    def has_better(self, now_s: float) -> bool:
        """Return whether a better path has been healthy long enough to return to it."""
        return any(self._is_trusted(path, now_s) for path in range(self.current))

    def _is_trusted(self, path: int, now_s: float) -> bool:
        each = self._paths[path]
        hold_s = self._return_after_s * 2.0 ** min(max(each.losses - 1, 0), MAX_DOUBLINGS)
        return self.is_healthy(path, now_s) and now_s - each.healthy_since_s >= hold_s

    def _rank(self, path: int, now_s: float) -> tuple[bool, float, int]:
        if self.is_healthy(path, now_s):
            return False, float(not self._is_trusted(path, now_s)), path
        return True, self._paths[path].failed_s, path
