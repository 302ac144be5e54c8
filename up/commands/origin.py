"""The origin of a Command."""

import re

from up.commands.roles import Role
from up.quick_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class Origin:
    """The link that a Command came on.

    ``link`` names it ("mission_control", ...); providers use the name as the
    source of a reading, and ``priority`` to choose between sources (the higher wins). ``key`` is
    the name of the device's key; empty for a plain link, whose role is configuration.
    """

    link: str
    role: Role
    priority: int = 0
    key: str = ""


INTERNAL = Origin("internal", Role.INTERNAL)
_NAME = re.compile(r"[a-z][a-z0-9_]*", re.ASCII)


def link_name_problem(name: str) -> str:
    """Return the error in a link's name from a configuration; empty: none."""
    return "" if _NAME.fullmatch(name) else f"{name!r} must be letters from a to z, digits and _"
