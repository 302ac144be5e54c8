"""``up-ground seat``: requests the seat that commands, hands it over, releases it."""

from __future__ import annotations

from typing import Any

from up.protocols.general_message import GeneralMessage
from up_ground.ground_link import GroundLink
from up_ground.link_status import ASK_INTERVAL_S, ControlStatus, LinkState, control_status
from up_ground.one_shot_task import EXIT_DONE, EXIT_NO_ANSWER, EXIT_REFUSED, Echo, OneShotTask
from up_ground.sanitize_text import sanitize_text
from up_ground.settings import Settings
from up_ground.token_store import TokenStore

ANSWER_LIMIT_S = 3.0


class ControlTask(OneShotTask):
    """Connects to the seat's proxy for one operation, which subclasses define."""

    LIMIT_S = ANSWER_LIMIT_S

    def __init__(
        self, reactor: Any, settings: Settings, tokens: TokenStore, *, echo: Echo, print_error: Echo
    ) -> None:
        super().__init__(echo, print_error)
        self.link = GroundLink(reactor, settings, self, tokens)
        self._reactor = reactor
        self._is_asked = False

    def start(self) -> None:
        """Begin."""
        self.after(self._reactor, "limit", self.LIMIT_S, self.on_limit)
        self.link.start()

    def on_message(self, message: GeneralMessage) -> None:
        """Telemetry is of no interest here."""

    def on_link(self) -> None:
        """React to the proxy's status."""
        status = self.link.status
        if self.is_finished:
            return
        if status.state is LinkState.WAITING:
            self.fail(status.reason, EXIT_REFUSED if status.rejection else EXIT_NO_ANSWER)
        elif status.is_open:
            self.on_control(control_status(status, False))

    def on_control(self, seat: ControlStatus) -> None:
        """Receive the owner of the seat."""
        raise NotImplementedError

    def on_limit(self) -> None:
        """Handle the timeout."""
        self.fail(f"the proxy did not do it within {self.LIMIT_S:g} s", EXIT_NO_ANSWER)

    def fail(self, sentence: str, status: int) -> None:
        """End with a sentence."""
        self.print_error(sanitize_text(sentence, 600))
        self.finish(status)


class RequestControl(ControlTask):
    """Requests the seat until it is granted or ``wait_s`` is over."""

    def __init__(self, *args: Any, wait_s: float, **more: Any) -> None:
        super().__init__(*args, **more)
        self.LIMIT_S = wait_s

    def on_control(self, seat: ControlStatus) -> None:
        """Take the seat, or request it and name its owner."""
        if seat is ControlStatus.OURS:
            self.echo("this ground commands now")
            self.finish(EXIT_DONE)
        elif seat in (ControlStatus.FREE, ControlStatus.HELD) and not self._is_asked:
            self._is_asked = True
            if seat is ControlStatus.HELD:
                self.echo(f"asked ground {self.link.status.holder}, which commands")
            self._ask()

    def on_limit(self) -> None:
        """Report who would have had to release it."""
        holder = self.link.status.holder
        who = "nobody gave it" if holder is None else f"ground {holder} has not given it"
        self.fail(f"no seat within {self.LIMIT_S:g} s: {who}", EXIT_NO_ANSWER)

    def _ask(self) -> None:
        self.link.request_seat()
        self.after(self._reactor, "ask", ASK_INTERVAL_S, self._ask)


class LeaveControl(ControlTask):
    """Hands the seat to the listener ``to``; releases it if ``to`` is None."""

    def __init__(self, *args: Any, to: int | None, **more: Any) -> None:
        super().__init__(*args, **more)
        self._to = to

    def on_control(self, seat: ControlStatus) -> None:
        """Release our seat and wait for the proxy's confirmation."""
        holder = self.link.status.holder
        if self._is_asked:
            if seat is not ControlStatus.OURS and self._to in (None, holder):
                who = "free" if self._to is None else f"ground {self._to}'s"
                self.echo(f"the seat is {who} now")
                self.finish(EXIT_DONE)
        elif seat is ControlStatus.OURS:
            self._is_asked = True
            if self._to is None:
                self.link.release_seat()
            else:
                self.link.give_seat(self._to)
        elif seat is ControlStatus.HELD:
            self.fail(f"this ground has no seat to leave: ground {holder} commands", EXIT_REFUSED)
        elif seat is ControlStatus.FREE:
            self.fail("this ground has no seat to leave: it is free", EXIT_REFUSED)

    def on_limit(self) -> None:
        """Report the most likely cause."""
        if self._is_asked and self._to is not None:
            self.fail(f"no ground {self._to} listens to this aircraft", EXIT_REFUSED)
        else:
            super().on_limit()
