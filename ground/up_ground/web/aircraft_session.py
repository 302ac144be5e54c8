"""One aircraft of the server: its link, its messages, its pages."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial
from typing import TYPE_CHECKING, Any

from up.commands.event_rules import Report
from up.protocols.general_message import GeneralMessage
from up.protocols.handshake import ROLES
from up.protocols.pairing import Pairing
from up.system.clock import Timer
from up.system.disk_thread import DiskThread
from up.system.token_bucket import TokenBucket
from up_ground.catalogue import Catalogue
from up_ground.ground_link import GroundLink
from up_ground.key_store import KeyStore
from up_ground.link_status import LinkState
from up_ground.settings import Settings
from up_ground.status_text import security_text
from up_ground.telemetry import NAME, Telemetry
from up_ground.token_store import TokenStore
from up_ground.web.aircraft_source import AircraftSource
from up_ground.web.client_session import ClientSession, FrameMessage
from up_ground.web.command_gate import CommandGate
from up_ground.web.command_service import CommandService
from up_ground.web.control import Control
from up_ground.web.event_monitor import EventMonitor
from up_ground.web.event_rules import LinkSnapshot
from up_ground.web.fleet import row_of
from up_ground.web.messages import PageFault, Reader
from up_ground.web.plan_service import PlanService
from up_ground.web.proxy_lease import ProxyLease
from up_ground.web.track import Home, Track, track_message

if TYPE_CHECKING:
    from up_ground.web.client_hub import ClientHub

TICK_S = 0.25
"""Period of the checks for changes by time alone."""


class AircraftSession(AircraftSource):
    """Forwards telemetry without delay, and keeps the state that a page needs when it joins."""

    def __init__(
        self,
        reactor: Any,
        name: str,
        settings: Settings,
        tokens: TokenStore,
        catalogue: Catalogue,
        subscribers: ClientHub,
        keys: KeyStore,
    ) -> None:
        self.name = name
        self.link = GroundLink(reactor, settings, self, tokens)
        self.telemetry = Telemetry()
        self._reactor = reactor
        self._settings = settings
        self._subscribers = subscribers
        self._keys = keys
        lease = ProxyLease(self.link, settings.direct)
        self.control = Control(reactor, lease, self._report, self._send_status)
        gate = CommandGate(reactor, name, catalogue, self.link, lease, self.control, self.telemetry)
        self.plans = PlanService(
            reactor, name, self.link, self.control, self.telemetry, gate, self._report
        )
        self.commands = CommandService(
            reactor,
            name,
            self.link,
            self.control,
            self.telemetry,
            gate,
            lambda message: subscribers.notify(name, message),
            self._report,
        )
        self.monitor = EventMonitor(name, self._on_monitor)
        self._track = Track()
        self._home = Home()
        # Actions of pages are events, but at a limited rate.
        self._notes = TokenBucket(reactor, rate_hz=1.0, burst=20.0)
        self._tick: Timer | None = None
        self._has_board: bool | None = None
        self._was_open = False
        self._was_online: bool | None = None

    @property
    def summary(self) -> str:
        way = "directly" if self._settings.direct else "by way of the proxy"
        return f"{self.name} {way} at {self._settings.address}"

    def start(self) -> None:
        self.link.start()
        self._on_tick()

    async def stop(self) -> None:
        if self._tick is not None:
            self._tick.cancel()
        self.control.stop()
        self.commands.stop()
        self.plans.stop()
        await self.link.stop()

    def on_message(self, message: GeneralMessage) -> None:
        came_s = self._reactor.seconds()
        if self.telemetry.update(message, came_s):
            made_s = came_s - self.telemetry.way_s
            frame = FrameMessage(
                self.name,
                message.beacon,
                message.data,
                lambda now_s: now_s - made_s,
                self._reactor.seconds,
            )
            self.newest_frame = frame
            self._subscribers.send_latest(self.name, "frame", frame)
            self._process(came_s)
        elif message.name != NAME:
            self.commands.on_message(message)
            self.plans.on_message(message)

    def _process(self, now_s: float) -> None:
        """Evaluate a frame, after it has been sent to the pages."""
        telemetry = self.telemetry
        self._track.update(telemetry, now_s)
        self._home.update(telemetry)
        self.monitor.update(telemetry, self._snapshot(now_s), now_s)
        has_board = telemetry.flag("arduino", "connected")
        if has_board and self._has_board is False:
            self.commands.want_gains()
        self._has_board = has_board
        self.commands.on_moment()

    def on_link(self) -> None:
        status = self.link.status
        if self._was_open and not status.is_open:
            self.commands.on_lost()
            self.plans.on_lost()
        if status.is_aircraft_online and not self._was_online:
            self.commands.want_gains()
        self._was_open, self._was_online = status.is_open, status.is_aircraft_online
        now_s = self._reactor.seconds()
        if status.state is not LinkState.CONNECTING and (status.is_open or status.connections):
            self.monitor.on_link(self._snapshot(now_s), now_s)
        self.control.on_lease()
        self.commands.on_moment()
        self._send_status()

    def past(self) -> Iterable[dict[str, Any]]:
        yield track_message(self.name, self._track.points())
        yield from self.monitor.past(self._reactor.seconds())
        yield self.commands.gains_message()
        if self.commands.profile is not None:
            yield self.commands.profile_message()

    def on_second(self) -> None:
        self.link.measure()
        self.telemetry.on_round_trip(self.link.status.round_trip_ms)
        self.telemetry.on_clock(self.link.status.clock)

    def status(self, page: ClientSession) -> dict[str, Any]:
        now_s, status, telemetry = self._reactor.seconds(), self.link.status, self.telemetry
        age_s, rate_hz = telemetry.age_s(now_s), telemetry.rate_hz(now_s)
        role = status.key_role or telemetry.text("ground", "role")
        return {
            "type": "status",
            "aircraft": self.name,
            "link": {
                "state": status.state.value,
                "reason": status.reason,
                "code": status.code,
                "since_s": round(now_s - status.since_s, 3),
                "aircraft_online": status.is_aircraft_online,
                "tls_peer": status.tls_peer,
                "round_trip_ms": status.round_trip_ms,
                "connections": status.connections,
                "security": status.security,
                "security_text": security_text(status),
                "frames": telemetry.frames,
                "lost": telemetry.lost,
                "dropped": status.dropped,
                "rate_hz": None if rate_hz is None else round(rate_hz, 2),
                "frame_age_ms": None if age_s is None else round(age_s * 1000, 1),
            },
            "control": {
                **self.control.describe(page),
                "pages": [
                    {"page": each.number, "name": each.name} for each in self._subscribers.all()
                ],
            },
            "role": role if role in ROLES else None,
            "tune_in_flight": telemetry.flag("ground", "tune_in_flight"),
            "home": self._home.position(),
        }

    def row(self, now_s: float) -> dict[str, Any]:
        return row_of(self.name, self.telemetry, self.monitor.alarm_rows(), now_s)

    def on_control(self, page: ClientSession, action: str, to: int | None) -> None:
        if action == "give":
            taker = None if to is None else self._subscribers.get(to)
            if to is not None and taker is None:
                raise PageFault(f"unknown page {to}", "unknown_page")
            self.control.give(page, taker)
        else:
            {
                "request": self.control.request,
                "deny": self.control.deny,
                "release": self.control.release,
            }[action](page)

    def on_command(self, page: ClientSession, message: Reader) -> None:
        self.commands.on_command(page, message)

    def on_plan(self, page: ClientSession, kind: str, message: Reader) -> None:
        self.plans.on_plan(page, kind, message)

    async def pair(self, page: ClientSession, pairing: Pairing) -> None:
        if self.control.holder not in (None, page):
            # The link has no session until the aircraft has answered the new key.
            raise PageFault("another page has control of this aircraft", "no_control")
        await DiskThread(self._reactor).run(partial(self._keys.put, pairing))
        self.link.pair(pairing)

    def on_replay(self, page: ClientSession, action: str, message: Reader) -> None:
        raise PageFault("this is not a replay", "not_a_replay")

    def on_away(self, page: ClientSession) -> None:
        self.control.on_away(page)

    def on_gone(self, page: ClientSession) -> None:
        self.control.on_gone(page)

    def _on_monitor(self, message: dict[str, Any]) -> None:
        self._subscribers.notify(self.name, message)
        if message["type"] == "alarms":
            self._subscribers.on_alarms()

    def _on_tick(self) -> None:
        self._tick = self._reactor.callLater(TICK_S, self._on_tick)
        now_s = self._reactor.seconds()
        self.monitor.update(self.telemetry, self._snapshot(now_s), now_s)

    def _snapshot(self, now_s: float) -> LinkSnapshot:
        status = self.link.status
        return LinkSnapshot(
            status.is_open,
            status.reason,
            status.is_aircraft_online,
            self.telemetry.frames > 0,
            self.telemetry.is_silent(now_s),
            self.telemetry.is_late(now_s),
        )

    def _report(self, kind: str, report: Report) -> None:
        if self._notes.take():
            self.monitor.report(kind, report, self._reactor.seconds())

    def _send_status(self) -> None:
        self._subscribers.send_status(self.name)
