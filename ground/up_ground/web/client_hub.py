"""All open pages and their messages."""

from __future__ import annotations

import hmac
import secrets
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from twisted.internet.defer import Deferred

from up.errors import UserError
from up.protocols.link_output import Make
from up.protocols.pairing import Pairing, parse_pairing
from up.sanitize_text import sanitize_text
from up.system.clock import Clock, Timer, cancel
from up.system.token_bucket import TokenBucket
from up.version import VERSION
from up_ground.web.access import Access, Denial
from up_ground.web.aircraft_source import AircraftSource
from up_ground.web.client_session import (
    PAGES_LIMIT,
    WATCHERS_LIMIT,
    AdmissionError,
    ClientSession,
    admit_page,
    message_bytes,
)
from up_ground.web.fleet import FleetSummary
from up_ground.web.messages import (
    MAX_MESSAGE_BYTES,
    MAX_PLAN_BYTES,
    PageFault,
    Reader,
    read_message,
)
from up_ground.web.plan_service import read_file, write_file
from up_ground.web.sessions import Sessions

if TYPE_CHECKING:
    from up_ground.web.page_link import PageLink

GREETING_LIMIT = 16
"""Maximum number of links without a hello; beyond it the oldest is closed."""
HELLO_S = 5.0
KEPT_S = 5.0
"""A lost page is expected back within this time."""
ALIVE_S = 1.0
FAULTS_LIMIT = 20
MAX_PAIRING = 300
GOING_AWAY = 4001
VIOLATION = 4008
LATER = 4013


class _Connection:
    """One connection: whose it is, and how well it behaves."""

    def __init__(self, clock: Clock, timer: Timer) -> None:
        self.page: ClientSession | None = None
        self.timer = timer
        self.is_greeting = False
        self.faults = 0
        self.bucket = TokenBucket(clock, rate_hz=100.0, burst=300.0)


