"""A bus, and Commands to send over it."""

from dataclasses import dataclass
from typing import ClassVar

from twisted.internet.task import Clock
from twisted.logger import formatEvent, globalLogPublisher

from up.commands.beacon import Beacons
from up.commands.builtin import BUILTIN_COMMANDS
from up.commands.command import BaseCommand, value
from up.commands.command_executor import CommandExecutor
from up.commands.command_link import CommandLink
from up.commands.command_receiver import CommandReceiver
from up.commands.command_registry import CommandRegistry
from up.commands.roles import Role
from up.log.limits import Limited
from up.protocols.general_message import GeneralMessage, decode


@dataclass(frozen=True, slots=True)
class NumberCommand(BaseCommand):
    """A number."""

    NAME: ClassVar[str] = "test.number"
    ALIASES: ClassVar[tuple[str, ...]] = ("test.old_number",)
    ROLES: ClassVar[frozenset[Role]] = frozenset({Role.OPERATOR})
    number: int = value(0, minimum=0, maximum=99)


@dataclass(frozen=True, slots=True)
class OtherCommand(BaseCommand):
    """Another one."""

    NAME: ClassVar[str] = "test.other"


def make_bus(*commands, call_from_thread=None, clock=None):
    return CommandExecutor(
        CommandRegistry((*BUILTIN_COMMANDS, NumberCommand, OtherCommand, *commands)),
        call_from_thread or (lambda call, *arguments: call(*arguments)),
        Limited(clock or Clock(), 10),
    )


class Border:
    """A receiver, a link, and the answers on it."""

    def __init__(self, role=Role.PILOT, *commands):
        self.clock = Clock()
        self.bus = make_bus(*commands, clock=self.clock)
        self.beacons = Beacons(self.clock)
        self.receiver = CommandReceiver(self.bus, self.beacons, self.clock)
        self.sent = []
        self.link = CommandLink(
            "ground", role, self.sent.append, self.clock, role_key="mission_control.yml: role"
        )

    def say(self, name, data=None, id=None, beacon=None):
        self.receiver.receive(GeneralMessage(name, data or {}, id, beacon), self.link)

    @property
    def answers(self):
        """The answers: ("ack", id) or (code, id, reason)."""
        found = []
        for line in self.sent:
            data = decode(line).data
            found.append(
                (data["code"], data["id"], data["reason"])
                if "code" in data
                else ("ack", data["id"])
            )
        return found

    @property
    def codes(self):
        return [answer[0] for answer in self.answers]


class Log:
    """The log records made inside the context."""

    def __enter__(self):
        self.events = []
        globalLogPublisher.addObserver(self.events.append)
        return self

    def __exit__(self, *_):
        globalLogPublisher.removeObserver(self.events.append)

    @property
    def failures(self):
        return [event for event in self.events if "log_failure" in event]

    def of(self, code):
        """Return the events with a code."""
        return [event for event in self.events if event.get("code") == code]

    def text(self):
        return "\n".join(formatEvent(event) for event in self.events)
