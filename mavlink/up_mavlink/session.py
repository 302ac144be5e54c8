"""One client of an endpoint: its messages in, telemetry and answers out."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

from up.commands.command import BaseCommand, InvalidCommandError
from up.commands.mission_commands import MISSION
from up.commands.refusal import Code
from up.mission.reliable_requests import Reply
from up.system.clock import Clock
from up.system.token_bucket import TokenBucket
from up_mavlink.aircraft import Aircraft
from up_mavlink.codec import COMPONENT, Codec
from up_mavlink.command_table import (
    ACCEPTED,
    DENIED,
    DO_REPOSITION,
    IN_PROGRESS,
    RESULTS,
    SET_CURRENT,
    UNSUPPORTED,
    CommandNotTranslatedError,
    Request,
    mode_commands,
    of_int,
    of_long,
    translate,
)
from up_mavlink.mission_protocol import MissionProtocol
from up_mavlink.modes import AVAILABLE, CURRENT, MONITOR, NUMBERS, current_mode
from up_mavlink.parameter_protocol import ParameterProtocol
from up_mavlink.status_texts import REFUSED, SEVERITIES, StatusTexts, messages_of
from up_mavlink.streams import MISSION_CURRENT, Streams
from up_mavlink.telemetry_messages import (
    BUILDERS,
    COMPLETE,
    MISSION_ACTIVE,
    heartbeat,
    mission_state,
)

GROUND_TYPE = 6
GROUND_S = 5.0
"""A ground station counts as connected for this long after its heartbeat."""
SILENT_S = 3.0
"""Without telemetry for this long the aircraft sends no heartbeat."""
MESSAGES_HZ, MESSAGES_BURST = 200.0, 400.0
REPEAT_S = 1.0
"""A refusal is reported once in this time."""
GET_INTERVAL, SET_INTERVAL, REQUEST_MESSAGE = 510, 511, 512
PREARM_CHECKS, GET_HOME, CAPABILITIES = 401, 410, 520
_FTP_NAK, _FTP_OPEN, _FTP_NOT_FOUND, _FTP_UNKNOWN = 129, 4, 10, 7
_FTP_HEADER = 12


@dataclass(slots=True)
class _Acknowledgement:
    """The newest command with its result; None while it is carried out."""

    key: tuple[Any, ...]
    result: int | None
    at_s: float


class Session:
    """Translates for one client until it is stopped.

    ``send`` takes a packet. ``ground_id``: only this system id may command; None: any.
    """

    def __init__(
        self,
        m: Any,
        clock: Clock,
        aircraft: Aircraft,
        codec: Codec,
        send: Callable[[bytes], object],
        counters: Counter[str],
        ground_id: int | None = None,
    ) -> None:
        self.received_s = clock.seconds()
        self.ground_s = float("-inf")
        self._m = m
        self._clock = clock
        self._aircraft = aircraft
        self._codec = codec
        self._send_packet = send
        self._counters = counters
        self._ground_id = ground_id
        self._bucket = TokenBucket(clock, MESSAGES_HZ, MESSAGES_BURST)
        self._streams = Streams()
        self._status_texts = StatusTexts()
        self._texts_sent = 0
        self._said: tuple[str, float] = ("", 0.0)
        self._acknowledged: _Acknowledgement | None = None
        self._heartbeat_s = float("-inf")
        self._current = -1
        self._missions = MissionProtocol(m, clock, aircraft, self._send, self.say, self._on_target)
        self._parameters = ParameterProtocol(m, clock, aircraft, self._send, self.say)

    @property
    def has_ground(self) -> bool:
        return self._clock.seconds() - self.ground_s <= GROUND_S

    def stop(self) -> None:
        self._missions.stop()
        self._parameters.stop()

    def on_bytes(self, data: bytes) -> None:
        """Take bytes of the client: part of a stream, or a datagram."""
        self.on_messages(self._codec.parse(data))

    def on_messages(self, messages: list[Any]) -> None:
        for message in messages:
            self.received_s = self._clock.seconds()
            if not self._bucket.take():
                self._counters["too_many"] += 1
            elif self._is_for_us(message):
                try:
                    self._on_message(message)
                except InvalidCommandError as error:
                    self.say(REFUSED, str(error))

    def _is_for_us(self, message: Any) -> bool:
        source, here = message.get_srcSystem(), self._aircraft.system_id
        target = getattr(message, "target_system", 0)
        component = getattr(message, "target_component", 0)
        if target not in (0, here) or component not in (0, COMPONENT):
            self._counters["other_target"] += 1
            return False
        if source in (0, here) or self._ground_id not in (None, source):
            self._counters["foreign"] += 1
            return False
        return True

    # Out.

    def on_frame(self) -> None:
        """Send the due messages of the newest frame, events, and the progress of the mission."""
        frame, now_s = self._aircraft.frame, self._clock.seconds()
        self.on_moment()
        for name in self._streams.due(now_s):
            self._send_telemetry(name)
        for severity, text in self._status_texts.update(frame, now_s):
            self._send_text(severity, text)
        self._send_reached()

    def on_moment(self) -> None:
        """Send the heartbeat if it is due, once a second."""
        now_s = self._clock.seconds()
        period_s = (self._aircraft.frame.number("system", "period_ms") or 0.0) / 1000
        if now_s - self._aircraft.received_s > max(SILENT_S, 2 * period_s):
            return
        if now_s - self._heartbeat_s >= 0.95:
            self._heartbeat_s = now_s
            self._send(heartbeat(self._m, self._aircraft.frame, self._aircraft.persona))

    def say(self, severity: int, text: str) -> None:
        """Send a text; one that is repeated is sent once."""
        now_s = self._clock.seconds()
        if (text, True) != (self._said[0], now_s - self._said[1] < REPEAT_S):
            self._said = (text, now_s)
            self._send_text(severity, text)

    def _send_text(self, severity: int, text: str) -> None:
        self._texts_sent += 1
        for message in messages_of(self._m, severity, text, self._texts_sent):
            self._send(message)

    def _send(self, message: Any) -> None:
        self._counters["sent"] += 1
        self._send_packet(self._codec.pack(message))

    def _send_telemetry(self, name: str) -> bool:
        """Send a message by its name; False: unknown, or without content."""
        aircraft = self._aircraft
        if name == "HEARTBEAT":
            message = heartbeat(self._m, aircraft.frame, aircraft.persona)
        elif name == MISSION_CURRENT:
            message = self._mission_current()
        elif name == CURRENT:
            message = current_mode(self._m, aircraft.frame, aircraft.persona)
        elif name == MONITOR:
            message = aircraft.modes.monitor(self._m)
        elif name in BUILDERS:
            message = BUILDERS[name][0](self._m, aircraft.frame)
        else:
            return False
        if message is not None:
            self._send(message)
        return message is not None

    def _send_modes(self, request: Request) -> bool:
        """Send the flight mode of the index in parameter 2, or all; False: no such mode."""
        messages = self._aircraft.modes.messages(self._m, int(request.number(2)))
        for message in messages:
            self._send(message)
        return bool(messages)

    def _mission_current(self) -> Any:
        frame = self._aircraft.frame
        rows = self._aircraft.known_rows(MISSION)
        count = int(frame.number("mission", "count") or 0)
        total = len(rows.rows) if rows is not None else count
        return self._m.MAVLink_mission_current_message(
            self._sequence(), total, mission_state(frame)
        )

    def _sequence(self) -> int:
        """Return the row of the item that is flown."""
        item = int(self._aircraft.frame.number("mission", "item") or 0)
        rows = self._aircraft.known_rows(MISSION)
        if rows is not None and 0 < item <= len(rows.numbers):
            return rows.numbers[item - 1]
        return item if self._aircraft.persona.has_home_item else max(0, item - 1)

    def _send_reached(self) -> None:
        """Report the row before, when the next one becomes current in MISSION, or at the end."""
        frame, now = self._aircraft.frame, self._sequence()
        state = mission_state(frame)
        if state == COMPLETE:
            now += 1
        if state in (MISSION_ACTIVE, COMPLETE) and now > self._current >= 0:
            self._send(self._m.MAVLink_mission_item_reached_message(self._current))
        self._current = now

    # In.

    def _on_message(self, message: Any) -> None:
        if self._missions.on_message(message) or self._parameters.on_message(message):
            return
        handler = getattr(self, f"_on_{message.get_type().lower()}", None)
        if handler is None:
            self._counters["ignored"] += 1
        else:
            handler(message)

    def _on_heartbeat(self, message: Any) -> None:
        if message.type == GROUND_TYPE:
            self.ground_s = self._clock.seconds()

    def _on_command_long(self, message: Any) -> None:
        self._on_command(message, of_long(message))

    def _on_command_int(self, message: Any) -> None:
        self._on_command(message, of_int(message))

    def _on_command(self, message: Any, request: Request) -> None:
        client = (message.get_srcSystem(), message.get_srcComponent())
        now_s = self._clock.seconds()
        key = (client, request.command, tuple(request.params), request.frame)
        last = self._acknowledged
        is_repeated = getattr(message, "confirmation", 0) or (last and last.result is None)
        if last and last.key == key and is_repeated and now_s - last.at_s < 3 * REPEAT_S:
            result = IN_PROGRESS if last.result is None else last.result
            self._acknowledge(client, request.command, result)
            return
        present = self._acknowledged = _Acknowledgement(key, None, now_s)

        def end(result: int, reason: str = "") -> None:
            present.result = result
            self._acknowledge(client, request.command, result)
            if reason:
                self.say(REFUSED, reason)

        try:
            self._carry_out(request, end)
        except InvalidCommandError as error:
            end(DENIED, str(error))
        except CommandNotTranslatedError as error:
            end(error.result, error.reason if error.result != UNSUPPORTED else "")

    def _acknowledge(self, client: tuple[int, int], command: int, result: int) -> None:
        system, component = client
        message = self._m.MAVLink_command_ack_message(command, result, 0, 0, system, component)
        self._send(message)

    def _carry_out(self, request: Request, end: Callable[..., None]) -> None:
        on_reply = partial(_end, end)
        if request.command in (GET_INTERVAL, SET_INTERVAL):
            self._on_interval(request, end)
        elif request.command in _REQUESTS:
            name = _REQUESTS[request.command] or self._name_of(request.number(1))
            is_list = name == AVAILABLE
            is_sent = self._send_modes(request) if is_list else self._send_telemetry(name)
            end(ACCEPTED if is_sent else UNSUPPORTED)
        elif request.command == PREARM_CHECKS:
            end(ACCEPTED)
            vetoes = self._aircraft.frame.texts("vetoes") or []
            for text in vetoes or ["no veto against arming"]:
                self._send_text(SEVERITIES["info"], text)
        elif request.command == SET_CURRENT:
            self._missions.set_current(int(request.number(1)), on_reply)
        else:
            persona, frame = self._aircraft.persona, self._aircraft.frame
            self._aircraft.ask(translate(request, persona, frame), on_reply)

    def _name_of(self, number: float) -> str:
        message = self._m.mavlink_map.get(int(number))
        return NUMBERS.get(int(number), "") if message is None else str(message.msgname)

    def _on_interval(self, request: Request, end: Callable[..., None]) -> None:
        number = int(request.number(1))
        name = self._name_of(number)
        if request.command == SET_INTERVAL:
            is_known = name == "HEARTBEAT" or self._streams.set_interval(name, request.number(2))
            end(ACCEPTED if is_known else UNSUPPORTED)
            return
        interval_us = 1_000_000 if name == "HEARTBEAT" else self._streams.interval_us(name)
        end(ACCEPTED)
        self._send(self._m.MAVLink_message_interval_message(number, interval_us))

    def _on_request_data_stream(self, message: Any) -> None:
        rate_hz = message.req_message_rate if message.start_stop else 0
        self._streams.set_rate(message.req_stream_id, rate_hz)

    def _on_set_mode(self, message: Any) -> None:
        self._try(
            lambda: mode_commands(message.custom_mode, self._aircraft.persona, self._aircraft.frame)
        )

    def _on_target(self, message: Any) -> None:
        request = Request(DO_REPOSITION, of_int(message).params, message.frame)
        client = (message.get_srcSystem(), message.get_srcComponent())

        def acknowledge(is_done: bool) -> None:
            self._send(self._m.MAVLink_mission_ack_message(*client, 0 if is_done else 1, 0))

        persona, frame = self._aircraft.persona, self._aircraft.frame
        self._try(lambda: translate(request, persona, frame), acknowledge)

    def _try(
        self,
        make: Callable[[], list[BaseCommand]],
        on_end: Callable[[bool], object] = bool,
    ) -> None:
        def on_reply(reply: Reply) -> None:
            on_end(not reply.code)
            if reply.code:
                self.say(REFUSED, reply.reason)

        try:
            self._aircraft.ask(make(), on_reply)
        except (InvalidCommandError, CommandNotTranslatedError) as error:
            on_reply(Reply(Code.INVALID.value, str(error)))

    def _on_timesync(self, message: Any) -> None:
        if message.tc1 == 0:
            self._send(self._m.MAVLink_timesync_message(time.monotonic_ns(), message.ts1))

    def _on_ping(self, message: Any) -> None:
        if message.target_system == 0:
            client = (message.get_srcSystem(), message.get_srcComponent())
            reply = self._m.MAVLink_ping_message(message.time_usec, message.seq, *client)
            self._send(reply)

    def _on_file_transfer_protocol(self, message: Any) -> None:
        """Refuse: the client then requests parameters by their messages."""
        request = bytes(message.payload)
        number, session, opcode = int.from_bytes(request[:2], "little"), request[2], request[3]
        error = _FTP_NOT_FOUND if opcode == _FTP_OPEN else _FTP_UNKNOWN
        head = [*((number + 1) & 0xFFFF).to_bytes(2, "little"), session, _FTP_NAK, 1, opcode]
        payload = head + [0] * (_FTP_HEADER - len(head)) + [error]
        payload += [0] * (251 - len(payload))
        client = (message.get_srcSystem(), message.get_srcComponent())
        self._send(self._m.MAVLink_file_transfer_protocol_message(0, *client, payload))


_REQUESTS = {
    REQUEST_MESSAGE: "",
    GET_HOME: "HOME_POSITION",
    CAPABILITIES: "AUTOPILOT_VERSION",
}
"""Commands that request one message; an empty name: the message of parameter 1."""


def _end(end: Callable[..., None], reply: Reply) -> None:
    end(RESULTS.get(reply.code, DENIED), reply.reason if reply.code else "")
