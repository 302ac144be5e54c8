"""Upload and download of a mission or a fence (docs/mission.md)."""

import json
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import Any

from up.commands.mission_commands import (
    PART_ITEMS,
    MissionCommitCommand,
    MissionPartCommand,
    MissionProblemsCommand,
    MissionRequestCommand,
)
from up.commands.refusal import Code
from up.mission.items import PlanItem, plan_id
from up.mission.plan import PlanError, PlanProblem, checked_items
from up.mission.reliable_requests import ReliableRequests, Reply, SendCommand
from up.protocols.general_message import GeneralMessage
from up.quick_dataclass import dataclass
from up.sanitize_text import sanitize_text
from up.system.clock import Clock, Timer, cancel

WINDOW = 3
"""Parts that are unanswered at a time."""
PART_BYTES = 8000
"""Of the JSON of a part's items."""
RESTARTS, STALLS = 3, 5
PROBLEMS_S = 1.0
"""The problems may arrive after the refusal."""
NO_CONTENT = "no_content"
UPLOAD, COMMIT, VERIFY, DOWNLOAD = "upload", "commit", "verify", "download"


@dataclass(frozen=True, slots=True)
class PlanOutcome:
    """How a transfer ended; ``code`` is empty if all of it was done.

    ``items`` are those of the aircraft; ``problems`` why it refused, ``untold`` counts others.
    """

    code: str = ""
    reason: str = ""
    detail: str = ""
    items: tuple[PlanItem, ...] = ()
    plan_id: str = ""
    problems: tuple[PlanProblem, ...] = ()
    untold: int = 0


