"""A board whose serial line is monitored, and disturbed, on its way to the other end."""

from __future__ import annotations

import random
from collections.abc import Callable

from up_rig.imu import Motion
from up_simulator.firmware.board import Channel, FirmwareBoard, Pulses, ResetCause
from up_simulator.firmware.imu_errors import BoardImu
from up_simulator.firmware.line_monitor import LineMonitor
from up_simulator.firmware.wire import CheckedReader, Command
from up_simulator.scenario.event import SerialNoise

TO_BOARD, FROM_BOARD = "to the board", "from the board"


class SerialWires:
    """Passes bytes, corrupts or drops them: the same seed corrupts the same bytes.

    ``corrupted`` counts the bytes that were flipped, inserted or lost.
    """

    def __init__(self, seed: int) -> None:
        self._random = random.Random(f"serial line {seed}")
        self._noise: SerialNoise | None = None
        self._noise_until_s = 0.0
        self.is_plugged = True
        self.corrupted = 0

    def set_noise(self, noise: SerialNoise, now_s: float) -> None:
        """Begin to corrupt bytes, for the duration of the noise."""
        self._noise = noise
        self._noise_until_s = now_s + noise.for_s

    def pass_on(self, data: bytes, direction: str, now_s: float) -> bytes:
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
        return self._corrupt(data, noise)

    def _corrupt(self, data: bytes, noise: SerialNoise) -> bytes:
        arrived = bytearray()
        chance = self._random.random
        for byte in data:
            if chance() * 100 < noise.lost_percent:
                self.corrupted += 1
                continue
            if chance() * 100 < noise.flipped_percent:
                byte ^= 1 << self._random.randrange(8)
                self.corrupted += 1
            arrived.append(byte)
            if chance() * 100 < noise.inserted_percent:
                arrived.append(self._random.randrange(256))
                self.corrupted += 1
        return bytes(arrived)


SLICE_US = 2000.0


class LineBoard:
    """A ``FirmwareBoard`` around another one, run in slices of 2 ms.

    ``after_slice`` is called after each slice: there the daemon's bytes are exchanged, in flight
    and while the board boots. The tap gets the board's output before any noise, ``on_command`` the
    board's input after it. Sticks reach the board through a receiver, with its delay.
    """

    def __init__(
        self, board: FirmwareBoard, wires: SerialWires, receiver_delay_us: float = 0.0
    ) -> None:
        self._board = board
        self.wires = wires
        self.tap = LineMonitor()
        self.after_slice: Callable[[], None] = lambda: None
        self.on_command: Callable[[Command], None] = lambda _command: None
        self.max_pulse_age_us = 0.0
        self._command_reader = CheckedReader()
        self._receiver_delay_us = receiver_delay_us
        self._sticks_us: dict[Channel, float] = {}
        self._has_radio = True
        self._coming: list[tuple[float, Channel, float]] = []

    @property
    def title(self) -> str:
        return self._board.title

    @property
    def imu(self) -> BoardImu:
        return self._board.imu

    @property
    def now_us(self) -> float:
        return self._board.now_us

    @property
    def now_s(self) -> float:
        return self._board.now_us / 1e6

    @property
    def eeprom(self) -> bytes:
        return self._board.eeprom

    def run_us(self, duration_us: float) -> None:
        left_us = duration_us
        while left_us > 1e-6:
            slice_us = min(left_us, SLICE_US)
            left_us -= slice_us
            while self._coming and self._coming[0][0] <= self.now_us:
                self._board.set_stick(*self._coming.pop(0)[1:])
            self._board.run_us(slice_us)
            self.max_pulse_age_us = max(self.max_pulse_age_us, *self._board.pulse_ages_us())
            self.after_slice()

    def take_max_pulse_age_us(self) -> float:
        """Return the greatest age of any output's pulse since the last call."""
        max_pulse_age_us, self.max_pulse_age_us = (
            self.max_pulse_age_us,
            max(self._board.pulse_ages_us()),
        )
        return max_pulse_age_us

    def set_stick(self, channel: Channel, width_us: float) -> None:
        """Move a stick: the receiver passes it on after its delay, unless its radio is off."""
        self._sticks_us[channel] = width_us
        if self._has_radio:
            self._coming.append((self.now_us + self._receiver_delay_us, channel, width_us))

    def lose_radio(self, throttle_us: float) -> None:
        """Make the receiver hold its pulses and send its own failsafe on the throttle."""
        self._has_radio = False
        self._coming = [(self.now_us, "throttle", throttle_us)]

    def restore_radio(self) -> None:
        """Make the receiver pass all sticks on again."""
        self._has_radio = True
        for channel, width_us in self._sticks_us.items():
            self.set_stick(channel, width_us)

    def set_receiver(self, is_on: bool) -> None:
        self._board.set_receiver(is_on)

    def set_channel(self, channel: Channel, is_on: bool) -> None:
        self._board.set_channel(channel, is_on)

    def set_motion(self, motion: Motion) -> None:
        self._board.set_motion(motion)

    def set_a7(self, volts: float) -> None:
        self._board.set_a7(volts)

    def pulses_us(self) -> Pulses:
        return self._board.pulses_us()

    def pulse_ages_us(self) -> tuple[float, float, float, float]:
        return self._board.pulse_ages_us()

    def read(self) -> bytes:
        data, now_s = self._board.read(), self.now_s
        self.tap.feed(data, now_s)
        return self.wires.pass_on(data, FROM_BOARD, now_s)

    def write(self, data: bytes) -> None:
        arrived = self.wires.pass_on(data, TO_BOARD, self.now_s)
        if arrived:
            for found in self._command_reader.feed(arrived, self.now_s):
                self.on_command(found)
            self._board.write(arrived)

    def reset(self, cause: ResetCause) -> None:
        self._board.reset(cause)
