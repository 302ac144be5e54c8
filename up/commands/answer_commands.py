"""The answers to Commands that carried an id."""

from up.commands.command import BaseCommand, value
from up.commands.roles import Role
from up.quick_dataclass import dataclass

_ANYBODY = frozenset(Role)
MAX_REASON, MAX_DETAIL = 500, 32
"""Characters of a reason and of a handler's code; longer ones are cut."""


@dataclass(frozen=True, slots=True)
class AckCommand(BaseCommand):
    """The Command with that id was carried out."""

    NAME = "up.ack"
    ROLES = _ANYBODY
    command_id: str = value(key="id", max_length=64)


@dataclass(frozen=True, slots=True)
class NackCommand(BaseCommand):
    """The Command with that id was not carried out, and why; ``detail`` is its handler's code."""

    NAME = "up.nack"
    ROLES = _ANYBODY
    command_id: str = value(key="id", max_length=64)
    code: str = value(max_length=32)
    reason: str = value("", max_length=MAX_REASON)
    detail: str = value("", max_length=MAX_DETAIL)


@dataclass(frozen=True, slots=True)
class CommandAnsweredCommand(BaseCommand):
    """The outcome of a Command of a link; ``untold`` counts unreported outcomes before it.

    ``key`` names the device's key, empty on a plain link; ``age_ms`` is the age of the beacon.
    """

    NAME = "up.command.answered"
    link: str = value(max_length=64)
    name: str = value(max_length=64)
    command_id: str | None = value(None, key="id", max_length=64)
    outcome: str = value("ack", choices=("ack", "nack"))
    code: str = value("", max_length=32)
    reason: str = value("", max_length=MAX_REASON)
    detail: str = value("", max_length=MAX_DETAIL)
    untold: int = value(0, minimum=0)
    key: str = value("", max_length=32)
    role: str = value("", max_length=16)
    age_ms: int | None = value(None, minimum=0)
