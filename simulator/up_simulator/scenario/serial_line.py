"""The wires between Arduino and Raspberry Pi, and the noise that they pick up."""

from __future__ import annotations

import random

from up_simulator.scenario.event import SerialNoise

TO_BOARD, FROM_BOARD = "to the board", "from the board"


class SerialWires:
    """Passes bytes, corrupts them or drops them: the same seed corrupts the same bytes.

    ``spoilt`` counts the bytes that were flipped, inserted or lost.
    """

    def __init__(self, seed: int) -> None:
        self._random = random.Random(f"serial line {seed}")
        self._noise: SerialNoise | None = None
        self._noise_until_s = 0.0
        self.is_plugged = True
        self.spoilt = 0

    def set_noise(self, noise: SerialNoise, now_s: float) -> None:
        """Begin to corrupt bytes, for the duration of the noise."""
        self._noise = noise
        self._noise_until_s = now_s + noise.for_s

    def pass_on(self, data: bytes, direction: str, now_s: float) -> bytes:
        """Return the bytes that arrive at the other end."""
        if not self.is_plugged:
            return b""
        noise = self._noise
        if noise is None or not data:
            return data
        if now_s >= self._noise_until_s:
            self._noise = None
            return data
        if noise.direction not in ("both", direction):
            return data
        return self._spoil(data, noise)

    def _spoil(self, data: bytes, noise: SerialNoise) -> bytes:
        arrived = bytearray()
        chance = self._random.random
        for byte in data:
            if chance() * 100 < noise.lost_percent:
                self.spoilt += 1
                continue
            if chance() * 100 < noise.flipped_percent:
                byte ^= 1 << self._random.randrange(8)
                self.spoilt += 1
            arrived.append(byte)
            if chance() * 100 < noise.inserted_percent:
                arrived.append(self._random.randrange(256))
                self.spoilt += 1
        return bytes(arrived)
