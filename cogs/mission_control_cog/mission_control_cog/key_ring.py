"""The keys of the paired devices, read again when their file changes."""

from __future__ import annotations

import contextlib
import os
import time
from collections.abc import Callable, Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from twisted.internet.task import LoopingCall
from twisted.logger import Logger

from up.config import ConfigErrors
from up.config.keys_file import KEYS, KeyConfig
from up.protocols.aircraft_sessions import Key

POLL_S = 0.5
"""A revoked key ends its sessions within this time."""
_CLOCK_S = 3600.0


class KeyRing:
    """Follows keys.yml; ``on_keys`` gets all keys at the start and after each change.

    A faulty file keeps the keys read before: a typing error must not take control from a pilot in
    flight. A deleted file revokes all. Today is never before the file's last change, which is
    renewed every hour: a clock that is set back does not revive an expired key.
    """

    log = Logger()

    def __init__(
        self,
        reactor: Any,
        folder: Path,
        on_keys: Callable[[Mapping[bytes, Key]], object],
    ) -> None:
        self._folder = folder
        self._path = folder / KEYS.filename
        self._on_keys = on_keys
        self._stamp: object = ()
        self._newest_s = 0.0
        self._configured: Mapping[str, KeyConfig] = {}
        self._keys: Mapping[bytes, Key] | None = None
        self._poll = LoopingCall(self.update)
        self._poll.clock = reactor

    @property
    def is_empty(self) -> bool:
        """Return whether no device may open a session."""
        return all(each.refusal for each in (self._keys or {}).values())

    def start(self) -> None:
        self._poll.start(POLL_S)

    def stop(self) -> None:
        if self._poll.running:
            self._poll.stop()

    def update(self) -> None:
        """Read the file if it has changed, and report the keys if any of them differs now."""
        stamp, changed_s = self._look()
        if stamp != self._stamp:
            self._stamp = stamp
            self._load()
        self._newest_s = max(self._newest_s, changed_s, time.time())
        if stamp is not None and self._newest_s - changed_s > _CLOCK_S:
            with contextlib.suppress(OSError):
                os.utime(self._path, (self._newest_s, self._newest_s))
                self._stamp = self._look()[0]
        today = datetime.fromtimestamp(self._newest_s, UTC).date()
        keys = {
            bytes.fromhex(key_id): Key(
                bytes.fromhex(key_id),
                bytes.fromhex(each.secret),
                each.name,
                each.role,
                each.refusal(today),
            )
            for key_id, each in self._configured.items()
        }
        if keys != self._keys:
            self._keys = keys
            self._on_keys(keys)

    def _look(self) -> tuple[object, float]:
        try:
            found = self._path.stat()
        except OSError:
            return None, 0.0
        return (found.st_ino, found.st_size, found.st_mtime_ns, found.st_mode), found.st_mtime

    def _load(self) -> None:
        try:
            self._configured = KEYS.load(self._folder).keys
        except ConfigErrors as errors:
            for problem in errors.problems:
                self.log.error(
                    "{problem}; the keys read before stay valid",
                    problem=str(problem),
                    code="keys_faulty",
                )
