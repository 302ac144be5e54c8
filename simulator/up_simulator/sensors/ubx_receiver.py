"""A u-blox receiver aboard (u-blox M10 SPG 5.10 and M8 interface descriptions)."""

from __future__ import annotations

import math
import struct
from collections.abc import Iterator
from typing import Any, Protocol

from up_simulator.aircraft.flight import FlightState
from up_simulator.phone.sensors import GpsState, PhoneSensors

SYNC = b"\xb5b"
NAV_PVT, ACK, NAK = (0x01, 0x07), (0x05, 0x01), (0x05, 0x00)
VALSET, RATE, MESSAGE, PORT = (6, 0x8A), (6, 0x08), (6, 0x01), (6, 0x00)
RATE_KEY, SPEED_KEY, UART_PVT_KEY = 0x30210001, 0x40520001, 0x20910007
_KEY_BYTES = {1: 1, 2: 1, 3: 2, 4: 4, 5: 8}
_PVT = struct.Struct("<IHBBBBBBIiBBBBiiiiIIiiiiiIIHH4xihH")
FIX_3D, FIX_OK = 3, 1
UNKNOWN_MM, UNKNOWN_PDOP = 2**32 - 1, 9999
WANDER_M, NOISE = 0.7, 0.1
"""The slow error of a good receiver, and its noise as a part of a phone's."""
DELAY_S = 0.1
WEEK_S = 604800.0
START_OF_WEEK_S = 123456.0
READ_BYTES = 512


class Line(Protocol):
    """The board's end of a serial line."""

    def read(self, timeout_s: float, max_bytes: int, /) -> bytes:
        """Return what has arrived."""

    def write(self, data: bytes) -> None:
        """Send bytes; without a reader they are dropped."""


class UbxReceiver:
    """Sends NAV-PVT after it was set up, with a delay of 0.1 s; before it is silent.

    Generation 10 takes VALSET and refuses what generation 8 takes, which refuses VALSET. A message
    that is not at ``baud_rate`` is not for it: its owner drops those. For ``cold_s`` of the flight
    it has no fix. ``is_exact``: without any error.
    """

    def __init__(
        self, seed: int = 1, *, generation: int = 10, cold_s: float = 0.0, is_exact: bool = False
    ) -> None:
        self.baud_rate = 38400 if generation >= 9 else 9600
        self.is_set_up = False
        self.period_s = 1.0
        self._generation = generation
        self._cold_s = cold_s
        self._errors = (0.0, 0.0) if is_exact else (WANDER_M, NOISE)
        self._gps = PhoneSensors(seed)
        self._use_period()
        self._due_s = -math.inf
        self._input = bytearray()

    @property
    def wander_m(self) -> tuple[float, float, float]:
        """Return the slow error of the fixes now: north, east, up."""
        return self._gps.wander_m

    def set_state(self, state: GpsState) -> None:
        self._gps.gps = state

    def feed(self, data: bytes) -> bytes:
        """Take bytes of the host; return the answers."""
        self._input += data
        return b"".join(self._answer(*message) for message in _messages(self._input))

    def poll(self, state: FlightState) -> bytes:
        if not self.is_set_up:
            return b""
        data = self._gps.location(state)
        if data is not None and state.time_s >= self._cold_s:
            self._due_s = state.time_s + 2 * self.period_s
            return frame(NAV_PVT, _pvt(data, state))
        if state.time_s < self._due_s:
            return b""
        self._due_s = state.time_s + self.period_s
        return frame(NAV_PVT, _pvt(None, state))

    def exchange(self, line: Line, state: FlightState) -> None:
        """Pass the bytes of both directions at this moment of the flight."""
        said = self.feed(line.read(0.0, READ_BYTES)) + self.poll(state)
        if said:
            line.write(said)

    def _use_period(self) -> None:
        wander_m, noise = self._errors
        self._gps.use_receiver(self.period_s, DELAY_S, wander_m, noise)

    def _answer(self, kind: tuple[int, int], payload: bytes) -> bytes:
        is_known = kind == VALSET if self._generation >= 9 else kind != VALSET
        if not is_known:
            return frame(NAK, bytes(kind))
        if kind == VALSET:
            values = dict(_values(payload))
            self._set_period(values.get(RATE_KEY, 0))
            self.baud_rate = values.get(SPEED_KEY, self.baud_rate)
            self.is_set_up |= values.get(UART_PVT_KEY) == 1
        elif kind == RATE:
            self._set_period(int.from_bytes(payload[:2], "little"))
        elif kind == MESSAGE:
            self.is_set_up |= payload[:2] == bytes(NAV_PVT) and payload[3] == 1
        elif kind == PORT:
            self.baud_rate = int.from_bytes(payload[8:12], "little")
        return frame(ACK, bytes(kind))

    def _set_period(self, period_ms: int) -> None:
        if period_ms:
            self.period_s = period_ms / 1000
            self._use_period()


