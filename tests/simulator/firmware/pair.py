"""The host build and the chip's binary side by side, each with a Raspberry Pi that listens."""

import dataclasses
import math

import pytest

from up_rig.imu import motion_at
from up_simulator.firmware.host_board import HostBoard
from up_simulator.firmware.imu_errors import ImuErrors
from up_simulator.firmware.line_monitor import LineMonitor
from up_simulator.firmware.rig_board import RigBoard

BOOT_MS = 1400
STEP_US = 2000


class Aboard:
    """One board with a Raspberry Pi that listens."""

    def __init__(self, board):
        self.board = board
        self.tap = LineMonitor()
        self.heard = []

    def run_ms(self, duration_ms):
        for _ in range(round(duration_ms * 1000 / STEP_US)):
            self.board.run_us(STEP_US)
            self.heard += self.tap.feed(self.board.read(), self.board.now_us / 1e6)

    def send(self, letter, payload=b""):
        self.board.write(self.tap.command_bytes(letter, payload))

    def sticks(self, wait_ms=400, **widths):
        for channel, width_us in widths.items():
            self.board.set_stick(channel, width_us)
        self.run_ms(wait_ms)

    def answers(self, letter, payload=b"", wait_ms=60):
        self.tap.take_answers()
        self.send(letter, payload)
        self.run_ms(wait_ms)
        return [(each.type, each.payload) for each in self.tap.take_answers()]

    def status(self):
        """Return what holds still of a status that came now."""
        self.send("s")
        self.run_ms(250)
        assert self.board.now_us / 1e6 - self.tap.status_s < 0.25
        return self.tap.status

    def stands(self):
        """Return the status without the values that may differ between two clocks."""
        apart = dict.fromkeys(("loop_us", "late_us", "rx_age_ms", "imu_age_ms", "acceleration"), 0)
        return dataclasses.replace(self.status(), **apart)

    def attitude(self):
        orientation = self.tap.orientation
        return orientation.roll_deg, orientation.pitch_deg


class Pair:
    """The host build and the chip's binary, treated alike."""

    def __init__(self, library, elf, *, boots=True, **options):
        options.setdefault("imu_errors", ImuErrors())
        self.host = Aboard(HostBoard(library, **options))
        self.chip = Aboard(RigBoard(elf, **options))
        if boots:
            self.each("run_ms", BOOT_MS)

    def each(self, name, *arguments, **options):
        """Do the same with both and return the result."""
        return [getattr(each, name)(*arguments, **options) for each in (self.host, self.chip)]

    def board(self, name, *arguments):
        for each in (self.host, self.chip):
            getattr(each.board, name)(*arguments)

    def agree(self, name, *arguments, **options):
        """Do the same with both, and demand the same of both."""
        host, chip = self.each(name, *arguments, **options)
        assert host == chip
        return host

    def agree_on_pulses(self, within_us=1.0):
        host, chip = self.host.board.pulses_us(), self.chip.board.pulses_us()
        assert host == pytest.approx(chip, abs=within_us)
        ages = [max(each.board.pulse_ages_us()) for each in (self.host, self.chip)]
        assert max(ages) < 30_000
        return host


def rocking(time_s):
    roll, pitch = 15 * math.sin(time_s), 8 * math.sin(0.7 * time_s)
    rates = (15 * math.cos(time_s), 5.6 * math.cos(0.7 * time_s), 0.0)
    return motion_at(roll, pitch, rates)
