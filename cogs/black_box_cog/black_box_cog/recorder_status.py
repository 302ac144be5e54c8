"""The recorder's status."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class RecorderStatus:
    """Whether a file is written, its name, the size of its flight, the losses, the problem."""

    recording: bool = False
    file: str | None = None
    megabytes: float = 0.0
    dropped: int = 0
    problem: str | None = None
