"""Why the flight is not recorded: said once a kind, and kept for telemetry."""

from __future__ import annotations

from pathlib import Path

from twisted.logger import Logger

from black_box_cog.flight_folder import NoRoomError

RETRY_S = 60.0


class Trouble:
    """The problem with the disk that there is now; ``problem`` None: there is none."""

    def __init__(self, log: Logger, folder: Path) -> None:
        self.problem: str | None = None
        self._log = log
        self._folder = folder
        self._kind: object = None
        self._retry_s = float("-inf")

    def is_time_to_try(self, now_s: float) -> bool:
        """Return whether a file may be begun."""
        return now_s >= self._retry_s

    def wait(self, now_s: float) -> None:
        """Try again in a minute only."""
        self._retry_s = now_s + RETRY_S

    def note(self, error: Exception) -> None:
        """Keep what the disk refused."""
        reason = getattr(error, "strerror", None) or str(error)
        path = getattr(error, "filename", None) or self._folder
        kind = getattr(error, "errno", None) or type(error)
        self.problem = reason if isinstance(error, NoRoomError) else f"{path}: {reason}"
        if self._kind != kind:
            self._kind = kind
            self._log.error(
                "the flight is not recorded: {text}; tried again every minute", text=self.problem
            )

    def forget(self) -> None:
        """Hear that it is over."""
        self.problem = self._kind = None
