"""``up-ground watch``: the displays of one aircraft."""

from __future__ import annotations

import os
from typing import Any

from up.cli.option_parser import EXIT_OK
from up.protocols.general_message import GeneralMessage, encode
from up.sanitize_text import sanitize_text
from up_ground.link_status import LinkState
from up_ground.one_shot_task import EXIT_NO_ANSWER, LinkTask, print_error
from up_ground.screen import State, draw, render
from up_ground.settings import Settings
from up_ground.status_text import plain_line
from up_ground.telemetry import NAME, Telemetry
from up_ground.terminal import Terminal
from up_ground.token_store import TokenStore

PAINT_S = 0.1
LINE_S = 1.0
MEASURE_S = 1.0
ONCE_LIMIT_S = 5.0
PRINTED_SIZE = (80, 24)
KEYS = "q quit  c request control  g give it  r release it"


class Watch(LinkTask):
    """Follows one aircraft until the user ends it; subclasses show it.

    Painted by the clock, not by telemetry, so that ages advance without new frames.
    """

    PERIOD_S = LINE_S

    def __init__(
        self,
        reactor: Any,
        settings: Settings,
        tokens: TokenStore,
        *,
        for_s: float | None = None,
        count: int | None = None,
    ) -> None:
        super().__init__(reactor, settings, tokens)
        self.state = State(settings, self.link.status, Telemetry())
        self._for_s = for_s
        self._left = count
        self._measured_s = 0.0

    def start(self) -> None:
        if self._for_s is not None:
            self.after(self._reactor, "end", self._for_s, self.on_time_over)
        self.link.start()
        self._tick()

    def on_message(self, message: GeneralMessage) -> None:
        """Take telemetry; other messages are mentioned."""
        if self.is_finished:
            return
        if message.name == NAME:
            if self.state.telemetry.update(message, self._reactor.seconds()):
                self.on_frame(message)
        elif message.name != "up.system.state":
            self.state.notice = (
                f"{sanitize_text(message.name, 40)} {sanitize_text(message.data, 120)}"
            )

    def on_link(self) -> None:
        """Handle a change of the link."""

    def on_frame(self, message: GeneralMessage) -> None:
        """Handle a telemetry frame."""

    def on_tick(self, now_s: float) -> None:
        """Show the present state."""

    def on_time_over(self) -> None:
        self.finish(EXIT_OK)

    def shown_one(self) -> None:
        if self._left is not None:
            self._left -= 1
            if self._left <= 0:
                self.finish(EXIT_OK)

    def _tick(self) -> None:
        now_s = self._reactor.seconds()
        if now_s - self._measured_s >= MEASURE_S:
            self._measured_s = now_s
            self.link.measure()
            self.state.telemetry.on_round_trip(self.state.status.round_trip_ms)
            self.state.telemetry.on_clock(self.state.status.clock)
        self.on_tick(now_s)
        self.after(self._reactor, "tick", self.PERIOD_S, self._tick)


class PlainWatch(Watch):
    """One line a second."""

    def start(self) -> None:
        self.link.start()
        if self._for_s is not None:
            self.after(self._reactor, "end", self._for_s, self.on_time_over)
        self.after(self._reactor, "tick", self.PERIOD_S, self._tick)

    def on_tick(self, now_s: float) -> None:
        self.echo(plain_line(self.state.status, self.state.telemetry, now_s))
        self.shown_one()


class JSONWatch(Watch):
    """The telemetry messages themselves, one per line; errors go to stderr."""

    _reported = ""

    def on_frame(self, message: GeneralMessage) -> None:
        """Print the message in the form in which it travels, harmless for a terminal."""
        line = encode(NAME, message.data, message.id, message.beacon).decode("ascii")
        self.echo(line.rstrip("\n").replace("\x7f", "\\u007f"))
        self.shown_one()

    def on_link(self) -> None:
        status = self.link.status
        if status.state is LinkState.WAITING and status.reason != self._reported:
            self._reported = status.reason
            print_error(sanitize_text(status.reason), status.code)
        elif status.is_open:
            self._reported = ""


class OnceWatch(Watch):
    """One picture as text, as soon as there is telemetry."""

    def start(self) -> None:
        """Begin; without telemetry it ends after some seconds."""
        if self._for_s is None:
            self._for_s = ONCE_LIMIT_S
        super().start()

    def on_frame(self, message: GeneralMessage) -> None:
        self.link.measure()
        self.echo(draw(self.state, self._reactor.seconds(), PRINTED_SIZE).plain())
        self.finish(EXIT_OK)

    def on_time_over(self) -> None:
        status = self.link.status
        reason, code = status.reason or "no telemetry", status.code or "no_telemetry"
        reason, code = status.key_fault or (reason, code)
        if status.is_aircraft_online is False:
            aircraft = self.state.settings.aircraft
            reason, code = f"{aircraft} is not connected to the proxy", "aircraft_offline"
        self.fail(reason, code, EXIT_NO_ANSWER)


class ScreenWatch(Watch):
    """The full-screen picture, and the keys."""

    PERIOD_S = PAINT_S

    def __init__(self, *args: Any, terminal: Terminal, **more: Any) -> None:
        super().__init__(*args, **more)
        self.state.keys = KEYS
        self._terminal = terminal

    def start(self) -> None:
        self._reactor.addReader(self)
        super().start()

    def finish(self, status: int) -> None:
        self._reactor.removeReader(self)
        super().finish(status)

    def on_tick(self, now_s: float) -> None:
        try:
            painted = self._terminal.paint(render(self.state, now_s, self._terminal.size))
        except OSError:
            # The terminal was closed.
            self.finish(EXIT_OK)
            return
        if painted and self._left is not None and self.state.telemetry.frames:
            self.shown_one()

    def fileno(self) -> int:
        return self._terminal.fileno()

    def logPrefix(self) -> str:  # noqa: N802 - Twisted's name
        return "keys"

    def connectionLost(self, reason: object) -> None:  # noqa: N802 - Twisted's name
        """Handle the stop of the reactor."""

    def doRead(self) -> None:  # noqa: N802 - Twisted's name
        keys = self._terminal.keys()
        if not keys:
            self.finish(EXIT_OK)
        for key in keys:
            self._on_key(key)

    def _on_key(self, key: str) -> None:
        status = self.link.status
        if key in "qQ":
            self.finish(EXIT_OK)
        elif key == "c":
            asked = self.link.request_seat()
            self.state.notice = "requested control" if asked else "no link to request control"
        elif key == "g" and status.asked_by is not None:
            self.link.give_seat(status.asked_by)
            status.asked_by = None
        elif key == "r":
            self.state.notice = "" if self.link.release_seat() else "no control to release"


def is_terminal(descriptor: int) -> bool:
    """Return whether a picture can be painted there."""
    return os.isatty(descriptor) and os.environ.get("TERM", "") not in ("", "dumb")
