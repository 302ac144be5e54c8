"""MAVLink's mission protocol with one client: plans are taken and used only as a whole."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from up.commands.mission_commands import MAX_ITEMS, MISSION
from up.commands.refusal import Code
from up.mission.mavlink_items import FileItem
from up.mission.plan import Findings
from up.mission.plan_transfer import PlanOutcome
from up.mission.reliable_requests import Reply
from up.system.clock import Clock, Timer, cancel
from up_mavlink.aircraft import NO_CONTROL, Aircraft
from up_mavlink.command_table import item_command, position_of
from up_mavlink.plan_rows import TYPES, Rows, read_rows
from up_mavlink.status_texts import REFUSED, SEVERITIES

REQUEST_S, MAX_REQUESTS = 0.25, 40
"""A missing row is requested again after this time; the upload ends after this many requests."""
OK, ERROR, BAD_FRAME, NOT_SUPPORTED, NO_SPACE, INVALID = range(6)
INVALID_SEQUENCE, CANCELLED = 13, 15
MAX_ROWS = 2 * max(MAX_ITEMS.values())
ALL_TYPES, RALLY = 255, 2
GUIDED_TARGET = 2
MAX_DEGREES = 214.0
"""Of a coordinate on the wire, in 1e-7 degrees."""
_RESULTS = {
    "command_unknown": NOT_SUPPORTED,
    "command_unsupported": NOT_SUPPORTED,
    "frame": BAD_FRAME,
    "too_many": NO_SPACE,
}
DENIED = 14
_DENIED = (Code.FORBIDDEN.value, Code.UNPROTECTED.value, NO_CONTROL)
Say = Callable[[int, str], object]
Place = Callable[[Any], object]


@dataclass(slots=True)
class _Upload:
    """One that runs: the rows so far, and for how long the next one is awaited."""

    type: int
    count: int
    client: tuple[int, int]
    rows: list[FileItem] = field(default_factory=list)
    requests: int = 0


class MissionProtocol:
    """Answers the client; ``on_target`` gets an item that stands for "fly there now"."""

    def __init__(
        self, m: Any, clock: Clock, aircraft: Aircraft, send: Place, say: Say, on_target: Place
    ) -> None:
        self._m = m
        self._clock = clock
        self._aircraft = aircraft
        self._send = send
        self._say = say
        self._on_target = on_target
        self._upload: _Upload | None = None
        self._timer: Timer | None = None
        self._finished: tuple[int, int, int] | None = None
        self._offered: dict[int, Rows] = {}

    def stop(self) -> None:
        cancel(self._timer)
        self._upload = None

    def on_message(self, message: Any) -> bool:
        """Take a message; return whether it is one of this protocol."""
        handler = getattr(self, f"_on_{message.get_type().lower()}", None)
        if handler is None:
            return False
        client = (message.get_srcSystem(), message.get_srcComponent())
        if self._upload is None:
            cancel(self._timer)
        handler(message, client)
        return True

    # Upload.

    def _on_mission_count(self, message: Any, client: tuple[int, int]) -> None:
        cancel(self._timer)
        self._upload = self._finished = None
        if message.mission_type not in TYPES and message.count:
            self._ack(client, NOT_SUPPORTED, message.mission_type)
        elif message.count > MAX_ROWS:
            self._ack(client, NO_SPACE, message.mission_type)
        else:
            self._upload = _Upload(message.mission_type, message.count, client)
            self._next()

    def _on_mission_item(self, message: Any, client: tuple[int, int]) -> None:
        if message.command == 0 or message.current == GUIDED_TARGET:
            self._on_target(message)
            return
        upload, last = self._upload, (message.seq, message.mission_type)
        if upload is None:
            if self._finished is not None and self._finished[:2] == last:
                # The client has not received the acknowledgement.
                self._ack(client, self._finished[2], message.mission_type)
            return
        if client != upload.client or last != (len(upload.rows), upload.type):
            return
        upload.rows.append(_row_of(message))
        upload.requests = 0
        self._next()

    _on_mission_item_int = _on_mission_item

    def _next(self) -> None:
        cancel(self._timer)
        upload = self._upload
        if upload is None:
            return
        if len(upload.rows) >= upload.count:
            self._complete(upload)
            return
        if upload.requests >= MAX_REQUESTS:
            self._upload = None
            self._ack(upload.client, CANCELLED, upload.type)
            return
        upload.requests += 1
        system, component = upload.client
        number = len(upload.rows)
        self._send(
            self._m.MAVLink_mission_request_int_message(system, component, number, upload.type)
        )
        self._timer = self._clock.callLater(REQUEST_S, self._next)

    def _complete(self, upload: _Upload) -> None:
        if upload.type not in TYPES:
            self._end(upload, OK)
            return
        found = Findings()
        rows = read_rows(TYPES[upload.type], upload.rows, self._aircraft.persona, found)
        for note in found.notes[:3]:
            self._say(SEVERITIES["info"], str(note))
        if found.problems:
            first = found.problems[0]
            self._say(REFUSED, str(first))
            self._end(upload, _RESULTS.get(first.code, INVALID))
            return
        self._aircraft.upload(rows, lambda outcome: self._on_uploaded(upload, outcome))

    def _on_uploaded(self, upload: _Upload, outcome: PlanOutcome) -> None:
        if not outcome.code:
            self._end(upload, OK)
            return
        problem = outcome.problems[0] if outcome.problems else outcome.reason
        self._say(REFUSED, f"plan refused: {problem}")
        result = INVALID if outcome.problems else ERROR
        self._end(upload, DENIED if outcome.code in _DENIED else result)

    def _end(self, upload: _Upload, result: int) -> None:
        if self._upload is upload:
            self._upload = None
            self._finished = (upload.count - 1, upload.type, result)
            self._ack(upload.client, result, upload.type)
            # MAVSDK waits for it without asking again.
            arguments = (upload.client, result, upload.type)
            self._timer = self._clock.callLater(REQUEST_S, self._ack, *arguments)

    def _ack(self, client: tuple[int, int], result: int, type_: int) -> None:
        self._send(self._m.MAVLink_mission_ack_message(*client, result, type_))

    # Download.

    def _on_mission_request_list(self, message: Any, client: tuple[int, int]) -> None:
        type_ = message.mission_type
        if type_ not in TYPES:
            self._count(client, 0, type_)
            return

        def on_end(outcome: PlanOutcome, rows: Rows | None) -> None:
            if rows is None:
                self._say(REFUSED, f"the {TYPES[type_]} cannot be read: {outcome.reason}")
                self._ack(client, ERROR, type_)
                return
            self._offered[type_] = rows
            self._count(client, len(rows.rows), type_)

        self._aircraft.read(TYPES[type_], on_end)

    def _count(self, client: tuple[int, int], count: int, type_: int) -> None:
        self._send(self._m.MAVLink_mission_count_message(*client, count, type_))

    def _on_mission_request_int(self, message: Any, client: tuple[int, int]) -> None:
        offered = self._offered.get(message.mission_type)
        if offered is None or message.seq >= len(offered.rows):
            self._ack(client, INVALID_SEQUENCE, message.mission_type)
            return
        row = offered.rows[message.seq]
        params = [math.nan if each is None else float(each) for each in row.params]
        latitude, longitude, altitude = params[4:7]
        self._send(
            self._m.MAVLink_mission_item_int_message(
                *client, message.seq, row.frame, row.command, 0, 1, *params[:4],
                round(latitude * 1e7), round(longitude * 1e7), altitude, message.mission_type,
            )
        )  # fmt: skip

    _on_mission_request = _on_mission_request_int

    def _on_mission_ack(self, message: Any, client: tuple[int, int]) -> None:
        self._offered.pop(message.mission_type, None)
        if self._upload is not None and message.type == CANCELLED:
            self.stop()

    # The plans in use.

    def _on_mission_clear_all(self, message: Any, client: tuple[int, int]) -> None:
        type_ = message.mission_type
        types = [each for each in TYPES if type_ in (each, ALL_TYPES)]
        if not types:
            self._ack(client, OK if type_ == RALLY else NOT_SUPPORTED, type_)
            return
        outcomes: list[PlanOutcome] = []

        def ended(outcome: PlanOutcome) -> None:
            outcomes.append(outcome)
            if len(outcomes) == len(types):
                failed = [each for each in outcomes if each.code]
                if failed:
                    self._say(REFUSED, f"not removed: {failed[0].reason}")
                denied = any(each.code in _DENIED for each in failed)
                self._ack(client, DENIED if denied else ERROR if failed else OK, type_)

        for each in types:
            self._aircraft.upload(Rows(TYPES[each], (), (), ()), ended)

    def _on_mission_set_current(self, message: Any, client: tuple[int, int]) -> None:
        def on_reply(reply: Reply) -> None:
            if reply.code:
                self._say(REFUSED, reply.reason)

        self.set_current(message.seq, on_reply)

    def set_current(self, sequence: int, notify: Callable[[Reply], object]) -> None:
        """Select the item of a row; raises InvalidCommandError."""
        rows = self._aircraft.known_rows(MISSION)
        offset = 0 if self._aircraft.persona.has_home_item else 1
        item = sequence + offset if rows is None else rows.item_of(sequence)
        self._aircraft.ask([item_command(max(1, item))], notify)


def _row_of(message: Any) -> FileItem:
    params: list[float | None] = [
        value if math.isfinite(value := getattr(message, f"param{n}")) else None
        for n in range(1, 5)
    ]
    # Rows without a position may have anything there, which has to be sent back.
    latitude, longitude = (
        each if math.isfinite(each) and abs(each) < MAX_DEGREES else 0.0
        for each in position_of(message)
    )
    altitude = message.z if math.isfinite(message.z) else None
    frame, number = message.frame, message.seq
    return FileItem(
        number, message.command, frame, [*params, latitude, longitude, altitude], number
    )
