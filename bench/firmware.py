"""The compiled firmware on the bench rig: latency, jitter, loop, interrupts, memory, size."""

from __future__ import annotations

import math
import random
import statistics
import struct
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from bench.table import LeftOutError, Row
from up_rig import CYCLES_PER_US, FirmwareError, Rig, RigUnavailableError
from up_rig.build import BuildError, build_firmware
from up_rig.imu import motion_at
from up_simulator.firmware.line_monitor import LineMonitor
from up_simulator.firmware.wire import COMMAND_SIZES, checked_frame

SERVOS = ("ailerons", "elevator", "throttle", "rudder")
FRAME_US = 20_000.0
SETTLE_US = 3_000_000.0
ARMING_US = 500_000.0
CHUNK_US = 5_000.0
OUTPUT_MATCH_US = 30_000.0
RAM_START = 0x100
BYTES_A_SECOND = 11_520
"""Bytes per second of the line in each direction at 115200 baud, 8N1."""
QUEUED_BYTES = 2 * round(BYTES_A_SECOND * CHUNK_US / 1e6)
"""More than the line takes in a chunk, so that it never waits for the next Command."""
BUSY = "vmGc"
"""The veto that the Raspberry Pi repeats, and every request."""
FULL = "c"
"""The request with the longest answer; an answer waits for room for the longest."""
SECOND_US = 1_000_000.0
BURST_US, LULL_US = 800_000.0, 2_300_000.0
"""The board reports the lateness of the last whole second for a second."""
BURSTS, QUICK_BURSTS = 2, 1

LATENCY_MS, LATENCY_SD_US = 8.0, 1.0
JITTER_SD_US, ERROR_RMS_US = 0.1, 1.5
LOOP_US, LATE_US = 2000, 100
FLASH_BYTES, RAM_BYTES = 27_000, 1_400


@dataclass(frozen=True, slots=True)
class Following:
    """How the servo pulses of a channel follow the receiver's: latencies (us), errors (us)."""

    latency_us: tuple[float, ...]
    error_us: tuple[float, ...]


class Flight:
    """The firmware in the rig with a receiver, a moving IMU and, with ``mix``, a full line.

    ``mix`` holds the types of the Commands, drawn at random and sent without a pause while the
    firmware streams; every input then moves in each frame, all pulses starting together.
    """

    def __init__(self, elf: Path, *, mix: str = "", aux1_us: float, seed: int = 1) -> None:
        self.rig = Rig(elf, seed=seed)
        self.rig.mark_stack()
        self._random = random.Random(seed)
        self._sequence = 0
        self.tap = LineMonitor()
        self.mix = ""
        self.late_us = self.period_us = 0
        self.bytes_to_board = self.bytes_from_board = 0
        self.moving: set[str] = set()
        receiver = self.rig.receiver
        receiver.period_us = FRAME_US
        receiver.is_simultaneous = bool(mix)
        receiver.sticks(aux1=aux1_us, aux2=1000)
        receiver.start()
        self.rig.imu.noise_deg_s, self.rig.imu.noise_m_s2 = 0.1, 0.05
        self.rig.imu.motion = motion_at(0, 0)
        self.run(SETTLE_US)
        # Armed, so that the throttle follows its stick, too.
        receiver.sticks(aux2=2000)
        self.run(ARMING_US)
        self.rig.imu.motion = lambda time_s: motion_at(
            30 * math.sin(time_s), 10 * math.sin(1.7 * time_s), (30 * math.cos(time_s), 15, 5)
        )
        self.send("s")
        self.mix = mix
        self.run(LULL_US)
        receiver.sent.clear()
        self.rig.servo.clear()
        self.rig.clear_measures()
        self.late_us = self.bytes_to_board = self.bytes_from_board = 0

    def send(self, letter: str) -> None:
        """Send one Command, with a payload that the firmware executes if possible."""
        payload = bytes(COMMAND_SIZES[letter])
        if letter == "u":
            newest = self.tap.orientation.sequence if self.tap.orientation else 0
            payload = struct.pack(">5H", 1500, 1500, 0, 1500, newest)
        elif letter in "SR":
            payload = struct.pack(">3h2H", 1000, 200, 0, 0, 250)
        elif letter == "M":
            payload = self._random.choice((b"f", b"r"))
        elif letter == "p":
            payload = struct.pack(">Bh", 0, 10)
        frame = checked_frame(self._sequence, letter, payload)
        self.rig.serial.write(frame)
        self.bytes_to_board += len(frame)
        self._sequence = (self._sequence + 1) % 256

    def run(self, duration_us: float) -> None:
        """Run, moving the inputs, filling the line and reading the board's messages."""
        end_us = self.rig.now_us + duration_us
        while self.rig.now_us < end_us:
            for channel in sorted(self.moving):
                self.rig.receiver.set(channel, self._random.randint(2200, 3800) / 2)
            while self.mix and self.rig.serial.waiting < QUEUED_BYTES:
                self.send(self._random.choice(self.mix))
            self.rig.run_us(min(CHUNK_US, end_us - self.rig.now_us))
            data = self.rig.serial.read()
            self.bytes_from_board += len(data)
            messages = self.tap.feed(data, self.rig.now_us / 1e6)
            if self.tap.status is not None and any(each.type == "x" for each in messages):
                self.period_us = max(self.period_us, self.tap.status.loop_us)
                self.late_us = max(self.late_us, self.tap.status.late_us)

    def latest_us(self, mix: str, bursts: int = 1) -> int:
        """Return the greatest lateness of the loop in bursts of Commands that fill the line.

        A line full of requests leaves no room for the status: it is read after each burst.
        """
        self.late_us = self.period_us = 0
        for _ in range(bursts):
            self.mix = mix
            self.run(BURST_US)
            self.mix = ""
            self.run(LULL_US)
        if self.period_us == 0:
            raise RuntimeError("the firmware sent no status")
        return self.late_us

    def following(self, channel: str) -> Following:
        """Match each servo pulse of a channel with the receiver's pulse that it follows."""
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
        return statistics.pstdev(each.width_us for each in self.rig.servo.pulses(channel))


