"""The ground station's Commands in a flight, and their answers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from up_simulator.harness.participants import Ground
from up_simulator.scenario.event import CommandPart, Event
from up_simulator.scenario.expectation import Verdict
from up_simulator.scenario.log import FlightLog
from up_simulator.scenario.scenario import Scenario


@dataclass(slots=True)
class Question:
    """One Command in flight; ``answer`` stays None until the answer, which is empty for an ack."""

    event: Event
    command: CommandPart
    command_id: str
    sent_s: float
    answer: str | None = None
    answered_s: float | None = None

    def look(self, ground: Ground, time_s: float) -> None:
        """See whether the answer is there."""
        if self.answer is None:
            self.answer = ground.answer(self.command_id)
            if self.answer is not None:
                self.answered_s = time_s

    def verdict(self) -> Verdict | None:
        """Return the verdict on the answer; None where any answer will do."""
        command = self.command
        if command.answer == "any":
            return None
        name = f"{self.event.title} is answered with {command.answer}"
        limit = "no answer" if command.answer == "none" else f"within {command.within_s:g} s"
        if self.answer is None or self.answered_s is None:
            return Verdict(name, command.answer == "none", "no answer", limit)
        kind = "nack" if self.answer else "ack"
        took_s = self.answered_s - self.sent_s
        is_held = kind == command.answer and took_s <= command.within_s + 1e-6
        why = "" if is_held else f"{kind} {self.answer}".strip()
        return Verdict(name, is_held, f"{took_s:.2f} s", limit, why)


@dataclass(slots=True)
class FlightRecord:
    """Result of a flight: the log, and all results that are not signals.

    ``crash`` is a sentence about its end on the ground, ``failure`` one about an early end, with
    the lines of the daemon's log behind it. ``settings`` are the board's configuration files,
    ``black_boxes`` the recordings of a real daemon.
    """

    scenario: Scenario
    log: FlightLog
    event_times: dict[str, float] = field(default_factory=dict)
    questions: list[Question] = field(default_factory=list)
    flown_s: float = 0.0
    took_s: float = 0.0
    crash: str | None = None
    crash_s: float | None = None
    failure: str | None = None
    failure_log: Sequence[str] = ()
    is_interrupted: bool = False
    board_title: str = ""
    notes: list[str] = field(default_factory=list)
    settings: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    black_boxes: Mapping[str, bytes] = field(default_factory=dict)

    @property
    def speed(self) -> float:
        """Return how many times faster than the real time it was."""
        return self.flown_s / self.took_s if self.took_s > 0 else 0.0

    @property
    def is_broken_off(self) -> bool:
        """Return whether another cause than a crash ended it before its time."""
        return self.is_interrupted or self.failure is not None
