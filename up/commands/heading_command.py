"""The measured or required heading of the aircraft."""

from up.commands.command import BaseCommand, value
from up.commands.roles import Role
from up.quick_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class HeadingCommand(BaseCommand):
    """A heading clockwise from north, measured (``actual``) or asked for (``required``)."""

    NAME = "up.heading.change"
    ROLES = frozenset({Role.SENSOR})
    ROLES_WHERE = {"mode": {"required": frozenset({Role.OPERATOR})}}
    heading_deg: float = value(key="heading", minimum=-360, maximum=360, unit="deg")
    mode: str = value(choices=("actual", "required"))
