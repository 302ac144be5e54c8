"""MAVLink 2 signatures: the key, and which packets are fresh."""

from __future__ import annotations

import hashlib
import hmac
import struct
import time
from pathlib import Path

from up.errors import UserError

EPOCH_S = 1420070400
"""MAVLink counts from 2015-01-01, in units of 10 us."""
UNITS_PER_S = 100_000
NEW_STREAM_S = 60
"""The first packet of a sender may be this much older than the newest one of all senders."""
_STAMP = struct.Struct("<IH")


def read_key(path: Path) -> bytes:
    """Return the key of a passphrase file, as MAVProxy and QGroundControl compute it.

    Raises UserError if it cannot be read, is empty, or may be read by others.
    """
    try:
        mode, text = path.stat().st_mode, path.read_text(encoding="utf-8").strip()
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "not UTF-8 text"
        raise UserError(f"{path}: cannot read the passphrase: {reason}", "cannot_read") from None
    if mode & 0o077:
        text = f"{path}: others may read this passphrase: run 'chmod 600 {path}'"
        raise UserError(text, "secrets_readable")
    if not text:
        raise UserError(f"{path}: the passphrase is empty", "file_empty")
    return hashlib.sha256(text.encode()).digest()


class Signing:
    """The state of one endpoint, shared by all of its clients: a packet is accepted once.

    Time stamps only grow, whatever connection a packet arrives on.
    """

    def __init__(self, key: bytes) -> None:
        self.key = key
        self.stamp = max(0, _now())
        self._newest: dict[tuple[int, int, int], int] = {}

    def next_stamp(self) -> int:
        self.stamp = max(self.stamp + 1, _now())
        return self.stamp

    def accepts(self, packet: bytes, system: int, component: int) -> bool:
        """Return whether a packet has the key's signature and was not sent before."""
        signature = hashlib.sha256(self.key + packet[:-6]).digest()[:6]
        if not hmac.compare_digest(signature, packet[-6:]):
            return False
        low, high = _STAMP.unpack(packet[-12:-6])
        stamp = low | high << 32
        sender = (packet[-13], system, component)
        oldest = self._newest.get(sender, self.stamp - NEW_STREAM_S * UNITS_PER_S - 1)
        if stamp <= oldest:
            return False
        self._newest[sender] = stamp
        self.stamp = max(self.stamp, stamp)
        return True


def _now() -> int:
    return round((time.time() - EPOCH_S) * UNITS_PER_S)
