"""A value with its source and age."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Generic, TypeVar

_T = TypeVar("_T")


@dataclass(frozen=True, slots=True)
class Reading(Generic[_T]):
    """A value, its source, its monotonic time in seconds and whether the source marks it valid."""

    value: _T
    source: str
    time_s: float
    valid: bool = True

    def age_s(self, now_s: float) -> float:
        """Return the age in seconds."""
        return now_s - self.time_s

    def is_fresh(self, now_s: float, max_age_s: float) -> bool:
        """Return whether the value is valid and at most ``max_age_s`` old."""
        return self.valid and now_s - self.time_s <= max_age_s