def _rms(values: Iterable[float]) -> float:
    squares = [value * value for value in values]
    return math.sqrt(sum(squares) / len(squares))


def rows(quick: bool = False) -> Iterable[Row]:
    try:
        elf = build_firmware()
        yield from _size_rows(elf)
        measured_us = 2_000_000.0 if quick else 10_000_000.0
        yield from _input_rows(elf, measured_us)
        yield from _loop_rows(elf, measured_us)
        yield lateness_row(elf, QUICK_BURSTS if quick else BURSTS)
    except RigUnavailableError as error:
        raise LeftOutError(str(error)) from error
    except (FirmwareError, BuildError) as error:
        raise RuntimeError(str(error)) from error


def mixes() -> list[str]:
    """Return each Command alone and among many vetoes, the requests, those for control, and all."""
    among = ["vvvv" + letter for letter in COMMAND_SIZES]
    return [*COMMAND_SIZES, *among, BUSY, "uSvM", "".join(COMMAND_SIZES)]


def lateness_row(elf: Path, bursts: int, chosen: Sequence[str] = ()) -> Row:
    """Return the greatest lateness of the loop under every mix of Commands, in AUTO."""
    flight = Flight(elf, mix="v", aux1_us=2000, seed=4)
    flight.moving = set(SERVOS)
    late_us = {mix: flight.latest_us(mix, bursts) for mix in chosen or mixes()}
    worst = max(late_us, key=lambda mix: late_us[mix])
    return Row(
        f"firmware, loop lateness, worst of {len(late_us)} mixes of Commands on a full line",
        f"{late_us[worst]} us by {worst}",
        target=f"<= {LATE_US} us",
        met=late_us[worst] <= LATE_US,
    )


def _input_rows(elf: Path, measured_us: float) -> Iterable[Row]:
    for mix, condition in (("", "alone"), (FULL, "all inputs moving, line full")):
        flight = Flight(elf, mix=mix, aux1_us=1000)
        flight.moving = set(SERVOS) if mix else {"ailerons"}
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
        if mix:
            fill = (
                100 * size / (BYTES_A_SECOND * measured_us / SECOND_US)
                for size in (flight.bytes_to_board, flight.bytes_from_board)
            )
            use = " / ".join(f"{each:.0f} %" for each in fill)
            yield Row("firmware, serial line in use, to / from the board", use)
            errors = [_rms(flight.following(name).error_us) for name in flight.moving]
            yield Row(
                f"firmware, pass-through error, {condition}",
                f"rms {max(errors):.2f} us",
                target=f"rms <= {ERROR_RMS_US:g} us",
                met=max(errors) <= ERROR_RMS_US,
            )
        steady = Flight(elf, mix=mix, aux1_us=1000, seed=2)
        steady.moving = set(SERVOS) - {"elevator"} if mix else set()
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


def _loop_rows(elf: Path, measured_us: float) -> Iterable[Row]:
    flight = Flight(elf, mix=BUSY, aux1_us=1500, seed=3)
    flight.moving = set(SERVOS)
    bursts, start = flight.rig.imu.samples, flight.rig.cycle
    flight.run(measured_us)
    measures = flight.rig.measures()
    elapsed = flight.rig.cycle - start
    rate_hz = (flight.rig.imu.samples - bursts) / (elapsed / 16e6)
    flight.latest_us(BUSY)
    yield Row(
        "firmware, period of the control loop in FBW, everything busy",
        f"{flight.period_us} us",
        "MultiWii; prototype",
        "1570 to 2800; 960 to 4251 us",
        target=f"{LOOP_US} us",
        met=abs(flight.period_us - LOOP_US) <= 1,
    )
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


def _size_rows(elf: Path) -> Iterable[Row]:
    firmware = Rig(elf).firmware
    flash, ram = firmware.size, firmware.symbols["_end"].address - RAM_START
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
