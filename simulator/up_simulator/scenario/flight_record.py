"""Results of a flight: its log, its Commands with their answers, and how it ended."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from up_simulator.in_process.ground import InProcessGround
from up_simulator.scenario.event import CommandPart, Event
from up_simulator.scenario.expectation import Verdict
from up_simulator.scenario.log import FlightLog
from up_simulator.scenario.scenario import Scenario


@dataclass(slots=True)
class PendingCommand:
    """One Command of the ground; ``answer`` is None until the answer, which is empty for an ack."""

    event: Event
    command: CommandPart
    command_id: str
    sent_s: float
    answer: str | None = None
    answered_s: float | None = None

    def poll(self, ground: InProcessGround, time_s: float) -> None:
        if self.answer is None:
            self.answer = ground.answer(self.command_id)
            if self.answer is not None:
                self.answered_s = time_s

    def verdict(self) -> Verdict | None:
        """Return the verdict on the answer; None if any answer will do."""
        command = self.command
        if command.answer == "any":
            return None
        name = f"{self.event.title} is answered with {command.answer}"
        limit = "no answer" if command.answer == "none" else f"within {command.within_s:g} s"
        if self.answer is None or self.answered_s is None:
            code = "" if command.answer == "none" else "no_answer"
            return Verdict(name, not code, "no answer", limit, code=code)
        kind = "nack" if self.answer else "ack"
        took_s = self.answered_s - self.sent_s
        code = "wrong_answer" if kind != command.answer else ""
        if not code and took_s > command.within_s + 1e-6:
            code = "late_answer"
        why = f"{kind} {self.answer}".strip() if code else ""
        return Verdict(name, not code, f"{took_s:.2f} s", limit, why, code=code)


@dataclass(slots=True)
class FlightRecord:
    """Result of a flight: the log, and all results that are not signals.

    ``crash`` is a sentence about its end on the ground, ``failure`` one about an early end, with
    its code and the newest lines of the daemon's log. ``notes`` are sentences by their codes.
    ``settings`` are the board's configuration files, ``black_boxes`` the recordings of a real
    daemon.
    """

    scenario: Scenario
    log: FlightLog
    event_times: dict[str, float] = field(default_factory=dict)
    pending_commands: list[PendingCommand] = field(default_factory=list)
    flown_s: float = 0.0
    took_s: float = 0.0
    crash: str | None = None
    crash_s: float | None = None
    failure: str | None = None
    failure_code: str | None = None
    failure_log: Sequence[str] = ()
    is_interrupted: bool = False
    board_title: str = ""
    model: str = ""
    notes: dict[str, str] = field(default_factory=dict)
    settings: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    black_boxes: Mapping[str, bytes] = field(default_factory=dict)

    @property
    def speed(self) -> float:
        return self.flown_s / self.took_s if self.took_s > 0 else 0.0

    @property
    def is_cut_short(self) -> bool:
        """Return whether another cause than a crash ended it early."""
        return self.is_interrupted or self.failure is not None

    def note(self, code: str, text: str) -> None:
        self.notes[code] = text
