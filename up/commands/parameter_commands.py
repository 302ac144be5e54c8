"""Keys of configuration files that a ground reads and sets."""

from typing import Any

from up.commands.command import BaseCommand, value
from up.commands.roles import Role
from up.quick_dataclass import dataclass

MAX_VALUE = 64


@dataclass(frozen=True, slots=True)
class ParameterRequestCommand(BaseCommand):
    """Asks for the keys of one file, or of all: the answers are ``up.parameter.values``."""

    NAME = "up.parameter.request"
    TITLE = "Request parameters"
    ROLES = frozenset({Role.OBSERVER})
    file: str | None = value(None, max_length=64)


@dataclass(frozen=True, slots=True)
class ParameterSetCommand(BaseCommand):
    """Writes one key into its file: ``loiter.yml``, ``radius_m``, ``60``. Acts at the next start.

    ``key`` has dots between a section and its keys; ``setting`` is a number or a word, as in the
    file. Refused while the aircraft is armed or may be in flight. Until the next start the change
    is a veto against arming.
    """

    NAME = "up.parameter.set"
    TITLE = "Set parameter"
    ROLES = frozenset({Role.PILOT})
    NEEDS_BEACON = True
    file: str = value(max_length=64)
    key: str = value(max_length=128)
    setting: str = value(key="value", max_length=MAX_VALUE)


@dataclass(frozen=True, slots=True)
class ParameterValuesCommand(BaseCommand):
    """The keys of one file with their values in use, and those that act at the next start."""

    NAME = "up.parameter.values"
    file: str = value(max_length=64)
    values: dict[str, Any] = value()
    next_start: dict[str, Any] = value()
