"""Chips at an I2C bus, register by register, behind the interface of smbus2."""

from __future__ import annotations

import errno
from collections.abc import Callable, Iterable
from random import Random
from typing import Any

from up_simulator.aircraft.flight import FlightState

I2C_READ = 1


class RegisterChip:
    """A chip whose writes begin with a register, and go on with its values and the next ones."""

    def __init__(self, seed: int = 1) -> None:
        self.registers = bytearray(256)
        self.noise = Random(f"{type(self).__name__} {seed}")
        self._pointer = 0

    def write(self, data: bytes) -> None:
        self._pointer = data[0]
        for value in data[1:]:
            self.on_write(self._pointer, value)
            self._pointer = (self._pointer + 1) % 256

    def read(self, count: int) -> bytes:
        found = bytes(self.on_read((self._pointer + each) % 256) for each in range(count))
        self._pointer = (self._pointer + count) % 256
        return found

    def on_write(self, register: int, value: int) -> None:
        self.registers[register] = value

    def on_read(self, register: int) -> int:
        return self.registers[register]

    def put(self, register: int, data: Iterable[int]) -> None:
        for at, value in enumerate(data):
            self.registers[register + at] = value

    def update(self, state: FlightState) -> None:
        """Measure the flight; a chip that measures overrides it."""


class TwinBus:
    """The chips by their addresses. ``fails`` makes every transfer fail, as a short circuit."""

    def __init__(self, chips: dict[int, RegisterChip]) -> None:
        self.chips = chips
        self.is_open = True
        self.fails: Callable[[], bool] = lambda: False

    def write_i2c_block_data(self, address: int, register: int, data: list[int]) -> None:
        self._chip(address).write(bytes([register, *data]))

    def read_i2c_block_data(self, address: int, register: int, count: int) -> list[int]:
        chip = self._chip(address)
        chip.write(bytes([register]))
        return list(chip.read(count))

    def i2c_rdwr(self, *messages: Any) -> None:
        for message in messages:
            chip = self._chip(message.addr)
            if message.flags & I2C_READ:
                for at, value in enumerate(chip.read(message.len)):
                    message.buf[at] = bytes([value])
            else:
                chip.write(bytes(message))

    def close(self) -> None:
        self.is_open = False

    def update(self, state: FlightState) -> None:
        for chip in self.chips.values():
            chip.update(state)

    def _chip(self, address: int) -> RegisterChip:
        if self.fails():
            raise OSError(errno.EIO, "Input/output error")
        if address not in self.chips:
            raise OSError(errno.EREMOTEIO, "Remote I/O error")
        return self.chips[address]
