"""A receiver with CRSF at the Raspberry Pi, which gets a mode switch of the transmitter."""

from __future__ import annotations

import math

from up_simulator.sensors.ubx_receiver import Line

ADDRESS, LINK_STATISTICS, CHANNELS = 0xC8, 0x14, 0x16
CHANNEL, CENTRE, BITS = 6, 992, 11
POSITIONS = {"low": 172, "middle": CENTRE, "high": 1811}
"""Values of a three-position switch: 988, 1500 and 2012 us."""
PERIOD_S = 0.02
READ_BYTES = 512


class CrsfReceiver:
    """Sends all channels and the link quality 50 times a second; ``switch`` moves channel 6.

    ``lost``: the quality is 0, and the channels keep their values, as in some failsafe settings.
    """

    def __init__(self) -> None:
        self.quality = 100
        self._value = POSITIONS["low"]
        self._due_s = -math.inf

    def switch(self, position: str) -> None:
        """Move the switch; a position other than ``lost`` ends the loss."""
        self.quality = 0 if position == "lost" else 100
        self._value = POSITIONS.get(position, self._value)

    def exchange(self, line: Line, now_s: float) -> None:
        """Pass the bytes of both directions; those of the telemetry are dropped."""
        line.read(0.0, READ_BYTES)
        if now_s >= self._due_s:
            self._due_s = now_s + PERIOD_S
            values = [CENTRE] * 16
            values[CHANNEL - 1] = self._value
            bits = sum(value << BITS * place for place, value in enumerate(values))
            statistics = bytes((70, 70, self.quality, 9, 0, 4, 3, 60, 100, 7))
            line.write(_frame(LINK_STATISTICS, statistics))
            line.write(_frame(CHANNELS, bits.to_bytes(22, "little")))


def _frame(type_: int, payload: bytes) -> bytes:
    body = bytes((type_,)) + payload
    return bytes((ADDRESS, len(body) + 1)) + body + bytes((_crc(body),))


def _crc(data: bytes) -> int:
    crc = 0
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = (crc << 1 ^ 0xD5) & 0xFF if crc & 0x80 else crc << 1
    return crc
