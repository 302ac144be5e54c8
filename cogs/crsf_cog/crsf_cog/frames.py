"""Frames of CRSF: address 0xC8, length, type, payload, CRC-8 of type and payload."""

from __future__ import annotations

import struct
from collections import Counter
from typing import NamedTuple

SYNC = 0xC8
GPS, BATTERY, LINK_STATISTICS, CHANNELS, ATTITUDE, FLIGHT_MODE = 0x02, 0x08, 0x14, 0x16, 0x1E, 0x21
PAYLOAD_SIZES = {LINK_STATISTICS: 10, CHANNELS: 22}
MIN_LENGTH, MAX_LENGTH = 2, 62
"""Of type, payload and CRC."""
_STATISTICS = struct.Struct(">3Bb5Bb")
_POWERS_MW = dict(enumerate((0, 10, 25, 100, 500, 1000, 2000, 250, 50)))


def _crc_of_byte(value: int) -> int:
    for _ in range(8):
        value = value << 1 ^ (0x1D5 if value & 0x80 else 0)
    return value


_CRC_TABLE = bytes(_crc_of_byte(value) for value in range(256))


def crc8(data: bytes) -> int:
    """Return the CRC of DVB-S2: polynomial 0xD5."""
    crc, table = 0, _CRC_TABLE
    for each in data:
        crc = table[crc ^ each]
    return crc


def frame(type_: int, payload: bytes) -> bytes:
    """Return the bytes of a frame."""
    body = bytes((type_,)) + payload
    return bytes((SYNC, len(body) + 1)) + body + bytes((crc8(body),))


class CrsfDecoder:
    """Finds the valid frames in a stream of bytes.

    ``counters``: ``noise`` (bytes that begin no frame), ``checksum`` and ``invalid`` (a payload of
    a wrong size).
    """

    def __init__(self) -> None:
        self.counters: Counter[str] = Counter()
        self._tail = b""

    def reset(self) -> None:
        self._tail = b""

    def feed(self, data: bytes) -> list[tuple[int, bytes]]:
        """Return type and payload of each frame that the bytes complete."""
        buffer = self._tail + data
        frames: list[tuple[int, bytes]] = []
        position, end = 0, len(buffer)
        while end - position >= 2:
            length = buffer[position + 1]
            if buffer[position] != SYNC or not MIN_LENGTH <= length <= MAX_LENGTH:
                self.counters["noise"] += 1
                position += 1
                continue
            following = position + 2 + length
            if following > end:
                break
            body = buffer[position + 2 : following - 1]
            if crc8(body) != buffer[following - 1]:
                # A frame may begin inside what looked like one.
                self.counters["checksum"] += 1
                position += 1
                continue
            position = following
            if len(body) - 1 == PAYLOAD_SIZES.get(body[0], len(body) - 1):
                frames.append((body[0], body[1:]))
            else:
                self.counters["invalid"] += 1
        self._tail = buffer[position:]
        return frames


def channels_us(payload: bytes) -> list[int]:
    """Return the 16 channels as us of pulse: 172 is 988 us, 992 is 1500 us, 1811 is 2012 us."""
    bits = int.from_bytes(payload, "little")
    return [1500 + round(((bits >> shift & 0x7FF) - 992) * 0.625) for shift in range(0, 176, 11)]


class LinkStatistics(NamedTuple):
    """What the receiver reports of the radio link: the way up to it, and down from it."""

    link_quality: int
    rssi_dbm: int
    snr_db: int
    rf_mode: int
    power_mw: int | None
    down_rssi_dbm: int
    down_link_quality: int
    down_snr_db: int

    @classmethod
    def of(cls, payload: bytes) -> LinkStatistics:
        rssi_1, rssi_2, quality, snr, antenna, mode, power, down_rssi, *down = _STATISTICS.unpack(
            payload
        )
        rssi_dbm = -(rssi_2 if antenna else rssi_1)
        return cls(quality, rssi_dbm, snr, mode, _POWERS_MW.get(power), -down_rssi, *down)
