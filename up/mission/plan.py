"""A mission and a fence as a file holds them, and the problems of such a file."""

from collections.abc import Mapping, Sequence
from dataclasses import field
from typing import Any, TypeAlias

from up.commands.mission_commands import FENCE, MAX_ITEMS
from up.errors import UserError
from up.mission.items import ITEM_CLASSES, Border, MissionItem, PlanItem
from up.quick_dataclass import dataclass

PLAN, WAYPOINTS = FORMS = ("plan", "waypoints")
Position: TypeAlias = tuple[float, float, float]
"""Latitude, longitude (deg) and altitude above sea level (m)."""


@dataclass(frozen=True, slots=True)
class PlanProblem:
    """A problem of an item (the first is 1), or of the plan as a whole (0)."""

    plan: str
    item: int
    code: str
    text: str

    def __str__(self) -> str:
        if not self.item:
            return self.text
        return f"{'border' if self.plan == FENCE else 'item'} {self.item}: {self.text}"

    @property
    def fields(self) -> Mapping[str, Any]:
        return {"plan": self.plan, "item": self.item}

    @property
    def data(self) -> dict[str, Any]:
        return {**self.fields, "code": self.code, "text": self.text}


class PlanError(UserError):
    """All problems of a plan; nothing of it was used. ``name`` is that of its file, or empty."""

    def __init__(self, name: str, problems: Sequence[PlanProblem]) -> None:
        head = f"{name}: " if name else ""
        super().__init__("\n".join(f"{head}{each}" for each in problems), problems[0].code)
        self._members = self.found = tuple(problems)


@dataclass(frozen=True, slots=True)
class Plan:
    """The contents of a file.

    ``home`` is the place for which it was planned, ``cruise_m_s`` the speed that its author
    assumed; both are information only. ``notes`` name what has no effect and was left out;
    ``numbers`` are the numbers of ``items`` in the file.
    """

    form: str
    items: tuple[MissionItem, ...] = ()
    borders: tuple[Border, ...] = ()
    home: Position | None = None
    cruise_m_s: float | None = None
    notes: tuple[PlanProblem, ...] = ()
    numbers: tuple[int, ...] = ()


@dataclass(slots=True)
class Findings:
    """Collects the problems and the notes of a file while it is read."""

    problems: list[PlanProblem] = field(default_factory=list)
    notes: list[PlanProblem] = field(default_factory=list)

    def problem(self, plan: str, item: int, code: str, text: str) -> None:
        self.problems.append(PlanProblem(plan, item, code, text))

    def note(self, plan: str, item: int, code: str, text: str) -> None:
        self.notes.append(PlanProblem(plan, item, code, text))


def position(given: object) -> Position | None:
    """Return a position of decoded JSON; None if it is not one."""
    if not isinstance(given, list | tuple) or len(given) != 3:
        return None
    for each, limit in zip(given, (90, 180, 100_000), strict=True):
        is_number = isinstance(each, int | float) and not isinstance(each, bool)
        if not is_number or not -limit <= each <= limit:
            return None
    latitude, longitude, altitude = map(float, given)
    return latitude, longitude, altitude


def checked_items(plan: str, given: Sequence[Any]) -> tuple[PlanItem, ...]:
    """Return the items of a mission, or the borders of a fence, from decoded JSON.

    Raises PlanError.
    """
    found = Findings()
    items: list[PlanItem] = []
    if len(given) > (limit := MAX_ITEMS[plan]):
        found.problem(plan, limit + 1, "too_many", f"at most {limit}, and these are {len(given)}")
        raise PlanError("", found.problems)
    for number, each in enumerate(given, 1):
        try:
            if not isinstance(each, dict):
                raise ValueError("must be an object")
            items.append(ITEM_CLASSES[plan].from_data(each))
        except ValueError as error:
            found.problem(plan, number, "item_invalid", str(error))
    if found.problems:
        raise PlanError("", found.problems)
    return tuple(items)
