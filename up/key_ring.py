"""The keys of the paired devices, read again when their file changes."""

import contextlib
import os
import time
from collections.abc import Callable, Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from twisted.internet.task import LoopingCall
from twisted.logger import Logger
from twisted.python.failure import Failure

from up.config import ConfigErrors, ConfigProblem
from up.config.keys_file import KEYS, KeyConfig
from up.protocols.aircraft_sessions import Key
from up.quick_dataclass import dataclass
from up.system.disk_thread import DiskThread

POLL_S = 0.5
"""A revoked key ends its sessions within this time."""
_CLOCK_S = 3600.0


@dataclass(frozen=True, slots=True)
class _Found:
    """What a look at the file has found; ``configured`` is None if it was not read, or is faulty.

    ``newest_s`` is the latest time that the clock or the file has shown.
    """

    stamp: object
    newest_s: float
    configured: Mapping[str, KeyConfig] | None = None
    problems: Sequence[ConfigProblem] = ()


class KeyRing:
    """Follows keys.yml, beside the reactor; ``on_keys`` gets all keys at the start and each change.

    A faulty file keeps the keys read before: a typing error must not take control from a pilot in
    flight. A deleted file revokes all. Today is never before the file's last change, which is
    renewed every hour: a clock that is set back does not revive an expired key. With ``aircraft``
    the keys for others are left out.
    """

    log = Logger()

    def __init__(
        self,
        reactor: Any,
        folder: Path,
        on_keys: Callable[[Mapping[bytes, Key]], object],
        aircraft: str | None = None,
    ) -> None:
        self._folder = folder
        self._path = folder / KEYS.filename
        self._on_keys = on_keys
        self._aircraft = aircraft
        self._disk = DiskThread(reactor)
        self._is_looking = False
        self._stamp: object = ()
        self._newest_s = 0.0
        self._configured: Mapping[str, KeyConfig] = {}
        self._keys: Mapping[bytes, Key] | None = None
        self._poll = LoopingCall(self._look_again)
        self._poll.clock = reactor

    @property
    def is_empty(self) -> bool:
        """Return whether no device may open a session."""
        return all(each.refusal for each in (self._keys or {}).values())

    def start(self) -> None:
        self._use(self._look())
        self._poll.start(POLL_S, now=False)

    def stop(self) -> None:
        if self._poll.running:
            self._poll.stop()

    def _look_again(self) -> None:
        if not self._is_looking:
            self._is_looking = True
            self._disk.run(self._look).addCallbacks(self._use, self._on_fault)

    def _look(self) -> _Found:
        """Read the file if it has changed; on the disk's thread."""
        stamp, changed_s = self._stat()
        newest_s = max(self._newest_s, changed_s, time.time())
        if stamp is None:
            return _Found(stamp, newest_s, {})
        if stamp != self._stamp:
            try:
                return _Found(stamp, newest_s, KEYS.load(self._folder).keys)
            except ConfigErrors as errors:
                return _Found(stamp, newest_s, None, errors.problems)
        if newest_s - changed_s > _CLOCK_S:
            with contextlib.suppress(OSError):
                os.utime(self._path, (newest_s, newest_s))
                stamp = self._stat()[0]
        return _Found(stamp, newest_s)

    def _stat(self) -> tuple[object, float]:
        try:
            found = self._path.stat()
        except FileNotFoundError:
            return None, 0.0
        except OSError as error:
            return error.errno, 0.0
        return (found.st_ino, found.st_size, found.st_mtime_ns, found.st_mode), found.st_mtime

    def _use(self, found: _Found) -> None:
        """Report the keys if any of them differs now."""
        self._is_looking = False
        self._stamp, self._newest_s = found.stamp, found.newest_s
        for problem in found.problems:
            text = "{problem}; the keys read before stay valid"
            self.log.error(text, problem=str(problem), code="keys_faulty")
        if found.configured is not None:
            self._configured = found.configured
        today = datetime.fromtimestamp(self._newest_s, UTC).date()
        keys = {
            bytes.fromhex(key_id): Key(
                bytes.fromhex(key_id),
                bytes.fromhex(each.secret),
                each.name,
                each.role,
                each.refusal(today),
                each.aircraft,
            )
            for key_id, each in self._configured.items()
            if self._aircraft is None or each.aircraft in ("", self._aircraft)
        }
        if keys != self._keys:
            self._keys = keys
            self._on_keys(keys)

    def _on_fault(self, failure: Failure) -> None:
        self._is_looking = False
        self.log.failure("the keys were not read", failure, code="keys_unread")
