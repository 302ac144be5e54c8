"""MAVLink's parameter protocol with one client."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator
from typing import Any

from up.commands.command import InvalidCommandError
from up.commands.parameter_commands import ParameterSetCommand
from up.commands.pid_tunings_commands import PIDTuningsCommand
from up.commands.refusal import Code
from up.mission.reliable_requests import Reply
from up.system.clock import Clock, Timer, cancel
from up_mavlink.aircraft import Aircraft
from up_mavlink.parameters import (
    DOES_NOT_EXIST,
    NOT_PERMITTED,
    OUT_OF_RANGE,
    REAL32,
    ParameterRefusedError,
)
from up_mavlink.status_texts import REFUSED, SEVERITIES

LIST_S = 0.005
"""Between two values of a list: a slow radio must not get them all together."""
CONTROL_S = 3.0
"""A list waits this long for control: programs ask for it before the bridge has it."""
RETRY_S = 0.2
NO_INDEX = -1
MAX_WAITING = 50


class ParameterProtocol:
    """Lists, reads and sets the parameters, one set after the other."""

    def __init__(
        self,
        m: Any,
        clock: Clock,
        aircraft: Aircraft,
        send: Callable[[Any], object],
        say: Callable[[int, str], object],
    ) -> None:
        self._m = m
        self._clock = clock
        self._aircraft = aircraft
        self._send = send
        self._say = say
        self._timer: Timer | None = None
        self._sets: deque[Any] = deque()
        self._is_setting = False

    def stop(self) -> None:
        cancel(self._timer)
        self._sets.clear()

    def on_message(self, message: Any) -> bool:
        """Take a message; return whether it is one of this protocol."""
        handler = getattr(self, f"_on_{message.get_type().lower()}", None)
        if handler is not None:
            handler(message)
        return handler is not None

    def _on_param_request_list(self, message: Any) -> None:
        cancel(self._timer)
        self._list_with_parameters(self._clock.seconds() + CONTROL_S)

    def _on_param_request_read(self, message: Any) -> None:
        self._with_parameters(lambda: self._read(message))

    def _on_param_set(self, message: Any) -> None:
        if len(self._sets) < MAX_WAITING:
            self._sets.append(message)
            if not self._is_setting:
                self._is_setting = True
                self._with_parameters(self._set_next)

    def _with_parameters(self, then: Callable[[], object], *, is_new: bool = False) -> None:
        if self._aircraft.parameters.is_known and not is_new:
            then()
        else:
            self._aircraft.read_parameters(then)

    def _list_with_parameters(self, end_s: float) -> None:
        if self._aircraft.problem and self._clock.seconds() < end_s:
            self._timer = self._clock.callLater(RETRY_S, self._list_with_parameters, end_s)
        else:
            self._with_parameters(lambda: self._list(iter(self._values())), is_new=True)

    def _values(self) -> dict[str, float]:
        return self._aircraft.parameters.values(self._aircraft.frame)

    def _list(self, names: Iterator[str]) -> None:
        name = next(names, None)
        if name is not None:
            self._send_value(name)
            self._timer = self._clock.callLater(LIST_S, self._list, names)

    def _read(self, message: Any) -> None:
        names = list(self._values())
        if message.param_index >= 0:
            name = names[message.param_index] if message.param_index < len(names) else ""
        else:
            name = _name_of(message)
        if name in names:
            self._send_value(name)
        else:
            self._refuse(message, name, DOES_NOT_EXIST)

    def _send_value(self, name: str, new: float | None = None) -> None:
        """Send a parameter; ``new`` was just set, and telemetry may not have it yet."""
        values = self._values()
        if name not in values:
            return
        value, place = values[name] if new is None else new, list(values).index(name)
        self._send(
            self._m.MAVLink_param_value_message(name.encode(), value, REAL32, len(values), place)
        )

    def _refuse(self, message: Any, name: str, error: int) -> None:
        client = (message.get_srcSystem(), message.get_srcComponent())
        index = getattr(message, "param_index", NO_INDEX)
        self._send(self._m.MAVLink_param_error_message(*client, name.encode(), index, error))

    def _set_next(self) -> None:
        if not self._sets:
            self._is_setting = False
            return
        message = self._sets.popleft()
        name, parameters = _name_of(message), self._aircraft.parameters

        def on_reply(reply: Reply, error: int = 0) -> None:
            if reply.code:
                is_invalid = reply.code == Code.INVALID.value
                self._say(REFUSED, f"{name}: {reply.reason}")
                self._refuse(
                    message, name, error or (OUT_OF_RANGE if is_invalid else NOT_PERMITTED)
                )
            elif isinstance(command, PIDTuningsCommand):
                parameters.on_gains(command.pids or {})
            elif isinstance(command, ParameterSetCommand):
                parameters.on_set(name, message.param_value)
                key = f"{name} ({command.file}: {command.key})"
                self._say(SEVERITIES["warning"], f"{key} acts at the next start of the program")
            if name in self._values():
                self._send_value(name, None if reply.code else message.param_value)
            self._set_next()

        command = None
        try:
            value, frame = message.param_value, self._aircraft.frame
            command = parameters.set(name, value, message.param_type, frame)
        except (ParameterRefusedError, InvalidCommandError) as error:
            on_reply(Reply("invalid", str(error)), getattr(error, "code", OUT_OF_RANGE))
            return
        self._aircraft.ask([] if command is None else [command], on_reply)


def _name_of(message: Any) -> str:
    name = message.param_id
    text = name.decode("ascii", "replace") if isinstance(name, bytes) else str(name)
    return text.partition("\0")[0]
