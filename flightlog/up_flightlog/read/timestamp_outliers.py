"""Impossible times in a log: a damaged message may claim any moment of 584 years."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from operator import sub
from statistics import median_low

_SECOND_NS = 1_000_000_000
FAR_NS = 60 * _SECOND_NS
"""A recorder writes in the order of time; a larger jump is checked."""
ENDLESS_NS = 3600 * _SECOND_NS
"""A last message this far from the rest does not belong to the flight: nothing follows it."""
_NEIGHBOURS = 16


def outliers(times_ns: Sequence[int]) -> Iterator[int]:
    """Yield the positions of times, in the order of the file, that their neighbours contradict.

    A jump that the next messages confirm is accepted: the flight continues there.
    """
    later = times_ns[1:]
    if (
        max(map(sub, later, times_ns), default=0) <= FAR_NS
        and min(map(sub, later, times_ns), default=0) >= -FAR_NS
    ):
        return
    before = _beginning(times_ns[: _NEIGHBOURS + 1])
    for place, time_ns in enumerate(times_ns):
        if abs(time_ns - before) > FAR_NS and _is_outlier(times_ns, place, before):
            yield place
        else:
            before = time_ns


def _beginning(first: Sequence[int]) -> int:
    """Return the time against which the first message is checked."""
    middle = median_low(first)
    near = sum(abs(each - middle) <= FAR_NS for each in first)
    return middle if 2 * near > len(first) else first[0]


def _is_outlier(times_ns: Sequence[int], place: int, before: int) -> bool:
    time_ns = times_ns[place]
    after = times_ns[place + 1 : place + 1 + _NEIGHBOURS]
    near_before = sum(abs(each - before) <= FAR_NS for each in after)
    near_it = sum(abs(each - time_ns) <= FAR_NS for each in after)
    earlier = times_ns[max(0, place - _NEIGHBOURS) : place]
    if 4 * sum(abs(each - time_ns) <= FAR_NS for each in (*earlier, *after)) > len(after):
        # Damage does not hit the same moment repeatedly: several sources take turns.
        return False
    if near_before == near_it:
        # Which of the two is right cannot be decided, especially at the end of a file.
        return not after and place >= _NEIGHBOURS and abs(time_ns - before) > ENDLESS_NS
    return near_before > near_it
