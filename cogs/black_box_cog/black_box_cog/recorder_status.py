"""What the recorder tells of itself."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class RecorderStatus:
    """Whether a file is written, which, the size of its flight, what is lost, what is wrong."""

    recording: bool = False
    file: str | None = None
    megabytes: float = 0.0
    dropped: int = 0
    problem: str | None = None
