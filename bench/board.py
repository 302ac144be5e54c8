"""The Arduino's end of a pseudo terminal: sends frames at an exact rate and times the answers."""

import gc
import os
import select
import struct
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass

from bench.timing import percentile
from up.protocols.checked_framing import cobs_decode
from up_simulator.firmware.wire import checked_frame

ANSWER_S = 1.0
GENERATOR_PRIORITY = 40
STICKS = struct.pack(">6HB", 1500, 1500, 1300, 1500, 2000, 2000, 0x3F)
SERVOS = struct.pack(">4H", 1500, 1500, 1300, 1500)
# Version 1, mode OUTPUT, switch high, flags: AUTO, receiver, IMU, Raspberry Pi connected.
STATUS = struct.pack(">BcBBBBHHHHHHH", 1, b"u", 2, 0x8E, 0, 1, 2000, 0, 0, 0, 1, 0, 0)
STREAMS = (("x", STATUS, 0.2), ("i", STICKS, 0.02), ("r", SERVOS, 0.02))
# Position of the orientation's sequence in a frame: in our Output, in the floor's echo.
_NUMBER_AT = {ord("u"): 10, ord("O"): 2}


@dataclass(frozen=True, slots=True)
class Latency:
    """Microseconds from writing an orientation frame to reading the Output computed from it."""

    sent: int
    lost: int
    p50_us: float
    p99_us: float
    p999_us: float


@contextmanager
def terminal() -> Iterator[tuple[int, str]]:
    """Yield a raw pseudo terminal: the board's descriptor, and the path that others open."""
    board, other = os.openpty()
    try:
        os.set_blocking(board, False)
        yield board, os.ttyname(other)
    finally:
        os.close(board)
        os.close(other)


class Board:
    """Writes an Arduino's frames at a rate, and finds the Outputs in the answers."""

    def __init__(self, descriptor: int) -> None:
        self._descriptor = descriptor
        self._sequence = 0
        self._orientations = 0
        self._tail = b""
        self._poll = select.poll()
        self._poll.register(descriptor, select.POLLIN)

    def measure(self, rate_hz: float, seconds: float) -> Latency:
        with _first_in_line():
            return self._measure(rate_hz, seconds)

    def wait_for_answer(self, deadline_s: float) -> None:
        """Play the board, slowly, until a program answers orientation; raises RuntimeError."""
        end_s = time.monotonic() + deadline_s
        while time.monotonic() < end_s:
            if self._measure(50, 0.2, wait_s=0.1).lost == 0:
                return
        raise RuntimeError("no answer on the serial line")

    def _measure(self, rate_hz: float, seconds: float, wait_s: float = ANSWER_S) -> Latency:
        # Frames are built before and parsed after: in between are only clock, read and write.
        bursts = self._bursts(rate_hz, int(rate_hz * seconds))
        sent_ns = [0] * len(bursts)
        heard: list[tuple[int, bytes]] = []
        step_ns = int(1e9 / rate_hz)
        clock = time.perf_counter_ns
        due_ns = clock()
        for index, burst in enumerate(bursts):
            while (left_ns := due_ns - clock()) > 0:
                self._hear(left_ns / 1e9, heard)
            due_ns += step_ns
            sent_ns[index] = clock()
            with suppress(BlockingIOError):  # no reader: it counts as lost
                os.write(self._descriptor, burst)
        last_ns = clock() + int(wait_s * 1e9)
        while (left_ns := last_ns - clock()) > 0:
            self._hear(left_ns / 1e9, heard)
        first = self._orientations - len(bursts) + 1
        begins_ns = {(first + index) % 65536: at_ns for index, at_ns in enumerate(sent_ns)}
        trips_us = sorted(self._trips_us(begins_ns, heard))
        figures = (percentile(trips_us, share) for share in (0.5, 0.99, 0.999))
        return Latency(len(bursts), len(begins_ns), *figures)

    def _hear(self, wait_s: float, heard: list[tuple[int, bytes]]) -> None:
        # poll() counts whole milliseconds and would come late: select takes fractions.
        ready, _, _ = select.select((self._descriptor,), (), (), wait_s)
        if not ready:
            return
        data = os.read(self._descriptor, 4096)
        heard.append((time.perf_counter_ns(), data))

    def _trips_us(
        self, begins_ns: dict[int, int], heard: list[tuple[int, bytes]]
    ) -> Iterator[float]:
        """Yield the duration of each answer; what remains in ``begins_ns`` had none."""
        for at_ns, data in heard:
            *pieces, self._tail = (self._tail + data).split(b"\0")
            for piece in pieces:
                plain = cobs_decode(piece) or b""
                if len(plain) < 4 or plain[1] not in _NUMBER_AT:
                    continue
                place = _NUMBER_AT[plain[1]]
                began_ns = begins_ns.pop(int.from_bytes(plain[place : place + 2], "big"), None)
                if began_ns is not None:
                    yield (at_ns - began_ns) / 1000

    def _bursts(self, rate_hz: float, count: int) -> list[bytes]:
        """Return the bytes to write in each step: orientation always, the rest when it is due."""
        bursts = []
        due = {"x": 0.0, "i": 0.0, "r": 0.0}
        for index in range(count):
            frames = b""
            for letter, payload, every_s in STREAMS:
                if index / rate_hz >= due[letter]:
                    due[letter] += every_s
                    frames += self._frame(letter, payload)
            bursts.append(frames + self._orientation())
        return bursts

    def _orientation(self) -> bytes:
        self._orientations = (self._orientations + 1) % 65536
        angle = self._orientations % 40 - 20.0
        payload = struct.pack(">H6f", self._orientations, 10.0, angle / 4, angle, 1.0, 2.0, 3.0)
        return self._frame("O", payload)

    def _frame(self, letter: str, payload: bytes) -> bytes:
        self._sequence = (self._sequence + 1) % 256
        return checked_frame(self._sequence, letter, payload)


@contextmanager
def _first_in_line() -> Iterator[None]:
    """Run with real-time priority, if permitted, and without garbage collection."""
    before = os.sched_getscheduler(0), os.sched_getparam(0)
    with suppress(PermissionError):
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(GENERATOR_PRIORITY))
    gc.collect()
    gc.disable()
    try:
        yield
    finally:
        gc.enable()
        os.sched_setscheduler(0, *before)
