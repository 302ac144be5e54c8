"""An event that the user on the ground marks in the log."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from up.commands.command import BaseCommand, value
from up.commands.roles import Role


@dataclass(frozen=True, slots=True)
class MarkCommand(BaseCommand):
    """A mark in the flight log with a note of the user."""

    NAME: ClassVar[str] = "black_box.mark"
    TITLE: ClassVar[str] = 'Mark "{}"'
    ROLES: ClassVar[frozenset[Role]] = frozenset({Role.OPERATOR})
    text: str = value(max_length=200)

    def __post_init__(self) -> None:
        if not self.text.strip():
            raise ValueError("text must have 1 to 200 characters")
