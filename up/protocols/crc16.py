"""CRC-16/CCITT-FALSE, the check of a serial frame (docs/protocols.md 2.1)."""

from __future__ import annotations

from binascii import crc_hqx

INITIAL = 0xFFFF


def crc16(data: bytes | bytearray | memoryview) -> int:
    """Return the CRC of `data`, 0 to 65535: polynomial 0x1021, initial 0xFFFF, not reflected.

    A message followed by its own CRC, high byte first, has the CRC 0.
    """
    return crc_hqx(data, INITIAL)
