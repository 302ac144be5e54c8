"""Missions and fences of the pages: files, upload and download (docs/mission.md)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from up.commands.command import BaseCommand
from up.commands.event_rules import Report
from up.commands.mission_commands import (
    FENCE,
    MISSION,
    PLANS,
    MissionCommitCommand,
    MissionRequestCommand,
)
from up.mission.items import Border, MissionItem, PlanItem, plan_id
from up.mission.plan import FORMS, Plan, PlanError, PlanProblem, checked_items, position
from up.mission.plan_forms import read_plan, write_plan
from up.mission.plan_transfer import NO_CONTENT, PlanOutcome, PlanTransfer
from up.mission.reliable_requests import NO_ANSWER
from up.protocols.general_message import GeneralMessage, encode
from up.system.clock import Clock
from up_ground.ground_link import GroundLink
from up_ground.telemetry import Telemetry
from up_ground.web.answers import Answer, outcome_event
from up_ground.web.client_session import ClientSession
from up_ground.web.command_gate import CommandGate
from up_ground.web.control import Control
from up_ground.web.messages import MAX_PLAN_BYTES, PageFault, Reader

LISTED = 100
"""Problems and notes of one answer."""
LINK_LOST = "link_lost"
_UNKNOWN = frozenset({NO_ANSWER, NO_CONTENT, LINK_LOST})


def answer_message(
    ask: int, answer: Answer, problems: Sequence[PlanProblem] = (), untold: int = 0, **result: Any
) -> dict[str, Any]:
    """Return the message ``plan.answer``."""
    return {
        "type": "plan.answer",
        "ask": ask,
        "outcome": answer.outcome,
        "code": answer.code,
        "reason": answer.reason,
        "detail": answer.detail,
        "problems": _listed(problems),
        "untold": untold + max(0, len(problems) - LISTED),
        **result,
    }


def read_file(message: Reader) -> dict[str, Any]:
    """Answer ``plan.read``."""
    ask = message.whole("ask")
    try:
        plan = read_plan(message.text("text", MAX_PLAN_BYTES), message.text("name"))
    except PlanError as error:
        return _invalid(ask, error)
    return answer_message(
        ask,
        Answer("ack"),
        form=plan.form,
        items=[each.data for each in plan.items],
        borders=[each.data for each in plan.borders],
        home=plan.home,
        cruise_speed=plan.cruise_m_s,
        notes=_listed(plan.notes),
    )


def write_file(message: Reader) -> dict[str, Any]:
    """Answer ``plan.write``."""
    ask, form = message.whole("ask"), message.choice("form", *FORMS)
    given = message.fields.get("home")
    home = position(given)
    if given is not None and home is None:
        raise PageFault("home is not a latitude, a longitude and an altitude")
    try:
        items = checked_items(MISSION, message.list("items"))
        borders = checked_items(FENCE, message.list("borders"))
        plan = Plan(
            form,
            tuple(each for each in items if isinstance(each, MissionItem)),
            tuple(each for each in borders if isinstance(each, Border)),
            home,
        )
        return answer_message(ask, Answer("ack"), text=write_plan(plan))
    except PlanError as error:
        return _invalid(ask, error)


class PlanService:
    """The transfers of one aircraft, one at a time; ``report`` receives how each upload ended."""

    def __init__(
        self,
        clock: Clock,
        aircraft: str,
        link: GroundLink,
        control: Control,
        telemetry: Telemetry,
        gate: CommandGate,
        report: Callable[[str, Report], object],
    ) -> None:
        self._clock = clock
        self._aircraft = aircraft
        self._link = link
        self._control = control
        self._telemetry = telemetry
        self._gate = gate
        self._report = report
        self._transfer: PlanTransfer | None = None
        self._on_end: Callable[[PlanOutcome], object] = lambda outcome: None

    def stop(self) -> None:
        if self._transfer is not None:
            self._transfer.stop()

    def on_plan(self, page: ClientSession, kind: str, message: Reader) -> None:
        """Begin ``plan.upload`` or ``plan.download``, or refuse it."""
        ask, plan = message.whole("ask"), message.choice("plan", *PLANS)
        items: tuple[PlanItem, ...] | None = None
        command: BaseCommand = MissionRequestCommand(plan)
        if kind == "plan.upload":
            try:
                items = checked_items(plan, message.list("items"))
            except PlanError as error:
                page.send(_invalid(ask, error))
                return
            command = MissionCommitCommand(plan, plan_id(items), len(items))
        refused = self._gate.refusal(
            page,
            command.NAME,
            command.data,
            message.optional_whole("beacon"),
            is_forced=False,
            unanswered=0,
        )
        if refused is None and self._transfer is not None:
            refused = Answer("refused", "busy", "another transfer of this aircraft runs")
        if refused is None:
            self._begin(page, ask, plan, items)
        else:
            page.send(answer_message(ask, refused))

    def on_message(self, message: GeneralMessage) -> None:
        """Take a message of the aircraft that is not telemetry."""
        if self._transfer is not None:
            self._transfer.on_message(message)

    def on_lost(self) -> None:
        if self._transfer is not None:
            self._on_end(PlanOutcome(LINK_LOST, "the link was lost before the answer"))

    def _begin(
        self, page: ClientSession, ask: int, plan: str, items: tuple[PlanItem, ...] | None
    ) -> None:
        asks = page.asks

        def notify(message: dict[str, Any]) -> None:
            # A page that was reloaded since then uses the same numbers for other requests.
            if page.asks is asks:
                page.send(message)

        def on_progress(phase: str, done: int, of: int) -> None:
            progress = {"plan": plan, "phase": phase, "done": done, "of": of}
            notify({"type": "plan.progress", "ask": ask, "aircraft": self._aircraft, **progress})

        def on_end(outcome: PlanOutcome) -> None:
            self.stop()
            self._transfer = None
            answer = _answer(outcome)
            result: dict[str, Any] = {}
            if not outcome.code:
                result["plan_id"] = outcome.plan_id
                if items is None:
                    result["items"] = [each.data for each in outcome.items]
            if items is not None:
                what = f"{plan} ({len(items)} items)" if items else f"no {plan}"
                name = MissionCommitCommand.NAME
                self._report(*outcome_event(page.name, what, name, {}, None, answer))
            notify(answer_message(ask, answer, outcome.problems, outcome.untold, **result))

        def send(command: BaseCommand, id_: str) -> None:
            needs_beacon = command.NEEDS_BEACON or self._link.status.is_keyed
            beacon = self._telemetry.beacon if needs_beacon else None
            if command.NEEDS_BEACON and page is not self._control.holder:
                text = "this page lost control before the aircraft used the plan"
                on_end(PlanOutcome("no_control", text))
                return
            self._link.send(encode(command.NAME, command.data, id_, beacon))

        self._on_end = on_end
        self._transfer = PlanTransfer(self._clock, send, plan, on_progress, on_end)
        if items is None:
            self._transfer.download()
        else:
            self._transfer.upload(items)


def _answer(outcome: PlanOutcome) -> Answer:
    words = {"": "ack", "no_control": "refused", **dict.fromkeys(_UNKNOWN, "timeout")}
    word = words.get(outcome.code, "nack")
    return Answer(word, outcome.code, outcome.reason, detail=outcome.detail)


def _invalid(ask: int, error: PlanError) -> dict[str, Any]:
    answer = Answer("refused", "plan_invalid", str(error.found[0]))
    return answer_message(ask, replace(answer, detail=error.code), error.found)


def _listed(problems: Sequence[PlanProblem]) -> list[dict[str, Any]]:
    return [each.data for each in problems[:LISTED]]
