"""Text for the airborne phone's voice."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from up.commands.command import BaseCommand, value
from up.commands.roles import Role


@dataclass(frozen=True, slots=True)
class AndroidSpeakCommand(BaseCommand):
    """Text for the phone's voice; carried to the phone, which answers it."""

    NAME: ClassVar[str] = "android.speak"
    TITLE: ClassVar[str] = 'Speak "{}"'
    ROLES: ClassVar[frozenset[Role]] = frozenset({Role.OPERATOR})
    ROUTE: ClassVar[str] = "android"
    text: str = value(max_length=200)

    def __post_init__(self) -> None:
        if not self.text:
            raise ValueError("text must have 1 to 200 characters")
