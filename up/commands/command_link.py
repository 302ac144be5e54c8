"""A link that Commands come on: its role, its answers, its memory of ids."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass

from up.commands.origin import Origin
from up.commands.refusal import Code
from up.commands.roles import Role
from up.protocols.general_message import encode
from up.system.clock import Clock

REMEMBERED = 256
REMEMBERED_S = 60.0
_REASON_LIMIT = 500


@dataclass(slots=True)
class _Answer:
    time_s: float
    message: bytes | None = None


class CommandLink:
    """What the Command Receiver knows of one link; it outlives the link's connections.

    ``role_key`` names the configuration key that grants the role, for the nack; ``send`` takes an
    encoded answer and returns whether it left. ``is_public`` says that nothing proves who is on
    the other side.
    """

    def __init__(
        self,
        name: str,
        role: Role,
        send: Callable[[bytes], object],
        clock: Clock,
        *,
        role_key: str = "",
        priority: int = 0,
    ) -> None:
        self.origin = Origin(name, role, priority)
        self.role_key = role_key
        self._send = send
        self._clock = clock
        self._answers: OrderedDict[str, _Answer] = OrderedDict()

    @property
    def name(self) -> str:
        """Return the link's name, which is the source of the readings that come on it."""
        return self.origin.link

    def is_repeated(self, command_id: str) -> bool:
        """Remember an id; True when it was seen before: its answer is then sent again."""
        self._forget()
        known = self._answers.get(command_id)
        if known is None:
            while len(self._answers) >= REMEMBERED:
                self._answers.popitem(last=False)
            self._answers[command_id] = _Answer(self._clock.seconds())
            return False
        if known.message is not None:
            self._send(known.message)
        return True

    def ack(self, command_id: str | None) -> None:
        """Answer that the Command was carried out; without an id nobody waits for it."""
        if command_id is not None:
            self._answer(command_id, encode("up.ack", {"id": command_id}))

    def nack(self, command_id: str | None, code: Code, reason: str) -> None:
        """Answer that the Command was not carried out, and why."""
        if command_id is not None:
            data = {"id": command_id, "code": code.value, "reason": reason[:_REASON_LIMIT]}
            self._answer(command_id, encode("up.nack", data))

    def forward_answer(self, command_id: str, name: str, data: dict[str, object]) -> None:
        """Answer with what somebody further away answered."""
        self._answer(command_id, encode(name, data))

    def _answer(self, command_id: str, message: bytes) -> None:
        answer = self._answers.get(command_id)
        if answer is not None:
            answer.message = message
        self._send(message)

    def _forget(self) -> None:
        oldest = self._clock.seconds() - REMEMBERED_S
        answers = self._answers
        while answers and next(iter(answers.values())).time_s < oldest:
            answers.popitem(last=False)
