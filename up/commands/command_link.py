"""A link that delivers Commands: its role, its answers, the ids that it has seen."""

from collections import OrderedDict
from collections.abc import Callable

from up.commands.answer_commands import MAX_DETAIL, MAX_REASON
from up.commands.command import BaseCommand
from up.commands.origin import Origin
from up.commands.refusal import Code
from up.commands.roles import Role
from up.protocols.general_message import GeneralMessage, encode
from up.quick_dataclass import dataclass
from up.system.clock import Clock

REMEMBERED = 256
REMEMBERED_S = 60.0


@dataclass(slots=True)
class _Answer:
    time_s: float
    content: int
    message: bytes | None = None


Answers = OrderedDict[str, _Answer]


class CommandLink:
    """The state that the Command Receiver keeps per link; it outlives the link's connections.

    ``role_key`` names the configuration key that grants the role, for the nack; ``send`` takes an
    encoded answer and returns whether it was sent. ``policy`` may refuse a Command that the role
    permits: it returns the reason, or None. ``key`` names the device's key if the link is a
    protected session; the sessions of one key share ``answers``, so that a Command that is
    repeated in the next session is not carried out again.
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
        policy: Callable[[BaseCommand], str | None] | None = None,
        key: str = "",
        answers: Answers | None = None,
    ) -> None:
        self.origin = Origin(name, role, priority, key)
        self.role_key = role_key
        self.policy = policy
        self._send = send
        self._clock = clock
        self._answers: Answers = OrderedDict() if answers is None else answers

    @property
    def name(self) -> str:
        return self.origin.link

    @property
    def is_protected(self) -> bool:
        return bool(self.origin.key)

    def is_repeated(self, message: GeneralMessage) -> bool:
        """Remember a message's id; return True for a repeated message and send its answer again.

        A known id with other content is a new Command: old peers use one id for all of theirs.
        """
        if message.id is None:
            return False
        self._expire_answers()
        content = hash((message.name, repr(message.data)))
        known = self._answers.get(message.id)
        if known is None or known.content != content:
            self._answers.pop(message.id, None)
            while len(self._answers) >= REMEMBERED:
                self._answers.popitem(last=False)
            self._answers[message.id] = _Answer(self._clock.seconds(), content)
            return False
        if known.message is not None:
            self._send(known.message)
        return True

    def ack(self, command_id: str | None) -> None:
        """Acknowledge the Command; does nothing for a Command without an id."""
        if command_id is not None:
            self._answer(command_id, encode("up.ack", {"id": command_id}))

    def nack(self, command_id: str | None, code: Code, reason: str, detail: str = "") -> None:
        """Refuse the Command; ``detail`` is its handler's code, absent if empty."""
        if command_id is not None:
            data = {"id": command_id, "code": code.value, "reason": reason[:MAX_REASON]}
            if detail:
                data["detail"] = detail[:MAX_DETAIL]
            self._answer(command_id, encode("up.nack", data))

    def _answer(self, command_id: str, message: bytes) -> None:
        answer = self._answers.get(command_id)
        if answer is not None:
            answer.message = message
        self._send(message)

    def _expire_answers(self) -> None:
        oldest = self._clock.seconds() - REMEMBERED_S
        answers = self._answers
        while answers and next(iter(answers.values())).time_s < oldest:
            answers.popitem(last=False)
