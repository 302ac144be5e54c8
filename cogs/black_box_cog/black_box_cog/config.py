"""black_box.yml."""

from collections.abc import Iterator
from pathlib import Path

from up.config import ConfigFile, key
from up.quick_dataclass import dataclass

MEGABYTE = 1_000_000


@dataclass(frozen=True, slots=True)
class BlackBoxConfig:
    """The flight recorder: where it writes, and how much of the disk it takes."""

    enabled: bool = key(True, "Whether flights are recorded.")
    folder: str = key(
        "",
        "Folder of the flights, an absolute path. Empty: flights/ in the state directory that "
        "systemd sets, otherwise raspilot/flights in $XDG_STATE_HOME (~/.local/state).",
        max_length=1024,
    )
    always: bool = key(
        False,
        "Whether to record from the start of the program to its end. Otherwise a flight begins "
        "with the first Command from the Arduino, the phone or the ground, including the Commands "
        "before it, and ends after ten minutes without one.",
    )
    telemetry: bool = key(
        True,
        "Whether the recorder requests telemetry while the Arduino or the phone sends data, so "
        "that a flight without a ground station has it too.",
    )
    file_size_mb: float = key(
        50.0,
        "Size at which a flight continues in another file.",
        name="file size (MB)",
        unit="MB",
        minimum=1,
        maximum=2000,
    )
    total_size_mb: float = key(
        1000.0,
        "Maximum size of all flights together; the oldest are deleted beyond it.",
        name="total size (MB)",
        unit="MB",
        minimum=2,
        maximum=1_000_000,
    )
    keep_free_mb: float = key(
        200.0,
        "Space to keep free on the disk: the oldest flights are deleted, and recording stops when "
        "that is not enough.",
        name="keep free (MB)",
        unit="MB",
        minimum=0,
        maximum=1_000_000,
    )
    sync_s: float = key(
        1.0,
        "Maximum loss at a power cut: the file is synced to the disk this often.",
        name="sync (s)",
        unit="s",
        minimum=0.4,
        maximum=60,
    )
    waiting_messages: int = key(
        20_000,
        "Maximum number of messages that wait in memory while the disk is slow; more are dropped "
        "and counted.",
        name="waiting (messages)",
        minimum=1000,
        maximum=1_000_000,
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield contradictions between the keys, and an impossible folder."""
        try:
            folder = Path(self.folder).expanduser()
        except RuntimeError:
            yield "folder", "names a user without a home folder"
        else:
            if self.folder and (not folder.is_absolute() or "\0" in self.folder):
                yield "folder", "must be an absolute path, or begin with ~/"
        if self.total_size_mb < 2 * self.file_size_mb:
            yield "total_size_mb", "must be at least twice the file size"


BLACK_BOX = ConfigFile("black_box.yml", BlackBoxConfig)
