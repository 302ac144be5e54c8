"""The ground station's Commands in a flight, and their answers."""

from __future__ import annotations

from dataclasses import dataclass

from up_simulator.harness.participants import Ground
from up_simulator.scenario.event import CommandPart, Event
from up_simulator.scenario.verdict import Verdict


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
