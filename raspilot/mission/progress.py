"""How far a mission is flown, and which item comes next."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from up.commands.mission_commands import MAX_ITEMS, MISSION
from up.config import key, mapping
from up.fields import Constraint
from up.mission.items import JUMP, LAND, LOITER, RETURN, SPEED, WAYPOINT, MissionItem
from up.quick_dataclass import dataclass

NOT_FLOWN = frozenset({SPEED, JUMP})
"""Kinds that the aircraft does not fly to: they act between two others."""
LAST = frozenset({RETURN, LAND, LOITER})
"""Kinds that never end."""


@dataclass(frozen=True, slots=True)
class MissionProgress:
    """The item that is flown, or that MISSION flies next, and what of it is done.

    A finished mission has the item that it circles. It belongs to the mission ``plan_id`` alone.
    """

    plan_id: str = key("", "The mission.", max_length=16)
    item: int = key(1, "The item; the first is 1.", minimum=1, maximum=MAX_ITEMS[MISSION])
    start: int = key(
        0, "The waypoint at which its line begins; 0: none.", minimum=0, maximum=MAX_ITEMS[MISSION]
    )
    jumps: dict[str, int] = mapping(
        Constraint(str, max_length=4),
        Constraint(int, minimum=1, maximum=1000),
        "How often each jump was made, by the number of its item.",
    )
    turned_deg: float = key(0.0, "Of the circles of this item.", unit="deg", minimum=0)
    waited_s: float = key(0.0, "Time in the circles of this item.", unit="s", minimum=0)
    is_finished: bool = key(False, "Whether nothing is left to fly.")

    def at(self, items: Sequence[MissionItem], number: int) -> MissionProgress:
        """Return the progress at item ``number``, or at the first one after it that has a place.

        At the end it is finished, and has the last item that it flew.
        """
        jumps = dict(self.jumps)
        left = sum(1 + max(0, each.repeat) for each in items if each.kind == JUMP)
        while number <= len(items) and (item := items[number - 1]).kind in NOT_FLOWN:
            number += 1
            if item.kind != JUMP:
                continue
            made = jumps.get(str(number - 1), 0)
            # A loop without a waypoint is refused by the check; here it must not hang.
            if left > 0 and (item.repeat < 0 or made < item.repeat):
                left -= 1
                if item.repeat > 0:
                    jumps[str(number - 1)] = made + 1
                assert item.item is not None
                number = item.item
        if number > len(items):
            return replace(self, jumps=jumps, is_finished=True)
        return MissionProgress(self.plan_id, number, jumps=jumps)

    def next(self, items: Sequence[MissionItem]) -> MissionProgress:
        start = self.item if items[self.item - 1].kind == WAYPOINT else 0
        return replace(self.at(items, self.item + 1), start=start)


def following(items: Sequence[MissionItem], number: int) -> Iterator[int]:
    """Yield the items that may be flown after the one before ``number``, jumps made or not.

    The end is the number after the last item.
    """
    waiting, seen = [number], set[int]()
    while waiting:
        number = waiting.pop()
        if number in seen:
            continue
        seen.add(number)
        if number > len(items) or items[number - 1].kind not in NOT_FLOWN:
            yield number
            continue
        item = items[number - 1]
        if item.kind == JUMP and item.repeat != 0:
            assert item.item is not None
            waiting.append(item.item)
        if item.kind != JUMP or item.repeat >= 0:
            waiting.append(number + 1)


def airspeed_of(items: Sequence[MissionItem], number: int) -> float | None:
    """Return the airspeed of an item: the last ``speed`` before it in the list; None: cruise."""
    before = (items[index].airspeed_m_s for index in range(number - 1, -1, -1)
              if items[index].kind == SPEED)  # fmt: skip
    return next(before, None)
