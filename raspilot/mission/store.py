"""A plan in use, the parts of its successor, and its file."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

from up.commands.command import InvalidCommandError
from up.commands.mission_commands import (
    MAX_ITEMS,
    PART_ITEMS,
    MissionCommitCommand,
    MissionPartCommand,
    MissionRequestCommand,
)
from up.commands.refusal import Code, CommandRefusedError
from up.config.atomic_writer import write_atomically
from up.config.loader import read_text
from up.errors import UserError
from up.mission.items import ITEM_CLASSES, PlanItem, plan_id

MAX_PART_BYTES = 6000
"""Of the items of one part: a border with 100 corners needs 4,500."""


class Problem(NamedTuple):
    """Why a plan cannot be used; ``item`` 0: as a whole."""

    item: int
    code: str
    text: str


class PlanStore:
    """The plan that is in use, and the parts of the one that a ground uploads."""

    def __init__(self, plan: str, folder: Path) -> None:
        self.plan = plan
        self.items: tuple[PlanItem, ...] = ()
        self.plan_id = ""
        self._path = folder / f"{plan}.json"
        self._staged = ("", 0)
        self._parts: dict[int, PlanItem | Problem] = {}

    def load(self) -> UserError | None:
        """Use the plan of the file; return why it is not used. Nothing is used in part."""
        found: list[UserError] = []

        def report(_: int, __: int, what: str, code: str = "", *more: str) -> None:
            found.append(UserError(f"{self._path.name}: {what}", code))

        try:
            text = read_text(self._path, report)
            if text is not None:
                self._use_text(text)
        except UserError as error:
            found.append(error)
        return found[0] if found else None

    def save(self, items: tuple[PlanItem, ...]) -> None:
        """Write the file atomically, or remove it; raises OSError."""
        if not items:
            self._path.unlink(missing_ok=True)
            return
        self._path.parent.mkdir(parents=True, exist_ok=True)
        content = {"plan_id": plan_id(items), "items": [each.data for each in items]}
        write_atomically(self._path, json.dumps(content, indent=1).encode() + b"\n")

    def use(self, items: tuple[PlanItem, ...], identity: str) -> None:
        self.items, self.plan_id = items, identity
        self._staged = ("", 0)
        self._parts.clear()

    def stage(self, part: MissionPartCommand) -> None:
        """Keep a part until the commit; raises CommandRefusedError for one beside the plan."""
        if part.first + len(part.items) - 1 > part.count:
            text = f"the part ends after item {part.count}, the last one"
            raise CommandRefusedError(text, Code.INVALID, detail="plan_changed")
        if self._staged != (part.plan_id, part.count):
            self._staged = (part.plan_id, part.count)
            self._parts.clear()
        for number, data in enumerate(part.items, part.first):
            self._parts[number] = self._item(number, data)

    def staged(self, commit: MissionCommitCommand) -> tuple[list[PlanItem], list[Problem]]:
        """Return the items of a plan, and the problems of others.

        Raises CommandRefusedError while parts are missing.
        """
        if commit.count == 0:
            return [], []
        parts = self._parts if self._staged == (commit.plan_id, commit.count) else {}
        missing = [number for number in range(1, commit.count + 1) if number not in parts]
        if missing:
            text = f"{len(missing)} of {commit.count} items are missing, first item {missing[0]}"
            raise CommandRefusedError(text, detail="plan_incomplete")
        ordered = [parts[number] for number in range(1, commit.count + 1)]
        return (
            [each for each in ordered if not isinstance(each, Problem)],
            [each for each in ordered if isinstance(each, Problem)],
        )

    def part(self, request: MissionRequestCommand) -> MissionPartCommand:
        """Return the part in use that begins with an item; raises CommandRefusedError."""
        count = len(self.items)
        if request.first > max(count, 1):
            text = f"the {self.plan} in use has {count} items"
            raise CommandRefusedError(text, Code.INVALID, detail="no_item")
        size = 0
        items: list[dict[str, Any]] = []
        for each in self.items[request.first - 1 :][:PART_ITEMS]:
            size += len(json.dumps(each.data))
            if items and size > MAX_PART_BYTES:
                break
            items.append(each.data)
        return MissionPartCommand(self.plan, self.plan_id, count, request.first, tuple(items))

    def _use_text(self, text: str) -> None:
        name = self._path.name
        try:
            content = json.loads(text)
        except (ValueError, RecursionError):
            raise UserError(f"{name}: is not JSON; upload it again", "cut_short") from None
        given = content.get("items") if isinstance(content, dict) else None
        if not isinstance(given, list) or not 0 < len(given) <= MAX_ITEMS[self.plan]:
            most = MAX_ITEMS[self.plan]
            raise UserError(f"{name}: items must be a list of 1 to {most} items", "wrong_type")
        items = [self._item(number, data) for number, data in enumerate(given, 1)]
        for each in items:
            if isinstance(each, Problem):
                text = f"{name}: item {each.item}: {each.text}"
                raise UserError(text, each.code, item=each.item)
        good = tuple(each for each in items if not isinstance(each, Problem))
        identity = plan_id(good)
        if content.get("plan_id") != identity:
            raise UserError(f"{name}: plan_id is not that of the items", "plan_changed")
        self.use(good, identity)

    def _item(self, number: int, data: Any) -> PlanItem | Problem:
        if not isinstance(data, Mapping):
            return Problem(number, "item_invalid", "the item must be a map")
        try:
            return ITEM_CLASSES[self.plan].from_data(data)
        except InvalidCommandError as error:
            return Problem(number, "item_invalid", str(error))
