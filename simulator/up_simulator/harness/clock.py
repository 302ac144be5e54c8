"""The interface of a clock."""

from __future__ import annotations

from typing import Protocol


class Clock(Protocol):
    """A clock that only rises, such as a reactor's or a test's."""

    def seconds(self) -> float:
        """Return seconds since an arbitrary moment."""
