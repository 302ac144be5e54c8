"""Control of the servos: one publisher of set-points and Outputs at a time."""

import sys
from collections import Counter
from collections.abc import Callable
from types import FrameType

from twisted.logger import Logger

from up.log.limits import Once

SILENCE_S = 0.25
"""Silence after which the owner loses control: the longest lifetime of a set-point or Output."""


class PublisherControl:
    """Grants control to the first publisher, until it stops or is silent for ``SILENCE_S``.

    Other publishers are refused, logged once per pair, and counted by name in ``refused``.
    """

    log = Logger()

    def __init__(self, seconds: Callable[[], float]) -> None:
        self.refused: Counter[str] = Counter()
        self._seconds = seconds
        self._owner = ""
        self._renewed_at_s = float("-inf")
        self._logged = Once()

    @property
    def owner(self) -> str | None:
        is_held = self._seconds() - self._renewed_at_s <= SILENCE_S
        return self._owner if is_held else None

    def refuses(self, publisher: str, command: str) -> str | None:
        """Return why a publisher is refused; otherwise give it control and return None."""
        now_s, owner = self._seconds(), self._owner
        if owner == publisher or now_s - self._renewed_at_s > SILENCE_S:
            self._owner, self._renewed_at_s = publisher, now_s
            return None
        self.refused[publisher] += 1
        reason = f"{publisher} may not publish {command}: {owner} has control"
        if self._logged.first((publisher, owner)):
            self.log.warn(
                "{reason} (logged once, then counted)",
                reason=reason,
                code="control_taken",
                publisher=publisher,
                owner=owner,
                command=command,
            )
        return reason

    def release(self, publisher: str) -> None:
        if publisher == self._owner:
            self._renewed_at_s = float("-inf")


def calling_publisher() -> str:
    """Return the class of the module that called the bus, or its function's name.

    For the bus. A frame above an outer call of the bus belongs to another publisher.
    """
    # As logging and twisted.logger find their callers.
    frame: FrameType | None = sys._getframe(1)
    bus = frame.f_code.co_filename if frame else ""
    while frame is not None and frame.f_code.co_filename == bus:
        frame = frame.f_back
    function = "unknown" if frame is None else frame.f_code.co_qualname
    while frame is not None and frame.f_code.co_filename != bus:
        name = getattr(frame.f_locals.get("self"), "class_name", None)
        if name is not None:
            return str(name)
        frame = frame.f_back
    return function
