"""Whether a page's Command is sent, and why not."""

from __future__ import annotations

import re
from collections import deque
from typing import Any

from up.commands.beacon import fresh_s
from up.commands.command import BaseCommand
from up.commands.roles import Role
from up.system.clock import Clock
from up_ground.catalogue import Catalogue, fault_of, least_role, title_of
from up_ground.ground_link import GroundLink
from up_ground.link_status import ControlStatus
from up_ground.telemetry import Telemetry
from up_ground.web.answers import Answer
from up_ground.web.client_session import ClientSession
from up_ground.web.control import Control
from up_ground.web.proxy_lease import ProxyLease

UNANSWERED_LIMIT = 32
_NAME = re.compile(r"[A-Za-z0-9_.-]{1,128}", re.ASCII)
_ROLES = {role.value: role for role in (Role.OBSERVER, Role.OPERATOR, Role.PILOT, Role.ADMIN)}


class CommandGate:
    """The one place of the server that decides whether a Command to an aircraft is sent.

    It refuses what no aircraft of this version accepts, what the page may not send, what was made
    with old telemetry, and what cannot leave now. The aircraft decides again.
    """

    def __init__(
        self,
        clock: Clock,
        aircraft: str,
        catalogue: Catalogue,
        link: GroundLink,
        lease: ProxyLease,
        control: Control,
        telemetry: Telemetry,
    ) -> None:
        self.beacons = RecentBeacons(clock, telemetry)
        self._aircraft = aircraft
        self._catalogue = catalogue
        self._link = link
        self._lease = lease
        self._control = control
        self._telemetry = telemetry

    def title_of(self, name: str, data: dict[str, Any]) -> str:
        """Return what a person calls a Command."""
        return title_of(self._catalogue.get(name), name, data)

    def refusal(
        self,
        page: ClientSession,
        name: str,
        data: dict[str, Any],
        beacon: int | None,
        *,
        is_forced: bool,
        unanswered: int,
    ) -> Answer | None:
        """Return why a page's Command is not sent; None if it may be.

        A name unknown here, which an aircraft may know all the same, is only sent when
        ``is_forced``.
        """
        needs_control = True
        cls = self._catalogue.get(name)
        if cls is not None:
            refused = self._invalid(cls, name, data, beacon)
            if refused is not None:
                return refused
            needs_control = Role.OBSERVER not in cls.from_data(data).roles()
        elif not is_forced or not _NAME.fullmatch(name):
            near = self._catalogue.suggestions(name)
            more = f"; did you mean {' or '.join(near)}?" if near else ""
            return Answer("refused", "unknown", f"no Command is called {name[:60]}{more}")
        if needs_control and page is not self._control.holder:
            reason = "this page has no control: request it first"
            if not page.may_control:
                reason = f"this page may only watch: {page.denial}"
            return Answer("refused", "no_control", reason)
        if unanswered >= UNANSWERED_LIMIT:
            return Answer("refused", "busy", "too many Commands wait for their answer")
        unsent = self.unsent()
        if unsent is None and needs_control:
            # The page may hang or show late data: a Command needs a page that sees fresh data.
            fault = self.beacons.fault(name, beacon)
            return None if fault is None else Answer("refused", *fault)
        return unsent

    def unsent(self) -> Answer | None:
        status = self._link.status
        if not status.is_open:
            return Answer("unsent", "no_link", status.reason or "no link to the proxy")
        if status.is_aircraft_online is False:
            reason = f"the aircraft {self._aircraft} is not connected to the proxy"
            return Answer("unsent", "no_aircraft", reason)
        if self._lease.status is not ControlStatus.OURS:
            reason = "this ground only listens: request control first"
            return Answer("unsent", "no_seat", reason)
        return None

    def _invalid(
        self, cls: type[BaseCommand], name: str, data: dict[str, Any], beacon: int | None
    ) -> Answer | None:
        """Return why no aircraft takes it; the role of its link is checked if it is known."""
        if cls not in self._catalogue.sendable():
            return Answer("refused", "forbidden", f"no ground may send {name}")
        if fault := fault_of(cls, data):
            return Answer("refused", "invalid", fault[:500])
        if cls.NEEDS_BEACON and beacon is None:
            reason = f"{name} needs a fresh beacon, and no telemetry was received"
            return Answer("refused", "no_beacon", reason)
        roles = cls.from_data(data).roles()
        role = self._link.status.key_role or self._telemetry.text("ground", "role")
        given = _ROLES.get(role or "")
        if given is not None and not roles & given.includes:
            where = "keys.yml" if self._link.status.key_role else "mission_control.yml: role"
            reason = (
                f"{name} takes the role {least_role(roles)}, and this aircraft's link is {role}"
            )
            return Answer("refused", "forbidden", f"{reason} ({where})")
        return None


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
