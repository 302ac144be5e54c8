"""The aircraft as the MAVLink clients of one endpoint see it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol

from up.commands.command import BaseCommand
from up.commands.parameter_commands import ParameterRequestCommand, ParameterValuesCommand
from up.commands.pid_tunings_commands import PIDTuningsCommand, PIDTuningsValuesCommand
from up.commands.refusal import Code
from up.mission.plan_transfer import PlanOutcome, PlanTransfer
from up.mission.reliable_requests import Notify, ReliableRequests, Reply
from up.protocols.general_message import GeneralMessage
from up.system.clock import Clock
from up.telemetry_frame import Frame
from up_mavlink.modes import ModeList
from up_mavlink.parameters import Parameters
from up_mavlink.personas import Persona
from up_mavlink.plan_rows import Rows, write_rows

USED_S = 2.0
"""After an upload telemetry may name the plan before it for this long."""
BUSY = Reply(Code.OVERLOADED.value, "another transfer of this plan is running")
NO_CONTROL = "no_control"


class Port(Protocol):
    """The link on which the Commands of an endpoint leave."""

    @property
    def problem(self) -> str:
        """Return why no Command can be sent now; empty if it can."""

    def send(self, message: GeneralMessage) -> None:
        """Send a Command; its answer arrives later."""


class Aircraft:
    """The newest telemetry, the parameters and the plans; Commands with their replies.

    The host passes every message of the aircraft to ``on_message`` and each frame to ``on_frame``.
    A Command echoes the beacon of the newest frame, and is never repeated.
    """

    def __init__(self, clock: Clock, port: Port, persona: Persona, system_id: int) -> None:
        self.frame = Frame()
        self.received_s = float("-inf")
        self.persona = persona
        self.system_id = system_id
        self.parameters = Parameters(system_id)
        self.modes = ModeList(persona)
        self._clock = clock
        self._port = port
        self._requests = ReliableRequests(clock, self._send_command, tries=1)
        self._transfers: dict[str, PlanTransfer] = {}
        self._rows: dict[str, tuple[Rows, float]] = {}

    @property
    def problem(self) -> str:
        return self._port.problem

    def on_frame(self, content: Mapping[str, Any], beacon: int | None) -> None:
        self.frame = Frame(content, beacon)
        self.received_s = self._clock.seconds()
        self.modes.update(self.frame)

    def on_message(self, message: GeneralMessage) -> None:
        """Take any message of the aircraft that is not telemetry."""
        if message.name == PIDTuningsValuesCommand.NAME:
            self.parameters.on_gains(message.data)
        elif message.name == ParameterValuesCommand.NAME:
            self.parameters.on_values(message.data)
        self._requests.on_message(message)
        for transfer in list(self._transfers.values()):
            transfer.on_message(message)

    def stop(self) -> None:
        self._requests.stop()
        for transfer in self._transfers.values():
            transfer.stop()
        self._transfers.clear()

    def ask(self, commands: Sequence[BaseCommand], notify: Notify) -> None:
        """Send Commands one after the other; the reply is that of the first refused one."""
        if not commands:
            notify(Reply())
            return
        if problem := self.problem:
            notify(Reply(NO_CONTROL, problem))
            return
        first, *rest = commands

        def on_reply(reply: Reply) -> None:
            if reply.code or not rest:
                notify(reply)
            else:
                self.ask(rest, notify)

        self._requests.ask(first, on_reply)

    def read_parameters(self, on_end: Callable[[], object]) -> None:
        """Ask for gains and keys; an aircraft without any has no such parameters."""
        keys = [ParameterRequestCommand()]
        self.ask([PIDTuningsCommand(request=True)], lambda _: self.ask(keys, lambda _: on_end()))

    def upload(self, rows: Rows, on_end: Callable[[PlanOutcome], object]) -> None:
        def ended(outcome: PlanOutcome) -> None:
            if not outcome.code:
                self._rows[rows.plan] = (rows, self._clock.seconds())
            on_end(outcome)

        self._transfer(rows.plan, ended, rows.items)

    def read(self, plan: str, on_end: Callable[[PlanOutcome, Rows | None], object]) -> None:
        """Read the plan in use; ``on_end`` gets its rows, as they were sent if it was here."""
        known = self.known_rows(plan)
        if known is not None:
            on_end(PlanOutcome(), known)
            return

        def ended(outcome: PlanOutcome) -> None:
            rows = None
            if not outcome.code:
                rows = write_rows(plan, outcome.items, self.persona, self._home())
                self._rows[plan] = (rows, self._clock.seconds())
            on_end(outcome, rows)

        self._transfer(plan, ended)

    def known_rows(self, plan: str) -> Rows | None:
        rows, since_s = self._rows.get(plan, (None, 0.0))
        if rows is None:
            return None
        is_new = self._clock.seconds() - since_s < USED_S
        return rows if is_new or rows.plan_id == self.frame.text(plan, "id") else None

    def _transfer(
        self, plan: str, on_end: Callable[[PlanOutcome], object], items: Any = None
    ) -> None:
        if plan in self._transfers:
            on_end(PlanOutcome(BUSY.code, BUSY.reason))
            return
        if items is not None and (problem := self.problem):
            on_end(PlanOutcome(NO_CONTROL, problem))
            return

        def ended(outcome: PlanOutcome) -> None:
            self._transfers.pop(plan, None)
            on_end(outcome)

        transfer = PlanTransfer(self._clock, self._send_command, plan, _ignore, ended)
        self._transfers[plan] = transfer
        if items is None:
            transfer.download()
        else:
            transfer.upload(items)

    def _send_command(self, command: BaseCommand, id_: str) -> None:
        self._port.send(GeneralMessage(command.NAME, command.data, id_, self.frame.beacon))

    def _home(self) -> tuple[float, float, float] | None:
        numbers = [self.frame.number("home", name) for name in ("latitude", "longitude")]
        if None in numbers:
            return None
        latitude, longitude = (each or 0.0 for each in numbers)
        return latitude, longitude, self.frame.number("home", "altitude") or 0.0


def _ignore(phase: str, done: int, of: int) -> None: ...
