"""The compiled firmware on the bench rig: latency, jitter, loop, interrupts, memory, size."""

from __future__ import annotations

import math
import random
import statistics
import struct
import subprocess
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from bench.table import Row
from up_rig import CYCLES_PER_US, FirmwareError, Rig, RigUnavailableError
from up_rig.imu import motion_at
from up_simulator.wire import checked_frame, cobs_decode

ARDUINO = Path(__file__).resolve().parents[1] / "arduino"
ELF = ARDUINO / "build" / "raspilot.elf"
SERVOS = ("ailerons", "elevator", "throttle", "rudder")
FRAME_US = 20_000.0
SETTLE_US = 3_000_000.0
ARMING_US = 500_000.0
CHUNK_US = 5_000.0
OUTPUT_MATCH_US = 30_000.0
STATUS_SIZE = 20
RAM_START = 0x100

LATENCY_MS, LATENCY_SD_US = 8.0, 5.0
JITTER_SD_US, ERROR_RMS_US = 0.3, 1.0
LOOP_US, LATE_US = 2000, 100
FLASH_BYTES, RAM_BYTES = 20_000, 1_100


@dataclass(frozen=True, slots=True)
class Following:
    """How the servo pulses of a channel follow the receiver's: latencies (us), errors (us)."""

    latency_us: tuple[float, ...]
    error_us: tuple[float, ...]


class Flight:
    """The firmware in the rig with a receiver, a moving IMU and, if ``is_loud``, a busy line.

    ``is_loud`` moves every input at random in each frame, all pulses starting at once, and sends
    Commands without a pause while the firmware streams.
    """

    def __init__(self, elf: Path, *, is_loud: bool, aux1_us: float, seed: int = 1) -> None:
        self.rig = Rig(elf, seed=seed)
        self.rig.mark_stack()
        self._random = random.Random(seed)
        self._is_loud = is_loud
        self._sequence = 0
        self._heard = b""
        self.status: bytes | None = None
        self.moving: set[str] = set()
        receiver = self.rig.receiver
        receiver.period_us = FRAME_US
        receiver.is_simultaneous = is_loud
        receiver.sticks(aux1=aux1_us, aux2=1000)
        receiver.start()
        self.rig.imu.noise_deg_s, self.rig.imu.noise_m_s2 = 0.1, 0.05
        self.rig.imu.motion = motion_at(0, 0)
        self.run(SETTLE_US)
        # Armed, so that the throttle follows its stick too.
        receiver.sticks(aux2=2000)
        self.run(ARMING_US)
        self.rig.imu.motion = lambda time_s: motion_at(
            30 * math.sin(time_s), 10 * math.sin(1.7 * time_s), (30 * math.cos(time_s), 15, 5)
        )
        self.say("s")
        self.run(1_000_000)
        receiver.sent.clear()
        self.rig.servo.forget()
        self.rig.forget_measures()

    def say(self, letter: str, payload: bytes = b"") -> None:
        """Send one Command."""
        self.rig.serial.write(checked_frame(self._sequence, letter, payload))
        self._sequence = (self._sequence + 1) % 256

    def run(self, duration_us: float) -> None:
        """Run on, moving what is to move and reading what comes."""
        end_us = self.rig.now_us + duration_us
        while self.rig.now_us < end_us:
            for channel in sorted(self.moving):
                self.rig.receiver.set(channel, self._random.randint(2200, 3800) / 2)
            if self._is_loud and self.rig.serial.waiting < 32:
                self.say("v", b"\0")
                self.say("T" if self._random.random() < 0.1 else "m")
            self.rig.run_us(min(CHUNK_US, end_us - self.rig.now_us))
            *pieces, self._heard = (self._heard + self.rig.serial.read()).split(b"\0")
            self._look_for_status(pieces)

    def _look_for_status(self, pieces: Iterable[bytes]) -> None:
        for piece in pieces:
            frame = cobs_decode(piece)
            if frame is not None and frame[1:2] == b"x" and len(frame) == STATUS_SIZE + 4:
                self.status = frame[2:-2]

    def following(self, channel: str) -> Following:
        """Match each servo pulse of a channel with the receiver's pulse that it carries."""
        pulses = [
            (pulse.rise_cycle, pulse.width_cycles) for pulse in self.rig.servo.pulses(channel)
        ]
        latencies, errors = [], []
        for sent in self.rig.receiver.sent:
            if sent.channel != channel:
                continue
            fall = sent.rise_cycle + sent.width_cycles
            after = [each for each in pulses if each[0] >= fall][:1]
            if not after or after[0][0] - fall > OUTPUT_MATCH_US * CYCLES_PER_US:
                continue
            rise, width = after[0]
            latencies.append((rise + width - fall) / CYCLES_PER_US)
            errors.append((width - sent.width_cycles) / CYCLES_PER_US)
        return Following(tuple(latencies), tuple(errors))

    def jitter_us(self, channel: str) -> float:
        """Return the standard deviation of a channel's pulse widths, us."""
        return statistics.pstdev(each.width_us for each in self.rig.servo.pulses(channel))


def _rms(values: Iterable[float]) -> float:
    squares = [value * value for value in values]
    return math.sqrt(sum(squares) / len(squares))