def frame(kind: tuple[int, int], payload: bytes) -> bytes:
    """Return a message with its checksum (8-bit Fletcher)."""
    content = bytes(kind) + len(payload).to_bytes(2, "little") + payload
    a = b = 0
    for each in content:
        a = (a + each) & 0xFF
        b = (b + a) & 0xFF
    return SYNC + content + bytes((a, b))


def _messages(buffer: bytearray) -> Iterator[tuple[tuple[int, int], bytes]]:
    """Take the whole messages from the front of a buffer."""
    while (at := buffer.find(SYNC)) >= 0 and len(buffer) >= at + 8:
        end = at + 8 + int.from_bytes(buffer[at + 4 : at + 6], "little")
        if len(buffer) < end:
            return
        message = bytes(buffer[at:end])
        del buffer[:end]
        kind, payload = (message[2], message[3]), message[6:-2]
        if frame(kind, payload) == message:
            yield kind, payload


def _values(payload: bytes) -> Iterator[tuple[int, int]]:
    at = 4
    while at + 4 < len(payload):
        key = int.from_bytes(payload[at : at + 4], "little")
        end = at + 4 + _KEY_BYTES.get(key >> 28 & 7, 1)
        yield key, int.from_bytes(payload[at + 4 : end], "little")
        at = end


def _pvt(data: dict[str, Any] | None, state: FlightState) -> bytes:
    """Return the payload of NAV-PVT; without data it has no fix."""
    taken_s = state.time_s - (0.0 if data is None else data["age_ms"] / 1000)
    week_ms = round((START_OF_WEEK_S + taken_s) % WEEK_S * 1000)
    day_s, nano = divmod(week_ms % 86_400_000, 1000)
    clock = (2026, 11, 24, day_s // 3600, day_s // 60 % 60, day_s % 60)
    if data is None:
        fix, place, velocity = (0, 0, 0, 0), (0, 0, 0, 0), (0, 0, 0, 0)
        accuracy, course, pdop = (UNKNOWN_MM, UNKNOWN_MM), 0, UNKNOWN_PDOP
    else:
        fix = (FIX_3D, FIX_OK, 0, int(data["satellites"]))
        altitude_mm = round(data["altitude"] * 1000)
        place = (
            round(data["longitude"] * 1e7), round(data["latitude"] * 1e7), altitude_mm, altitude_mm
        )  # fmt: skip
        accuracy = (round(data["accuracy"] * 1000), round(data["accuracy"] * 1500))
        course_rad, speed_mm = math.radians(data["bearing"]), data["speed"] * 1000
        north, east = speed_mm * math.cos(course_rad), speed_mm * math.sin(course_rad)
        velocity = (round(north), round(east), round(-1000 * state.climb_m_s), round(speed_mm))
        course, pdop = round(data["bearing"] * 1e5), 140
    return _PVT.pack(
        week_ms, *clock, 0x07, 50, nano * 1_000_000, *fix, *place, *accuracy, *velocity, course,
        300, 500_000, pdop, 0, 0, 0, 0,
    )  # fmt: skip
