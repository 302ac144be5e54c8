"""What the ground and a companion computer add to the flight log."""

import re
from typing import Any

from up.commands.command import BaseCommand, value
from up.commands.roles import Role
from up.quick_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class MarkCommand(BaseCommand):
    """A mark in the flight log with a note of the user."""

    NAME = "black_box.mark"
    TITLE = 'Mark "{}"'
    ROLES = frozenset({Role.OPERATOR})
    text: str = value(max_length=200)

    def __post_init__(self) -> None:
        if not self.text.strip():
            raise ValueError("text must have 1 to 200 characters")


_TOPIC = re.compile(r"[a-z0-9_]+(\.[a-z0-9_]+)+", re.ASCII)


@dataclass(frozen=True, slots=True)
class RecordCommand(BaseCommand):
    """An object that goes into the flight log under a separate topic."""

    NAME = "black_box.record"
    ROLES = frozenset({Role.SENSOR})
    topic: str = value(max_length=64)
    content: dict[str, Any] = value()

    def __post_init__(self) -> None:
        if not _TOPIC.fullmatch(self.topic):
            raise ValueError(
                "topic must be words of a to z, 0 to 9 and _, joined by dots: companion.airspeed"
            )
