"""The reason why the flight is not recorded: logged once per kind, and shown in telemetry."""

from pathlib import Path

from twisted.logger import Logger

from black_box_cog.flight_folder import NoRoomError

RETRY_S = 60.0


class DiskErrorState:
    """The current problem of the disk; ``problem`` is None without one."""

    def __init__(self, log: Logger, folder: Path) -> None:
        self.problem: str | None = None
        self._log = log
        self._folder = folder
        self._kind: object = None
        self._retry_s = float("-inf")

    def may_retry(self, now_s: float) -> bool:
        return now_s >= self._retry_s

    def delay_retry(self, now_s: float) -> None:
        self._retry_s = now_s + RETRY_S

    def report(self, error: Exception) -> None:
        """Store the disk's error, and log it if it is of another kind."""
        reason = getattr(error, "strerror", None) or str(error)
        path = getattr(error, "filename", None) or self._folder
        kind = getattr(error, "errno", None) or type(error)
        self.problem = reason if isinstance(error, NoRoomError) else f"{path}: {reason}"
        if self._kind != kind:
            self._kind = kind
            self._log.error(
                "the flight is not recorded: {problem}; retrying every minute",
                problem=self.problem,
                code="recording_stopped",
            )

    def clear(self) -> None:
        self.problem = self._kind = None
