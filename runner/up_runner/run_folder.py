"""The folder of one runner at a time: its PID file, its sockets, its records."""

from __future__ import annotations

import os
import stat
from pathlib import Path

from up.system.pid_file import PidFile, PidFileHeld

PID_FILE = ".runner.pid"
"""Begins with a dot, unlike the names of instances."""
# sun_path holds 108 bytes with the closing zero; the longest path is <folder>/<32>/notify.
MAX_PATH_BYTES = 107 - len("/notify") - 33


class CannotStart(Exception):  # noqa: N818 - the text is the message
    """The runner cannot start: a code and one sentence."""

    def __init__(self, code: str, text: str) -> None:
        super().__init__(text)
        self.code = code


class RunFolder:
    """A private folder held by a PID file until `release` or the end of the process."""

    def __init__(self, path: Path) -> None:
        self.path = Path(path).absolute()
        self._pid_file = PidFile(self.path / PID_FILE)

    def take(self) -> None:
        """Create the folder, check that it is private and lock it.

        Raises CannotStart when its path is too long for a socket, when it belongs to another
        user or is open to others, or when another runner holds it.
        """
        if len(os.fsencode(self.path)) > MAX_PATH_BYTES:
            raise CannotStart(
                "path_too_long",
                f"the path of the run folder {self.path} is longer than {MAX_PATH_BYTES} bytes: "
                "too long for the sockets in it",
            )
        try:
            self.path.mkdir(mode=0o700, parents=True, exist_ok=True)
            self._check_owner()
            self._pid_file.take()
        except PidFileHeld as held:
            raise CannotStart(
                "run_folder_in_use",
                f"another runner (process {held.holder}) uses the run folder {self.path}",
            ) from None
        except OSError as error:
            text = f"the run folder {self.path} cannot be used: {error.strerror or error}"
            raise CannotStart("run_folder_unusable", text) from None

    def instance(self, name: str) -> Path:
        """Return the folder of one instance; `name` is a checked name and has no leading dot."""
        return self.path / name

    def names(self) -> list[str]:
        return sorted(
            each.name
            for each in self.path.iterdir()
            if not each.name.startswith(".") and each.is_dir() and not each.is_symlink()
        )

    def release(self) -> None:
        self._pid_file.release()

    def _check_owner(self) -> None:
        found = os.lstat(self.path)
        if not stat.S_ISDIR(found.st_mode):
            raise CannotStart("not_a_folder", f"the run folder {self.path} is not a folder")
        if found.st_uid != os.geteuid():
            text = f"the run folder {self.path} belongs to user {found.st_uid}"
            raise CannotStart("foreign_folder", text)
        if found.st_mode & 0o077:
            text = f"the run folder {self.path} is open to other users; chmod 700 closes it"
            raise CannotStart("open_folder", text)
