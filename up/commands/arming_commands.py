"""Arming and disarming: the motor and the Raspberry Pi's authority."""

from __future__ import annotations

from typing import ClassVar

from up.commands.command import BaseCommand
from up.commands.roles import Role
from up.quick_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class ArmCommand(BaseCommand):
    """Arm; the board decides, and an arming veto or a missing beacon refuses it before."""

    NAME: ClassVar[str] = "up.arm"
    TITLE: ClassVar[str] = "Arm"
    ROLES: ClassVar[frozenset[Role]] = frozenset({Role.PILOT})
    NEEDS_BEACON: ClassVar[bool] = True


@dataclass(frozen=True, slots=True)
class DisarmCommand(BaseCommand):
    """Disarm; refused without a fresh beacon and unless the throttle has been low for 2 s."""

    NAME: ClassVar[str] = "up.disarm"
    TITLE: ClassVar[str] = "Disarm"
    ROLES: ClassVar[frozenset[Role]] = frozenset({Role.PILOT})
    NEEDS_BEACON: ClassVar[bool] = True
