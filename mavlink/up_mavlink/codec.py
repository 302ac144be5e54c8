"""Bytes to messages and back, for one client."""

from __future__ import annotations

from collections import Counter
from typing import Any

from up_mavlink.signing import Signing

COMPONENT = 1
"""The autopilot's component."""


class Codec:
    """Packs and parses with pymavlink.

    What cannot be parsed or is not signed as required is dropped and counted. At most one
    incomplete packet is kept.
    """

    def __init__(
        self,
        dialect: Any,
        system_id: int,
        counters: Counter[str],
        signing: Signing | None = None,
    ) -> None:
        self._dialect = dialect
        self._counters = counters
        self._signing = signing
        self._mav = _mav(dialect, system_id, signing)

    def pack(self, message: Any) -> bytes:
        """Return the packet of a message, signed if the endpoint has a key."""
        mav = self._mav
        if self._signing is not None:
            mav.signing.timestamp = self._signing.next_stamp()
        packet = bytes(message.pack(mav))
        mav.seq = (mav.seq + 1) % 256
        return packet

    def parse(self, data: bytes) -> list[Any]:
        """Return the messages that these bytes complete."""
        mav, found = self._mav, []
        for message in mav.parse_buffer(data) or ():
            kind = message.get_type()
            if kind == "BAD_DATA":
                is_unsigned = message.reason == "Invalid signature"
                self._counters["unsigned" if is_unsigned else "malformed"] += 1
            elif kind.startswith("UNKNOWN"):
                self._counters["unknown"] += 1
            else:
                found.append(message)
        # pymavlink keeps all bytes until none is left over.
        if mav.buf_index:
            del mav.buf[: mav.buf_index]
            mav.buf_index = 0
        return found


def _mav(dialect: Any, system_id: int, signing: Signing | None) -> Any:
    class Checked(dialect.MAVLink):  # type: ignore[misc]
        """pymavlink remembers the time stamp of a packet before it checks the signature."""

        def check_signature(self, packet: bytearray, system: int, component: int) -> bool:
            return signing is not None and signing.accepts(bytes(packet), system, component)

    mav: Any = Checked(None, srcSystem=system_id, srcComponent=COMPONENT)
    mav.robust_parsing = True
    if signing is not None:
        mav.signing.secret_key = signing.key
        mav.signing.sign_outgoing = True
    return mav