class ClientHub:
    """Knows the connected pages, sends each the data it watches and dispatches its messages."""

    def __init__(
        self,
        clock: Clock,
        access: Access,
        *,
        tiles: Mapping[str, Any] | None = None,
        catalogue: Mapping[str, Any] | None = None,
        is_replay: bool = False,
        has_docs: bool = False,
    ) -> None:
        self.fleet: dict[str, AircraftSource] = {}
        self._clock = clock
        self.access = access
        self.sessions = Sessions(clock, access)
        self._tiles = tiles
        self._catalogue = None if catalogue is None else message_bytes(catalogue)
        self._is_replay = is_replay
        self._has_docs = has_docs
        self._connections: dict[PageLink, _Connection] = {}
        self._pages: dict[int, ClientSession] = {}
        self._timers: dict[int, Timer] = {}
        self._number = 0
        self._beat: Timer | None = None
        self._summary = FleetSummary(clock, self.fleet, self._send_fleet)
        self._all_closed: Deferred[None] | None = None

    def start(self) -> None:
        self._beat = self._clock.callLater(1.0, self._on_second)

    async def stop(self) -> None:
        """Close every page's link; returns when they are closed, after a second at most."""
        cancel(self._beat, *self._timers.values())
        self._summary.stop()
        if self._connections:
            self._all_closed = Deferred()
            for link in list(self._connections):
                link.close(GOING_AWAY, "the server ends")
            await self._all_closed

    # Called by an aircraft.

    def all(self) -> list[ClientSession]:
        return [page for page in self._pages.values() if page.link is not None]

    def get(self, number: int) -> ClientSession | None:
        page = self._pages.get(number)
        return None if page is None or page.link is None else page

    def send_latest(self, aircraft: str, kind: str, make: Make) -> None:
        """Send the pages that watch the aircraft a message that the next of its kind replaces."""
        for page in self._pages.values():
            if page.watched == aircraft:
                page.send_latest(kind, make)

    def notify(self, aircraft: str, message: dict[str, Any]) -> None:
        encoded = b""
        for page in self._pages.values():
            if page.watched == aircraft:
                encoded = encoded or message_bytes(message)
                page.send_bytes(encoded)

    def send_status(self, aircraft: str) -> None:
        for page in self._pages.values():
            self._send_status(page, self.fleet[aircraft])

    def on_alarms(self) -> None:
        """Send all pages the new alarms of an aircraft, which few of them may watch."""
        self._summary.on_alarms()

    def sign_out(self, token: str) -> None:
        """End a session; its pages lose control, and connect again to watch."""
        self.sessions.end(token)
        for page in list(self._pages.values()):
            if token and page.session == token:
                self._evict(page, GOING_AWAY, "signed out")

    # Called by a page's link.

    def on_opened(self, link: PageLink) -> None:
        """Wait for the page's hello, which shows whether it has a reserved place."""
        greeting = [
            each for each, connection in self._connections.items() if connection.page is None
        ]
        if len(greeting) >= GREETING_LIMIT:
            silent = (each for each in greeting if not self._connections[each].is_greeting)
            self._reject(next(silent, greeting[0]), "too many pages send no hello")
        timer = self._clock.callLater(HELLO_S, link.close, VIOLATION, "no hello")
        self._connections[link] = _Connection(self._clock, timer)

    def on_message(self, link: PageLink, payload: bytes) -> None:
        """Handle a message of a page; bad ones get an error, and too many close the link."""
        connection = self._connections.get(link)
        if connection is None or self._all_closed is not None:
            return
        if not connection.bucket.take():
            link.close(VIOLATION, "too many messages")
            return
        try:
            kind, message = read_message(payload)
            self._dispatch(link, connection, kind, message)
        except PageFault as fault:
            connection.faults += 1
            text = sanitize_text(str(fault), 300)
            link.output.send(message_bytes({"type": "fault", "code": fault.code, "text": text}))
            if connection.faults >= FAULTS_LIMIT:
                link.close(VIOLATION, "too many faults")

    def on_closed(self, link: PageLink) -> None:
        connection = self._connections.pop(link, None)
        if connection is None:
            return
        cancel(connection.timer)
        if self._all_closed is not None:
            if not self._connections:
                self._all_closed.callback(None)
            return
        page = connection.page
        if page is not None and page.link is link:
            page.link = None
            self._timers[page.number] = self._clock.callLater(KEPT_S, self._drop, page)
            for aircraft in self.fleet.values():
                aircraft.on_away(page)

    def _dispatch(
        self, link: PageLink, connection: _Connection, kind: str, message: Reader
    ) -> None:
        page = connection.page
        if kind == "hello":
            if page is not None or connection.is_greeting:
                raise PageFault("hello was sent already", "hello_repeated")
            self._on_hello(link, connection, message)
        elif kind == "ping":
            ping = message.fields.get("ping")
            if isinstance(ping, str | dict | list):
                raise PageFault("ping is not a number")
            link.output.send(
                message_bytes({"type": "pong", "ping": ping, "sent_ms": self._now_ms()})
            )
        elif page is None:
            raise PageFault("the first message must be hello", "hello_missing")
        elif kind == "watch":
            self._on_watch(page, self._aircraft(message))
        elif kind == "control":
            action = message.choice("action", "request", "give", "deny", "release")
            self._aircraft(message).on_control(page, action, message.optional_whole("to"))
        elif kind == "command":
            self._aircraft(message).on_command(page, message)
        elif kind == "pair":
            ask = message.whole("ask")
            Deferred.fromCoroutine(self._pair(link, page, ask, message))
        elif kind in ("plan.upload", "plan.download"):
            self._aircraft(message).on_plan(page, kind, message)
        elif kind in ("plan.read", "plan.write"):
            page.send(read_file(message) if kind == "plan.read" else write_file(message))
        elif kind == "replay":
            action = message.choice("action", "play", "pause", "seek", "speed")
            for aircraft in self.fleet.values():
                aircraft.on_replay(page, action, message)
        else:
            raise PageFault(f"unknown message type {kind}", "unknown_type")

    def _aircraft(self, message: Reader) -> AircraftSource:
        found = self.fleet.get(message.text("aircraft", 64))
        if found is None:
            raise PageFault("unknown aircraft", "unknown_aircraft")
        return found

    def _on_hello(self, link: PageLink, connection: _Connection, message: Reader) -> None:
        name = " ".join(sanitize_text(message.optional_text("name") or "", 40).split())
        token = message.optional_text("token", 64) or ""
        connection.timer.cancel()
        connection.is_greeting = True
        former = self._with_token(token)
        if not self.sessions.use(link.session):
            link.session = ""
        denial = self.access.denial(bool(link.session))
        if former is not None and former.may_control and denial is not None:
            # The token names a page; the right to control is that of the session.
            former = None
        if former is None:
            self._welcome_new(link, name, denial)
        elif former.link is None:
            self._welcome_back(link, former, name, denial)
        else:
            # A duplicated tab has its original's token; so has a page whose old link hangs.
            old = former.link

            def decide(is_alive: bool) -> None:
                if link not in self._connections:
                    return
                if is_alive or former.number not in self._pages:
                    self._welcome_new(link, name, denial)
                    return
                if former.link is old:
                    self._connections.pop(old, None)
                    former.link = None
                    old.close(GOING_AWAY, "this page has another link")
                self._welcome_back(link, former, name, denial)

            old.is_alive(ALIVE_S, decide)

    def _with_token(self, token: str) -> ClientSession | None:
        given = token.encode("utf-8", "replace")
        found = None
        for page in self._pages.values():
            if hmac.compare_digest(given, page.token.encode()):
                found = page
        return found

    def _welcome_new(self, link: PageLink, name: str, denial: Denial | None) -> None:
        limit = PAGES_LIMIT if self.access.is_watch_only else WATCHERS_LIMIT
        try:
            leaving = admit_page(self._pages.values(), denial is None, limit)
        except AdmissionError as error:
            self._reject(link, str(error))
            return
        if leaving is not None:
            self._evict(leaving, LATER, "a page that may control needs the place")
        self._number += 1
        number = self._number
        page = ClientSession(number, name or f"page {number}", secrets.token_hex(16), denial)
        self._pages[number] = page
        self._welcome(link, page)

    def _evict(self, page: ClientSession, code: int, reason: str) -> None:
        link, page.link = page.link, None
        cancel(self._timers.get(page.number))
        if link is not None:
            self._reject(link, reason, code)
            for aircraft in self.fleet.values():
                aircraft.on_away(page)
        self._drop(page)

    def _reject(self, link: PageLink, reason: str, code: int = LATER) -> None:
        connection = self._connections.pop(link)
        cancel(connection.timer)
        link.close(code, reason)

    def _welcome_back(
        self, link: PageLink, page: ClientSession, name: str, denial: Denial | None
    ) -> None:
        cancel(self._timers.pop(page.number, None))
        page.name = name or page.name
        page.denial = denial
        page.watched = ""
        self._welcome(link, page)

    def _welcome(self, link: PageLink, page: ClientSession) -> None:
        max_bytes = MAX_PLAN_BYTES if page.may_control else MAX_MESSAGE_BYTES
        link.admit(max_bytes)
        page.link = link
        page.session = link.session
        # A reloaded page restarts its numbers at one; its old numbers are void.
        page.asks = {}
        self._connections[link].page = page
        denial = Denial("replay", "this is a replay") if self._is_replay else page.denial
        page.send(
            {
                "type": "welcome",
                "page": page.number,
                "name": page.name,
                "token": page.token,
                "version": VERSION,
                "aircraft": list(self.fleet),
                "may_control": denial is None,
                "signed_in": bool(page.session),
                "denial": None if denial is None else {"code": denial.code, "text": denial.text},
                "tiles": self._tiles,
                "is_replay": self._is_replay,
                "has_docs": self._has_docs,
                "sent_ms": self._now_ms(),
                "max_message": max_bytes,
            }
        )
        if self._catalogue is not None:
            page.send_bytes(self._catalogue)
        for aircraft in self.fleet.values():
            self.send_status(aircraft.name)

    async def _pair(self, link: PageLink, page: ClientSession, ask: int, message: Reader) -> None:
        """Give this ground station the key in a pairing text, and answer the page."""
        answer: dict[str, Any] = {"type": "pair.answer", "ask": ask, "outcome": "ack"}
        try:
            pairing = self._pairing(link, page, message)
            await self.fleet[pairing.aircraft].pair(page, pairing)
            answer |= {"aircraft": pairing.aircraft, "key": pairing.name, "role": pairing.role}
        except (PageFault, UserError, OSError) as error:
            code = getattr(error, "code", "os_error")
            reason = sanitize_text(str(error), 300)
            answer |= {"outcome": "refused", "code": code, "reason": reason}
        page.send(answer)

    def _pairing(self, link: PageLink, page: ClientSession, message: Reader) -> Pairing:
        if not page.may_control:
            raise PageFault(f"this page may only watch: {page.denial}", "watch_only")
        if not link.may_send_secrets:
            text = "others may read this connection: pair by HTTPS, or on the server's own machine"
            raise PageFault(text, "not_private")
        pairing = parse_pairing(message.text("pairing", MAX_PAIRING))
        if pairing is None:
            raise PageFault("this is not a pairing text of 'up keys add'", "pairing_invalid")
        if pairing.aircraft not in self.fleet:
            text = f"the key is for {pairing.aircraft}, which this server does not show"
            raise PageFault(text, "unknown_aircraft")
        return pairing

    def _on_watch(self, page: ClientSession, aircraft: AircraftSource) -> None:
        page.watched = aircraft.name
        if page.link is not None:
            page.link.output.discard("frame")
        for message in aircraft.past():
            page.send(message)
        if aircraft.newest_frame is not None:
            page.send_latest("frame", aircraft.newest_frame)
        self._send_status(page, aircraft)

    def _send_status(self, page: ClientSession, aircraft: AircraftSource) -> None:
        page.send_latest(f"status {aircraft.name}", lambda: message_bytes(aircraft.status(page)))

    def _now_ms(self) -> float:
        """Return the clock by which pages report the transit time from here."""
        return round(self._clock.seconds() * 1000, 1)

    def _drop(self, page: ClientSession) -> None:
        self._timers.pop(page.number, None)
        self._pages.pop(page.number, None)
        for aircraft in self.fleet.values():
            aircraft.on_gone(page)

    def _on_second(self) -> None:
        self._beat = self._clock.callLater(1.0, self._on_second)
        for page in self.all():
            self.sessions.use(page.session)
        for aircraft in self.fleet.values():
            aircraft.on_second()
        for page in self.all():
            if page.watched:
                self._send_status(page, self.fleet[page.watched])
        self._summary.send()

    def _send_fleet(self, message: Make) -> None:
        for page in self._pages.values():
            page.send_latest("fleet", message)
