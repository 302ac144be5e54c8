"""What the doctor reads of a machine: files of the kernel, devices, and a few system calls."""

import ctypes
import os
import resource
import shutil
import subprocess
import time
from collections.abc import Sequence
from pathlib import Path

_TIME_ERROR = 5
_TIMEX_BYTES = 512
_LIMIT_S = 5.0


class Machine:
    """The machine whose files are below ``root``; a test gives another folder."""

    def __init__(self, root: Path = Path("/")) -> None:
        self._root = root

    @property
    def is_raspberry_pi(self) -> bool:
        return "Raspberry Pi" in self.read("proc/device-tree/model")

    def read(self, path: str) -> str:
        """Return a file's text without its end; empty if it cannot be read."""
        try:
            return (self._root / path).read_text(errors="replace").strip("\0\n ")
        except OSError:
            return ""

    def devices(self, *patterns: str) -> list[Path]:
        return sorted(each for name in patterns for each in (self._root / "dev").glob(name))

    def can_open(self, path: Path) -> bool:
        return os.access(path, os.R_OK | os.W_OK)

    def group_of(self, path: Path) -> str:
        """Return the name of the group that owns a file, or its number."""
        try:
            return path.group()
        except KeyError:
            return str(path.stat().st_gid)

    def free_bytes(self, folder: Path) -> int:
        """Return the space for files in a folder, which need not exist yet."""
        there = next(each for each in (folder, *folder.parents) if each.exists())
        return shutil.disk_usage(there).free

    def realtime_limit(self) -> int:
        """Return the highest real-time priority that this user may set; 99 for root."""
        if os.geteuid() == 0:
            return 99
        limit = resource.getrlimit(resource.RLIMIT_RTPRIO)[0]
        return 99 if limit == resource.RLIM_INFINITY else limit

    def is_clock_synchronised(self) -> bool:
        """Return whether the kernel's clock follows a time server, see adjtimex(2)."""
        state = ctypes.CDLL(None).adjtimex(ctypes.create_string_buffer(_TIMEX_BYTES))
        return bool(0 <= state < _TIME_ERROR)

    def wall_clock_s(self) -> float:
        return time.time()

    def output(self, command: Sequence[str]) -> str:
        """Return what a program prints; empty if it is missing or fails."""
        try:
            return subprocess.run(
                command, capture_output=True, text=True, timeout=_LIMIT_S, check=True
            ).stdout.strip()
        except (OSError, subprocess.SubprocessError):
            return ""
