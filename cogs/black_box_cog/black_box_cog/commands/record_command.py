"""An object that a companion computer adds to the flight log."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any, ClassVar

from up.commands.command import BaseCommand, value
from up.commands.roles import Role

_TOPIC = re.compile(r"[a-z0-9_]+(\.[a-z0-9_]+)+", re.ASCII)


@dataclass(frozen=True, slots=True)
class RecordCommand(BaseCommand):
    """An object that goes into the flight log under a separate topic."""

    NAME: ClassVar[str] = "black_box.record"
    ROLES: ClassVar[frozenset[Role]] = frozenset({Role.SENSOR})
    topic: str = value(max_length=64)
    content: dict[str, Any] = value()

    def __post_init__(self) -> None:
        if not _TOPIC.fullmatch(self.topic):
            raise ValueError(
                "topic must be words of a to z, 0 to 9 and _, joined by dots: companion.airspeed"
            )
