"""The checks of a page's Command before it is sent."""

from __future__ import annotations

import re
from collections import deque
from dataclasses import dataclass
from typing import Any

from up.commands.beacon import fresh_s
from up.commands.command import BaseCommand
from up.commands.roles import Role
from up.system.clock import Clock
from up_ground.catalogue import Catalogue, fault_of, role_of
from up_ground.telemetry import Telemetry
from up_ground.web.answers import Answer

_NAME = re.compile(r"[A-Za-z0-9_.-]{1,128}", re.ASCII)
_ROLES = {role.value: role for role in (Role.OBSERVER, Role.OPERATOR, Role.PILOT, Role.ADMIN)}


@dataclass(frozen=True, slots=True)
class Checked:
    """A Command that can be sent; ``needs_control``: only by the page that has control."""

    needs_control: bool


class Checks:
    """Refuses Commands that no aircraft of this version accepts, with the reason."""

    def __init__(self, catalogue: Catalogue) -> None:
        self._catalogue = catalogue

    def check(
        self,
        name: str,
        data: dict[str, Any],
        beacon: int | None,
        role: str | None,
        is_forced: bool = False,
    ) -> Checked | Answer:
        """Return a warning about a Command, or why it is not sent.

        ``role`` is the role that the aircraft's link permits; None: not known, the aircraft
        decides. A name unknown here, which an aircraft may know all the same, is only sent when
        ``is_forced``.
        """
        cls = self._catalogue.get(name)
        if cls is None:
            if is_forced and _NAME.fullmatch(name):
                return Checked(needs_control=True)
            near = self._catalogue.suggestions(name)
            more = f"; did you mean {' or '.join(near)}?" if near else ""
            return Answer("refused", "unknown", f"no Command is called {name[:60]}{more}")
        if cls.UNSUPPORTED:
            return Answer("refused", "not_supported", cls.UNSUPPORTED)
        if cls not in self._catalogue.sendable():
            return Answer("refused", "forbidden", f"no ground may send {name}")
        fault = fault_of(cls, data)
        if fault:
            return Answer("refused", "invalid", fault[:500])
        if cls.NEEDS_BEACON and beacon is None:
            reason = f"{name} needs a fresh beacon, and no telemetry was received"
            return Answer("refused", "no_beacon", reason)
        roles = _roles(cls, data)
        given = _ROLES.get(role or "")
        if given is not None and not roles & given.includes:
            least = role_of(cls) if len(roles) != 1 else next(iter(roles)).value
            reason = f"{name} takes the role {least}, and this aircraft's link is {role}"
            return Answer("refused", "forbidden", f"{reason} (mission_control.yml: role)")
        return Checked(Role.OBSERVER not in roles)


def _roles(cls: type[BaseCommand], data: dict[str, Any]) -> frozenset[Role]:
    return cls.from_data(data).roles()


KEPT = 512
"""No aircraft sends more frames than this while a beacon is fresh."""


class RecentBeacons:
    """Judges the beacon that a page echoes, before the aircraft does."""

    def __init__(self, clock: Clock, telemetry: Telemetry) -> None:
        self._clock = clock
        self._telemetry = telemetry
        self._frames = 0
        self._has_beacons = False
        self._recent: deque[tuple[float, int]] = deque(maxlen=KEPT)

    def poll(self) -> None:
        """Remember the newest frame's; called after each frame."""
        telemetry = self._telemetry
        if telemetry.frames == self._frames:
            return
        self._frames = telemetry.frames
        if telemetry.beacon is not None:
            self._has_beacons = True
            self._recent.append((self._clock.seconds(), telemetry.beacon))

    def fault(self, name: str, beacon: int | None) -> tuple[str, str] | None:
        """Return why a Command is not sent with this beacon: the code and a sentence.

        An aircraft whose telemetry has no beacons, as the thesis's, takes Commands without one.
        """
        if beacon is None:
            if self._frames and not self._has_beacons:
                return None
            reason = f"{name} needs the beacon of telemetry that was shown"
            return "no_beacon", reason
        newest = max((each for _, each in self._recent), default=beacon)
        if beacon > newest:
            return "unknown_beacon", "the aircraft has not sent the echoed beacon yet"
        limit_s = fresh_s(self._telemetry.number("system", "period_ms") or 0.0)
        oldest_s = self._clock.seconds() - limit_s
        if any(heard_s >= oldest_s for heard_s, each in self._recent if each == beacon):
            return None
        return "stale", f"the telemetry that this page shows is older than {limit_s:g} s"
