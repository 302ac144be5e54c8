"""Betaflight's SITL as the board of a flight: the real program, by its sockets on this machine."""

from __future__ import annotations

import math
import shutil
import socket
import subprocess
import tempfile
import time
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from up_rig.imu import Motion
from up_simulator.aircraft.dynamics import FlightDynamics
from up_simulator.betaflight.packets import (
    PWM_PORT,
    PWM_SIZE,
    RECEIVER_PORT,
    STATE_PORT,
    pack_state,
    pack_sticks,
    read_servos,
)
from up_simulator.firmware.board import NEUTRAL_US, BoardCrashedError, Channel, Pulses, ResetCause
from up_simulator.firmware.build import BoardUnavailableError
from up_simulator.firmware.imu_errors import BoardImu, ImuErrors
from up_simulator.harness.child import Child
from up_simulator.radio.sticks import Sticks

PROGRAM = "betaflight_SITL"
SETTINGS = Path(__file__).with_name("settings.txt")
SETTINGS_LIMIT_S, TRY_S, POLL_S = 30.0, 5.0, 0.02
TRIES = 6
FRAME_US, SILENT_US = 20_000.0, 5e6
_HOST = "127.0.0.1"


def find_program(program: str = PROGRAM) -> str:
    """Return the path of Betaflight's program; raises ``BoardUnavailableError``."""
    found = shutil.which(program)
    if found is not None:
        return str(Path(found).resolve())
    if Path(program).is_file():
        text = f"{program} cannot be executed: 'chmod +x {program}' makes it a program"
    else:
        text = f"{program} is not installed: cogs/msp_cog/README.md says where it comes from"
    raise BoardUnavailableError(text)


class BetaflightBoard:
    """A ``FirmwareBoard`` whose program is not ours; it runs in real time, whatever is asked of it.

    The settings are those of ``settings.txt``. Its line is TCP port 5761, not ``read`` and
    ``write``. ``on_ground`` are the sticks in place of the radio's. Raises
    ``BoardUnavailableError``.
    """

    title = "Betaflight (SITL)"
    eeprom = b""

    def __init__(self, flight: FlightDynamics, program: str = PROGRAM, seed: int = 1) -> None:
        self._program = find_program(program)
        self._flight = flight
        self.imu = BoardImu(ImuErrors(), seed)
        self.on_ground: Sticks | None = None
        self._sticks = Sticks()
        self._now_us = self._frame_us = 0.0
        self._first = flight.state
        self._pulses: Pulses = NEUTRAL_US
        self._pulse_us = -math.inf
        self._child: Child | None = None
        self._socket = socket.socket(type=socket.SOCK_DGRAM)
        self._socket.setblocking(False)
        self._folder = Path(tempfile.mkdtemp(prefix="betaflight-"))
        try:
            self._socket.bind((_HOST, PWM_PORT))
            self._configure()
            self._start()
        except BaseException as error:
            self.close()
            if isinstance(error, OSError):
                raise BoardUnavailableError(
                    f"UDP port {PWM_PORT}, which Betaflight sends its pulses to: {error.strerror};"
                    " only one flight with Betaflight at a time"
                ) from error
            raise

    @property
    def now_us(self) -> float:
        return self._now_us

    def run_us(self, duration_us: float) -> None:
        """Tell the board what it feels now, and take the newest pulses.

        Raises ``BoardCrashedError`` when none come for 5 s.
        """
        self._now_us += duration_us
        motion = self.imu.measure(self._now_us / 1e6)
        packet = pack_state(motion, self._flight.state, self._first)
        self._socket.sendto(packet, (_HOST, STATE_PORT))
        sticks = self.on_ground or self._sticks
        if self._now_us >= self._frame_us and sticks.is_on:
            self._frame_us = self._now_us + FRAME_US
            self._socket.sendto(pack_sticks(sticks), (_HOST, RECEIVER_PORT))
        packet = b""
        with suppress(BlockingIOError):
            while True:
                packet = self._socket.recv(PWM_SIZE + 1)
        if len(packet) == PWM_SIZE:
            self._pulses, self._pulse_us = read_servos(packet), self._now_us
        elif 0.0 <= self._pulse_us < self._now_us - SILENT_US:
            raise BoardCrashedError("Betaflight sends no pulses")

    def set_stick(self, channel: Channel, width_us: float) -> None:
        self._sticks = self._sticks.moved(channel, round(width_us))

    def set_receiver(self, is_on: bool) -> None:
        self._sticks = replace(self._sticks, is_on=is_on)

    def set_channel(self, channel: Channel, is_on: bool) -> None:
        raise NotImplementedError("this receiver sends all channels or none")

    def set_motion(self, motion: Motion) -> None:
        self.imu.motion = motion

    def set_a7(self, volts: float) -> None:
        """Ignore the voltage: SITL measures none."""

    def pulses_us(self) -> Pulses:
        return self._pulses

    def pulse_ages_us(self) -> tuple[float, float, float, float]:
        age_us = self._now_us - self._pulse_us
        return age_us, age_us, age_us, age_us

    def read(self) -> bytes:
        return b""

    def write(self, data: bytes) -> None:
        """Drop the data: the line of this board is its TCP port."""

    def reset(self, cause: ResetCause) -> None:
        self._end()
        self._start()

    def close(self) -> None:
        self._end()
        self._socket.close()
        shutil.rmtree(self._folder, ignore_errors=True)

    def _configure(self) -> None:
        """Let it save the settings, which ends it."""
        command = [self._program, "--config", str(SETTINGS)]
        try:
            subprocess.run(
                command, cwd=self._folder, timeout=SETTINGS_LIMIT_S, capture_output=True, check=True
            )
        except subprocess.SubprocessError as error:
            text = f"{self._program} does not take the settings of {SETTINGS.name}: {error}"
            raise BoardUnavailableError(text) from error
        except OSError as error:
            raise BoardUnavailableError(
                f"{self._program} cannot be executed: {error.strerror}; is it built for this"
                " computer?"
            ) from error

    def _start(self) -> None:
        """Start it until it sends pulses: on a busy computer its control loop may never run."""
        for _ in range(TRIES):
            self._pulses, self._pulse_us = NEUTRAL_US, -math.inf
            self._first = self._flight.state
            self._child = child = Child(
                "betaflight", [self._program], self._folder, work_folder=self._folder
            )
            deadline_s = time.monotonic() + TRY_S
            while time.monotonic() < deadline_s and child.poll() is None:
                self.run_us(0.0)
                if self._pulse_us >= 0.0:
                    return
                time.sleep(POLL_S)
            self._end()
        raise BoardUnavailableError(f"{self._program} sends no pulses; its log: {child.tail()}")

    def _end(self) -> None:
        if self._child is not None:
            self._child.end()
            self._child = None
