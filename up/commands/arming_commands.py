"""Arming and disarming: the motor and the Raspberry Pi's authority."""

from up.commands.command import BaseCommand
from up.commands.roles import Role
from up.quick_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class ArmCommand(BaseCommand):
    """Arm; the board decides, and an arming veto or a missing beacon refuses it before."""

    NAME = "up.arm"
    TITLE = "Arm"
    ROLES = frozenset({Role.PILOT})
    NEEDS_BEACON = True


@dataclass(frozen=True, slots=True)
class DisarmCommand(BaseCommand):
    """Disarm; refused without a fresh beacon and unless the throttle has been low for 2 s."""

    NAME = "up.disarm"
    TITLE = "Disarm"
    ROLES = frozenset({Role.PILOT})
    NEEDS_BEACON = True
