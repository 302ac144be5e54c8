"""``up-ground control``: requests control, hands it over, releases it."""

from __future__ import annotations

from typing import Any

from up.cli.option_parser import EXIT_FAILED, EXIT_OK
from up_ground.link_status import ControlStatus
from up_ground.one_shot_task import EXIT_NO_ANSWER, LinkTask

ANSWER_LIMIT_S = 3.0


class ControlTask(LinkTask):
    """Connects to the proxy for one operation, which subclasses define."""

    LIMIT_S = ANSWER_LIMIT_S
    _has_requested = False

    def start(self) -> None:
        self.after(self._reactor, "limit", self.LIMIT_S, self.on_limit)
        self.link.start()

    def on_limit(self) -> None:
        self.fail(f"no answer of the proxy within {self.LIMIT_S:g} s", "no_answer", EXIT_NO_ANSWER)


class RequestControl(ControlTask):
    """Requests control until it is granted or ``wait_s`` is over."""

    def __init__(self, *args: Any, wait_s: float, **more: Any) -> None:
        super().__init__(*args, **more)
        self.LIMIT_S = wait_s

    def on_control(self, control: ControlStatus) -> None:
        if control is ControlStatus.OURS:
            self.echo("this ground has control", "control_granted")
            self.finish(EXIT_OK)
        elif control in (ControlStatus.FREE, ControlStatus.HELD) and not self._has_requested:
            self._has_requested = True
            if control is ControlStatus.HELD:
                owner = self.link.status.holder
                self.echo(f"requested control of ground {owner}", "control_requested", owner=owner)
            self.request_control()

    def on_limit(self) -> None:
        """Report the owner that would have had to release it."""
        owner = self.link.status.holder
        cause = "not granted" if owner is None else f"ground {owner} has not given it"
        text = f"no control within {self.LIMIT_S:g} s: {cause}"
        self.fail(text, "not_granted", EXIT_NO_ANSWER, owner=owner)


class LeaveControl(ControlTask):
    """Hands control to the listener ``to``; releases it if ``to`` is None."""

    def __init__(self, *args: Any, to: int | None, **more: Any) -> None:
        super().__init__(*args, **more)
        self._to = to

    def on_control(self, control: ControlStatus) -> None:
        owner = self.link.status.holder
        if self._has_requested:
            if control is not ControlStatus.OURS and self._to in (None, owner):
                if self._to is None:
                    self.echo("control is free", "control_released")
                else:
                    self.echo(f"ground {owner} has control", "control_given", owner=owner)
                self.finish(EXIT_OK)
        elif control is ControlStatus.OURS:
            self._has_requested = True
            if self._to is None:
                self.link.release_seat()
            else:
                self.link.give_seat(self._to)
        elif control in (ControlStatus.HELD, ControlStatus.FREE):
            state = "it is free" if owner is None else f"ground {owner} has it"
            self.fail(f"this ground has no control: {state}", "no_control", EXIT_FAILED)

    def on_limit(self) -> None:
        if self._has_requested and self._to is not None:
            text = f"no ground {self._to} listens to this aircraft"
            self.fail(text, "unknown_ground", EXIT_FAILED)
        else:
            super().on_limit()