class PlanTransfer:
    """One upload, which ends with reading back what the aircraft uses, or one download.

    ``on_progress`` gets the phase and how many items of how many it has done, ``on_end`` the
    outcome, once. The owner passes every message of the aircraft to ``on_message``.
    """

    def __init__(
        self,
        clock: Clock,
        send: SendCommand,
        plan: str,
        on_progress: Callable[[str, int, int], object],
        on_end: Callable[[PlanOutcome], object],
    ) -> None:
        self.plan = plan
        self._clock = clock
        self._requests = ReliableRequests(clock, send)
        self._on_progress = on_progress
        self._on_end: Callable[[PlanOutcome], object] | None = on_end
        self._timer: Timer | None = None
        self._sent: tuple[PlanItem, ...] | None = None
        self._id = ""
        self._parts: list[MissionPartCommand] = []
        self._done = 0
        self._restarts = 0
        self._problems: tuple[PlanProblem, ...] = ()
        self._untold = 0
        # While the plan in use is read: its items so far, and the parts that are requested.
        self._read: dict[int, Any] | None = None
        self._in_use: tuple[str, int] | None = None
        self._requested: set[int] = set()
        self._stalls = 0
        self._phase = ""

    def upload(self, items: Sequence[PlanItem]) -> None:
        """Upload a plan; without items the aircraft's is removed."""
        self._sent, self._id = tuple(items), plan_id(items)
        self._begin()

    def download(self) -> None:
        self._collect(DOWNLOAD)

    def on_message(self, message: GeneralMessage) -> None:
        if self._on_end is None or message.data.get("plan") not in (None, self.plan):
            return
        try:
            if message.name == MissionProblemsCommand.NAME:
                self._take_problems(MissionProblemsCommand.from_data(message.data))
            elif message.name == MissionPartCommand.NAME:
                self._take_part(MissionPartCommand.from_data(message.data))
            else:
                self._requests.on_message(message)
        except PlanError as error:
            self._end(PlanOutcome("unreadable", str(error), problems=error.found))
        except ValueError as error:
            self._end(PlanOutcome("unreadable", sanitize_text(str(error), 300)))

    def stop(self) -> None:
        self._on_end = None
        self._requests.stop()
        cancel(self._timer)

    def _end(self, outcome: PlanOutcome) -> None:
        on_end = self._on_end
        self.stop()
        if on_end is not None:
            on_end(outcome)

    def _fail(self, reply: Reply) -> None:
        self._end(PlanOutcome(reply.code, reply.reason, reply.detail))

    # Upload.

    def _begin(self) -> None:
        assert self._sent is not None
        self._parts = [*_parts(self.plan, self._id, self._sent)][::-1]
        self._done = 0
        self._send_parts()

    def _send_parts(self) -> None:
        count = len(self._sent or ())
        while self._parts and len(self._requests) < WINDOW:
            part = self._parts.pop()
            self._requests.ask(part, partial(self._on_part_answer, len(part.items)))
        if not self._parts and not self._requests:
            self._on_progress(COMMIT, 0, count)
            command = MissionCommitCommand(self.plan, self._id, count)
            self._requests.ask(command, self._on_commit_answer)

    def _on_part_answer(self, items: int, reply: Reply) -> None:
        if reply.code:
            self._fail(reply)
            return
        self._done += items
        self._on_progress(UPLOAD, self._done, len(self._sent or ()))
        self._send_parts()

    def _on_commit_answer(self, reply: Reply) -> None:
        if reply.detail == "plan_invalid":
            outcome = partial(self._end_refused, reply)
            self._timer = self._clock.callLater(0 if self._problems else PROBLEMS_S, outcome)
        elif reply.detail in ("plan_incomplete", "plan_changed") and self._may_restart():
            # The aircraft was started again, or another ground has sent parts of another plan.
            self._begin()
        elif reply.code and reply.code != Code.TIMEOUT.value:
            self._fail(reply)
        else:
            self._collect(VERIFY)

    def _end_refused(self, reply: Reply) -> None:
        self._end(
            PlanOutcome(
                reply.code, reply.reason, reply.detail, (), "", self._problems, self._untold
            )
        )

    def _take_problems(self, told: MissionProblemsCommand) -> None:
        if self._sent is not None and told.plan_id == self._id:
            given = (each for each in told.problems if isinstance(each, dict))
            self._problems = tuple(_problem(self.plan, each) for each in given)
            self._untold = told.untold

    def _may_restart(self) -> bool:
        self._restarts += 1
        return self._restarts <= RESTARTS

    # Reading the plan in use.

    def _collect(self, phase: str) -> None:
        self._phase, self._read, self._in_use = phase, {}, None
        self._requested.clear()
        self._request()

    def _request(self) -> None:
        for first in self._missing():
            if len(self._requested) >= WINDOW:
                return
            self._requested.add(first)
            command = MissionRequestCommand(self.plan, first)
            self._requests.ask(command, partial(self._on_request_answer, first))

    def _missing(self) -> Iterator[int]:
        """Yield where parts begin that are neither there nor requested."""
        count = 1 if self._in_use is None else self._in_use[1]
        number = 1
        while number <= count:
            covered = (first <= number < first + PART_ITEMS for first in self._requested)
            if number in (self._read or {}) or any(covered):
                number += 1
            else:
                yield number
                number += PART_ITEMS

    def _on_request_answer(self, first: int, reply: Reply) -> None:
        self._requested.discard(first)
        if reply.code:
            self._fail(reply)
            return
        if first not in (self._read or {}):
            self._stalls += 1
        if self._stalls > STALLS:
            self._fail(Reply(NO_CONTENT, f"the {self.plan} did not arrive"))
        else:
            self._request()

    def _take_part(self, part: MissionPartCommand) -> None:
        if self._read is None:
            return
        in_use = (part.plan_id, part.count)
        if self._in_use not in (None, in_use):
            if not self._may_restart():
                self._end(PlanOutcome("plan_changed", f"the {self.plan} changes while it is read"))
                return
            self._read = {}
        self._in_use = in_use
        if part.first + len(part.items) > part.count + 1:
            raise ValueError(f"a part ends after item {part.count}, the last one")
        items = checked_items(self.plan, part.items)
        if part.first not in self._read and items:
            self._stalls = 0
        self._read.update(enumerate(items, part.first))
        self._on_progress(self._phase, len(self._read), part.count)
        if len(self._read) < part.count:
            self._request()
            return
        outcome = self._judged(tuple(self._read[each + 1] for each in range(part.count)), part)
        if outcome.code == "not_equal" and self._may_restart():
            # The parts may be late ones of the plan before, which another ground has requested.
            self._collect(VERIFY)
        else:
            self._end(outcome)

    def _judged(self, items: tuple[PlanItem, ...], part: MissionPartCommand) -> PlanOutcome:
        if plan_id(items) != part.plan_id:
            return PlanOutcome("plan_changed", "the items that arrived are not those of the plan")
        if self._sent is not None and items != self._sent:
            text = f"the aircraft uses another {self.plan} than the one that was sent"
            return PlanOutcome("not_equal", text, "", items, part.plan_id)
        return PlanOutcome("", "", "", items, part.plan_id)


def _parts(plan: str, identity: str, items: Sequence[PlanItem]) -> Iterator[MissionPartCommand]:
    first, data, size = 1, list[dict[str, Any]](), 0
    for number, each in enumerate(items, 1):
        item = each.data
        length = len(json.dumps(item))
        if data and (len(data) == PART_ITEMS or size + length > PART_BYTES):
            yield MissionPartCommand(plan, identity, len(items), first, tuple(data))
            first, data, size = number, [], 0
        data.append(item)
        size += length
    if data:
        yield MissionPartCommand(plan, identity, len(items), first, tuple(data))


def _problem(plan: str, given: dict[str, Any]) -> PlanProblem:
    item = given.get("item")
    number = item if isinstance(item, int) and 0 <= item < 1_000_000 else 0
    code, text = (sanitize_text(given.get(key) or "", 300) for key in ("code", "text"))
    return PlanProblem(plan, number, code, text)