def rows(quick: bool = False) -> Iterable[Row]:
    """Yield the firmware's figures; ``RuntimeError`` says what is missing to measure them."""
    _build()
    try:
        yield from _size_rows()
        measured_us = 2_000_000.0 if quick else 10_000_000.0
        yield from _input_rows(measured_us)
        yield from _loop_rows(measured_us)
    except (FirmwareError, RigUnavailableError) as error:
        raise RuntimeError(str(error)) from error


def _build() -> None:
    try:
        done = subprocess.run(
            ["make", "-C", str(ARDUINO), "build/raspilot.elf"],
            capture_output=True,
            text=True,
            check=False,
        )
    except FileNotFoundError:
        raise RuntimeError("make is not installed") from None
    if done.returncode:
        raise RuntimeError("make -C arduino: " + (done.stderr.strip() or done.stdout.strip()))


def _input_rows(measured_us: float) -> Iterable[Row]:
    for is_loud, condition in ((False, "alone"), (True, "all inputs moving, line busy")):
        flight = Flight(ELF, is_loud=is_loud, aux1_us=1000)
        flight.moving = set(SERVOS) if is_loud else {"ailerons"}
        flight.run(measured_us)
        latencies = {
            name: flight.following(name).latency_us for name in SERVOS if name in flight.moving
        }
        mean_ms = max(statistics.mean(each) for each in latencies.values()) / 1000
        sd_us = max(statistics.pstdev(each) for each in latencies.values())
        yield Row(
            f"firmware, receiver edge to servo edge, {condition}",
            f"{mean_ms:.3f} ms, sd {sd_us:.2f} us",
            "prototype",
            "12.8 ms (3 to 22)",
            target=f"<= {LATENCY_MS:g} ms, sd <= {LATENCY_SD_US:g} us",
            met=mean_ms <= LATENCY_MS and sd_us <= LATENCY_SD_US,
        )
        if is_loud:
            errors = [_rms(flight.following(name).error_us) for name in flight.moving]
            yield Row(
                f"firmware, pass-through error, {condition}",
                f"rms {max(errors):.2f} us",
                target=f"rms <= {ERROR_RMS_US:g} us",
                met=max(errors) <= ERROR_RMS_US,
            )
        steady = Flight(ELF, is_loud=is_loud, aux1_us=1000, seed=2)
        steady.moving = {*SERVOS, "aux1"} - {"elevator", "aux1"} if is_loud else set()
        steady.run(measured_us)
        jitter_us = steady.jitter_us("elevator")
        yield Row(
            f"firmware, servo jitter at constant input, {condition}",
            f"sd {jitter_us:.3f} us",
            "MultiWii; prototype",
            "0.3 to 0.5; 2.3 to 4.9 us",
            target=f"sd <= {JITTER_SD_US:g} us",
            met=jitter_us <= JITTER_SD_US,
        )


def _loop_rows(measured_us: float) -> Iterable[Row]:
    flight = Flight(ELF, is_loud=True, aux1_us=1500, seed=3)
    flight.moving = set(SERVOS)
    bursts, start = flight.rig.imu.samples, flight.rig.cycle
    flight.run(measured_us)
    if flight.status is None:
        raise RuntimeError("the firmware sent no status")
    period_us, late_us = struct.unpack(">2H", flight.status[6:10])
    measures = flight.rig.measures()
    elapsed = flight.rig.cycle - start
    yield Row(
        "firmware, control loop in FBW, everything busy",
        f"{period_us} us, at most {late_us} us late",
        "MultiWii; prototype",
        "1570 to 2800; 960 to 4251 us",
        target=f"{LOOP_US} us, late <= {LATE_US} us",
        met=abs(period_us - LOOP_US) <= 1 and late_us <= LATE_US,
    )
    rate_hz = (flight.rig.imu.transfers and (flight.rig.imu.samples - bursts)) / (elapsed / 16e6)
    yield Row("firmware, IMU samples", f"{rate_hz:.1f} Hz")
    yield Row(
        "firmware, interrupt load, everything busy",
        f"{100 * measures.interrupt_cycles / elapsed:.1f} %",
    )
    yield Row(
        "firmware, longest time with interrupts off",
        f"{measures.longest_off_cycles / CYCLES_PER_US:.1f} us",
    )
    yield Row(
        "firmware, stack at most / RAM never touched",
        f"{measures.stack_bytes} / {flight.rig.untouched_ram()} B",
    )
    yield Row("firmware, bytes lost on the line", f"{flight.rig.serial.overruns}")


def _size_rows() -> Iterable[Row]:
    firmware = Rig(ELF).firmware
    flash = sum(len(part) for _, part in firmware.flash)
    ram = firmware.symbols["_end"].address - RAM_START
    yield Row(
        "firmware, flash",
        f"{flash} B",
        "MultiWii; prototype",
        "12540; 27444 B",
        target=f"<= {FLASH_BYTES} B",
        met=flash <= FLASH_BYTES,
    )
    yield Row(
        "firmware, static RAM, no heap",
        f"{ram} B",
        "MultiWii; prototype",
        "1050; 644 + 762 B",
        target=f"<= {RAM_BYTES} B",
        met=ram <= RAM_BYTES,
    )
