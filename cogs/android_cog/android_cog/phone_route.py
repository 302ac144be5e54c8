"""Forwards Commands to the phone and its answers back to the sender."""

from collections import OrderedDict
from uuid import uuid4

from twisted.internet.defer import Deferred

from android_cog.phone_link import PhoneLink
from up.commands.command import BaseCommand
from up.commands.command_link import CommandLink
from up.commands.refusal import Code, CommandRefusedError
from up.protocols.general_message import encode
from up.protocols.general_message_link import GeneralMessageLink
from up.quick_dataclass import dataclass

PENDING_LIMIT = 64
_MAX_USED_IDS = 512


@dataclass(frozen=True, slots=True)
class _Pending:
    """A forwarded Command with its link and recipient: only that phone's answer counts."""

    via: GeneralMessageLink
    peer: str
    done: Deferred[None]


class PhoneRoute:
    """The route ``android``: the Command Receiver hands over Commands, and times out after 2 s.

    A Command is sent with the sender's id, or with a generated one if that id was used with the
    phone before: the phone would treat it as a repetition.
    """

    def __init__(self, phone: PhoneLink) -> None:
        self.unasked_answers = 0
        self._phone = phone
        self._pending: dict[str, _Pending] = {}
        self._used_ids: OrderedDict[str, None] = OrderedDict()

    def __len__(self) -> int:
        return len(self._pending)

    def carry(
        self, command: BaseCommand, asker: CommandLink, command_id: str | None
    ) -> Deferred[None] | None:
        """Send a Command to the phone; the result is the phone's answer.

        Returns None for a Command without an id. Raises CommandRefusedError if it cannot be sent.
        """
        link = self._phone.current
        if link is None:
            raise CommandRefusedError("the phone is not connected", Code.UNAVAILABLE)
        if command_id is not None and len(self._pending) >= PENDING_LIMIT:
            raise CommandRefusedError(
                f"{PENDING_LIMIT} Commands wait for the phone already", Code.UNAVAILABLE
            )
        wire_id = None if command_id is None else self._unused_id(command_id)
        try:
            message = encode(command.NAME, command.data, wire_id)
        except ValueError as error:
            raise CommandRefusedError(str(error), Code.INVALID) from error
        if not link.send(message):
            raise CommandRefusedError("the phone takes nothing now", Code.UNAVAILABLE)
        if wire_id is None:
            return None
        done: Deferred[None] = Deferred(lambda _: self._discard(wire_id))
        self._pending[wire_id] = _Pending(link, link.peer, done)
        return done

    def on_answer(
        self, sender: GeneralMessageLink, command_id: str, refusal: CommandRefusedError | None
    ) -> None:
        """Take the phone's ``up.ack`` (no refusal) or ``up.nack``; count an unexpected one."""
        pending = self._pending.get(command_id)
        if pending is None or pending.via is not sender or pending.peer != sender.peer:
            self.unasked_answers += 1
            return
        del self._pending[command_id]
        if refusal is None:
            pending.done.callback(None)
        else:
            pending.done.errback(refusal)

    def on_lost(self, link: GeneralMessageLink) -> None:
        """Answer the Commands whose link was lost: their outcome is unknown."""
        for command_id, pending in list(self._pending.items()):
            if pending.via is link:
                del self._pending[command_id]
                pending.done.errback(
                    CommandRefusedError("the phone went away before it answered", Code.UNAVAILABLE)
                )

    def _discard(self, wire_id: str) -> None:
        self._pending.pop(wire_id, None)

    def _unused_id(self, wanted: str) -> str:
        chosen = uuid4().hex if wanted in self._used_ids or wanted in self._pending else wanted
        self._used_ids[chosen] = None
        if len(self._used_ids) > _MAX_USED_IDS:
            self._used_ids.popitem(last=False)
        return chosen
