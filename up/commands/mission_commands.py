"""Upload, read back and continue a mission or a fence (docs/mission.md)."""

from typing import Any

from up.commands.command import BaseCommand, value
from up.commands.roles import Role
from up.quick_dataclass import dataclass

MISSION, FENCE = PLANS = ("mission", "fence")
MAX_ITEMS = {MISSION: 700, FENCE: 50}
"""A plan with more is refused."""
_MAX_ITEMS = max(MAX_ITEMS.values())
PART_ITEMS = 20
"""Items of one part."""


def _plan() -> Any:
    return value(choices=PLANS)


def _id() -> Any:
    return value(key="plan_id", max_length=16)


def _count() -> Any:
    return value(minimum=0, maximum=_MAX_ITEMS)


@dataclass(frozen=True, slots=True)
class MissionPartCommand(BaseCommand):
    """Items of a plan, from number ``first`` (the first is 1) on, of ``count``; both directions.

    Parts are collected, in any order, until MissionCommitCommand; ``plan_id`` is that of the whole
    plan (``up.mission.items.plan_id``). Parts of another plan replace them.
    """

    NAME = "up.mission.part"
    TITLE = "Part of a plan"
    ROLES = frozenset({Role.OPERATOR})
    plan: str = _plan()
    plan_id: str = _id()
    count: int = _count()
    first: int = value(1, minimum=1, maximum=_MAX_ITEMS)
    items: tuple[Any, ...] = value((), max_length=PART_ITEMS)


@dataclass(frozen=True, slots=True)
class MissionCommitCommand(BaseCommand):
    """Checks the collected plan as a whole, and uses it from now on; without items: none.

    Refused with ``plan_incomplete`` (parts are missing), ``plan_changed`` (other items than its
    identity says) or ``plan_invalid``; MissionProblemsCommand then names the items. What was in use
    before stays in use.
    """

    NAME = "up.mission.commit"
    TITLE = "Use the plan"
    ROLES = frozenset({Role.OPERATOR})
    NEEDS_BEACON = True
    plan: str = _plan()
    plan_id: str = _id()
    count: int = _count()


@dataclass(frozen=True, slots=True)
class MissionRequestCommand(BaseCommand):
    """Asks for the part of the plan in use that begins with an item; the aircraft sends it."""

    NAME = "up.mission.request"
    TITLE = "Read the plan"
    ROLES = frozenset({Role.OBSERVER})
    plan: str = _plan()
    first: int = value(1, minimum=1, maximum=_MAX_ITEMS)


@dataclass(frozen=True, slots=True)
class MissionItemCommand(BaseCommand):
    """The item that MISSION flies next; in MISSION it is flown immediately."""

    NAME = "up.mission.item"
    TITLE = "Next item"
    ROLES = frozenset({Role.OPERATOR})
    NEEDS_BEACON = True
    item: int = value(minimum=1, maximum=_MAX_ITEMS)


@dataclass(frozen=True, slots=True)
class MissionProblemsCommand(BaseCommand):
    """Why a plan was refused; the aircraft sends it before the answer.

    ``problems`` are maps of ``item`` (the first is 1; 0: the plan as a whole), ``code`` and
    ``text``; ``untold`` counts those that are not listed.
    """

    NAME = "up.mission.problems"
    plan: str = _plan()
    plan_id: str = _id()
    problems: tuple[Any, ...] = value(max_length=PART_ITEMS)
    untold: int = value(0, minimum=0)
