"""The resume token on disk: a ground that reconnects gets its seat back immediately."""

from __future__ import annotations

import contextlib
import os
import re
import secrets
from collections.abc import Mapping
from pathlib import Path

from up.protocols.proxy_lines import is_token
from up.system.pid_file import PidFile, PidFileHeld
from up_ground.settings import Settings

STATE_VARIABLE = "UP_GROUND_STATE"
_UNSAFE = re.compile(r"[^A-Za-z0-9_.-]")


def state_folder(environ: Mapping[str, str]) -> Path:
    """Return where keys and tokens are: ``$UP_GROUND_STATE``, or up-ground in the user's state."""
    if own := environ.get(STATE_VARIABLE):
        return Path(own)
    home = environ.get("XDG_STATE_HOME", "")
    base = Path(home) if home.startswith("/") else Path.home() / ".local" / "state"
    return base / "up-ground"


class TokenStore:
    """The token of one aircraft at one proxy, used by one program of this user at a time.

    Two programs with one token would take the seat from each other without end; a program that
    cannot ``hold`` the store gets no token. Without a writable folder nothing is stored: a lost
    token costs three seconds of waiting.
    """

    def __init__(self, folder: Path, settings: Settings) -> None:
        name = f"{settings.host}_{settings.port}_{settings.aircraft}"
        self.path = folder / (_UNSAFE.sub("_", name)[:200] + ".token")
        self._lock: PidFile | None = None

    def hold(self) -> bool:
        """Reserve the token for this program; False if another one has it or storing fails."""
        if self._lock is not None:
            return True
        lock = PidFile(self.path.with_suffix(".lock"))
        try:
            self.path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
            lock.take()
        except (PidFileHeld, OSError):
            return False
        self._lock = lock
        return True

    def load(self) -> str | None:
        """Return the token; None if it is missing, damaged or reserved by another program."""
        if self._lock is None:
            return None
        try:
            text = self.path.read_text(encoding="ascii").strip()
        except (OSError, UnicodeDecodeError):
            return None
        return text if is_token(text) else None

    def save(self, token: str) -> None:
        if self._lock is None:
            return
        fresh = self.path.with_suffix(f".{secrets.token_hex(4)}")
        # Without a sync, which would block the link: a lost token costs little.
        with contextlib.suppress(OSError):
            descriptor = os.open(fresh, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
            with os.fdopen(descriptor, "w", encoding="ascii") as file:
                file.write(token + "\n")
            fresh.replace(self.path)

    def forget(self) -> None:
        """Drop the token: the seat was given up."""
        if self._lock is not None:
            with contextlib.suppress(OSError):
                self.path.unlink()

    def close(self) -> None:
        if self._lock is not None:
            self._lock.release()
            self._lock = None
