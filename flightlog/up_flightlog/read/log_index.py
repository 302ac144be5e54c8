"""The position of every message of a flight: about 26 bytes per message, whatever its size."""

from __future__ import annotations

from array import array
from bisect import bisect_left
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from itertools import compress

from up_flightlog.read.timestamp_outliers import outliers

MAX_TOPICS = 65535
MAX_PARTS = 65535
EXPANDED = 1 << 47
"""Added to an offset in the `ExpandedRecords`, not in the part's file."""
_PART_SHIFT = 48
_OFFSET_MASK = (1 << _PART_SHIFT) - 1


class LogIndex:
    """Messages in the order of their time; a position is a message's number in that order.

    Read ``times_ns``, ``topic_of`` (their topics' numbers) and the rest only after `finish`.
    """

    def __init__(self) -> None:
        self.times_ns = array("Q")
        self.topics: dict[str, int] = {}
        self.topic_of = array("H")
        self._places = array("Q")
        self._sizes = array("I")
        self._positions: list[array[int]] = []

    def __len__(self) -> int:
        return len(self.times_ns)

    def topic(self, name: str) -> int | None:
        """Return the number of a topic, a new one for a new name; None if there are too many."""
        number = self.topics.get(name)
        if number is None and len(self.topics) < MAX_TOPICS:
            number = self.topics[name] = len(self.topics)
        return number

    def adder(self, part: int, base: int = 0) -> Callable[[int, int, int, int], None]:
        """Return a function that adds (topic, time, offset, size) of a message of that part.

        ``base`` is added to each offset.
        """
        add_topic, add_time = self.topic_of.append, self.times_ns.append
        add_place, add_size = self._places.append, self._sizes.append
        high = (part << _PART_SHIFT) + base

        def add(topic: int, time_ns: int, offset: int, size: int) -> None:
            add_topic(topic)
            add_time(time_ns)
            add_place(high + offset)
            add_size(size)

        return add

    def drop_outliers(self) -> Counter[int]:
        """Remove the messages with impossible times; return how many by part."""
        found = set(outliers(self.times_ns))
        parts = Counter(self._places[each] >> _PART_SHIFT for each in found)
        if found:
            kept = [each for each in range(len(self)) if each not in found]
            self._rearrange(kept)
        return parts

    def finish(self) -> None:
        """Sort the messages by time; messages of one moment keep their order."""
        times = self.times_ns
        if all(map(int.__le__, times, times[1:])):
            return
        self._rearrange(sorted(range(len(times)), key=times.__getitem__))

    def _rearrange(self, order: Sequence[int]) -> None:
        for each in (self.times_ns, self.topic_of, self._places, self._sizes):
            each[:] = array(each.typecode, map(each.__getitem__, order))

    def counts(self) -> dict[str, int]:
        counted = Counter(self.topic_of)
        return {name: counted[number] for name, number in self.topics.items()}

    def places_of(self, positions: Iterable[int]) -> list[tuple[int, int, int]]:
        """Return each message's part, the offset of its data and their size."""
        places, sizes = self._places, self._sizes
        return [
            (places[each] >> _PART_SHIFT, places[each] & _OFFSET_MASK, sizes[each])
            for each in positions
        ]

    def positions(self, topics: Sequence[str], since_ns: int = 0) -> Iterable[int]:
        """Return the positions of the messages of these topics (default: all)."""
        if not topics:
            return range(self._first(since_ns), len(self))
        wanted = {self.topics[name] for name in topics if name in self.topics}
        if len(wanted) == 1:
            found = self._of_topic(*wanted)
            return found[bisect_left(found, self._first(since_ns)) :] if since_ns else found
        first = self._first(since_ns)
        everything = range(first, len(self) if wanted else first)
        is_wanted = [number in wanted for number in range(len(self.topics))]
        return compress(everything, map(is_wanted.__getitem__, self.topic_of[first:]))

    def _of_topic(self, number: int) -> array[int]:
        if not self._positions:
            self._positions = [array("I") for _ in self.topics]
            adders = [each.append for each in self._positions]
            for position, topic in enumerate(self.topic_of):
                adders[topic](position)
        return self._positions[number]

    def _first(self, since_ns: int) -> int:
        return bisect_left(self.times_ns, since_ns) if since_ns else 0
