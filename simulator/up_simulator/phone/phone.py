"""The stub of the airborne phone: its messages and its answers."""

from __future__ import annotations

import struct
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from up.protocols.general_message import GeneralMessage, MalformedMessage, decode, encode
from up.system.clock import Clock
from up_simulator.aircraft.dynamics import FlightDynamics
from up_simulator.aircraft.flight import FlightState
from up_simulator.aircraft.truth import PERIOD_S as TRUTH_S
from up_simulator.harness.user_log import Log, no_log
from up_simulator.phone.sensors import PhoneSensors

ORIENTATION_S = 0.02
MAX_SPEECH = 200
MAX_DELAY_MS = 10_000
SLACK_S = 1e-6
PANICS = ("up.panic", "load_guard.panic")
ACK, NACK = "up.ack", "up.nack"
Record = Callable[[FlightState], dict[str, Any]]
"""The phone's data for the black box: the data of ``black_box.record``."""
IGNORED = ("up.telemetry.update", "up.system.state", "arduino.pids.values")


@dataclass(slots=True)
class _Stream:
    """One kind of Command that is sent again and again."""

    name: str
    period_s: float
    data: Callable[..., dict[str, Any] | None]
    due_s: float = 0.0


class Phone:
    """Sends the phone's measurements and answers requests, independent of sockets.

    ``send`` takes lines for the General Message link, ``send_orientation`` frames of 24 bytes;
    ``tick`` must be called every few milliseconds. In Panic Mode no stream is quicker than the
    delay that the Raspberry Pi requests. ``record`` returns the phone's black box data, 20 times
    a second: the data of ``black_box.record``. ``identity``, up to 8 hexadecimal digits, begins
    the id of each connection's first message and identifies this phone (protocols 4).
    """

    def __init__(
        self,
        flight: FlightDynamics,
        clock: Clock,
        *,
        seed: int = 1,
        identity: str = "",
        log: Log = no_log,
        record: Record | None = None,
    ) -> None:
        self._flight = flight
        self._clock = clock
        self._log = log
        self._identity = identity or f"{seed & 0xFFFFFFFF:x}"
        self._connections = 0
        self._id: str | None = None
        self.send: Callable[[bytes], None] | None = None
        self.send_orientation: Callable[[bytes], None] | None = None
        self.panic_s = 0.0
        self.sensors = sensors = PhoneSensors(seed)
        self._streams = [
            _Stream("up.location.update", 0.1, sensors.location),
            _Stream("up.altitude.change", 0.2, sensors.altitude),
            _Stream("up.heading.change", 0.2, sensors.heading),
            _Stream("android.battery", 10.0, sensors.battery),
        ]
        if record is not None:
            self._streams.append(_Stream("black_box.record", TRUTH_S, record))
        self._orientation_due_s = 0.0

    def set_battery(self, percent: float) -> None:
        self.sensors.battery_percent = percent
        self.sensors.battery_time_s = self._flight.state.time_s
        for stream in self._streams:
            if stream.name == "android.battery":
                stream.due_s = 0.0

    def connected(self, send: Callable[[bytes], None]) -> None:
        """Start to send on a new link: everything immediately, then each in its period."""
        self.send = send
        self._connections += 1
        self._id = f"{self._identity}.{self._connections}"
        for stream in self._streams:
            stream.due_s = 0.0

    def disconnected(self) -> None:
        """Stop sending; the end of a link ends Panic Mode."""
        self.send = None
        self.panic_s = 0.0

    def tick(self) -> None:
        now_s = self._clock.seconds()
        if self.send is not None:
            for stream in self._streams:
                period_s = max(stream.period_s, self.panic_s)
                if now_s >= stream.due_s - SLACK_S:
                    stream.due_s = _next(stream.due_s, period_s, now_s)
                    data = stream.data(self._flight.state)
                    if data is not None:
                        id_, self._id = self._id, None
                        self.send(encode(stream.name, data, id_))
        if self.send_orientation is not None and now_s >= self._orientation_due_s - SLACK_S:
            period_s = max(ORIENTATION_S, self.panic_s)
            self._orientation_due_s = _next(self._orientation_due_s, period_s, now_s)
            self.send_orientation(write_orientation(self._flight.state))

    def line_received(self, line: bytes) -> None:
        if not line.strip():
            return
        try:
            message = decode(line)
        except MalformedMessage as error:
            self._log(f"malformed line dropped: {error}", code="phone_malformed_line")
            return
        if message.name == "android.speak":
            self._speak(message)
        elif message.name in PANICS:
            self._panic(message)
        elif message.name == NACK:
            reason = message.data.get("reason")
            text = f"refused ({message.data.get('code')}): {reason}"
            self._log(text, code="phone_refused", refusal=message.data.get("code"), reason=reason)
        elif message.name != ACK and message.name not in IGNORED:
            self._answer(message, "unknown", f"unknown Command {message.name[:64]}")

    def _speak(self, message: GeneralMessage) -> None:
        text = message.data.get("text")
        if not isinstance(text, str) or not 1 <= len(text) <= MAX_SPEECH:
            self._answer(message, "invalid", f"text: 1 to {MAX_SPEECH} characters")
            return
        self._log(f"says: {text!r}", code="phone_speech", speech=text)
        self._answer(message)

    def _panic(self, message: GeneralMessage) -> None:
        panic: Any = message.data.get("panic")
        delay_ms: Any = message.data.get("delay_ms")
        is_delay = type(delay_ms) in (int, float)
        if not isinstance(panic, bool) or not is_delay or not 0 <= delay_ms <= MAX_DELAY_MS:
            self._answer(message, "invalid", f"panic: bool, delay_ms: 0 to {MAX_DELAY_MS}")
            return
        self.panic_s = delay_ms / 1000 if panic else 0.0
        text = f"panic mode: periods of at least {delay_ms:g} ms" if panic else "panic mode is over"
        self._log(text, code="phone_panic", panic=panic, delay_ms=delay_ms)
        self._answer(message)

    def _answer(self, message: GeneralMessage, code: str = "", reason: str = "") -> None:
        """Answer a message that has an id: by an ack, or by a nack when there is a code."""
        if message.id is None or self.send is None:
            return
        data = {"id": message.id}
        if code:
            data |= {"code": code, "reason": reason}
        name = NACK if code else ACK
        self.send(encode(name, data))


def write_orientation(state: FlightState) -> bytes:
    """Return the 24 bytes of an Orientation Forward frame (protocols 3)."""
    angles = (state.roll_deg, state.pitch_deg, state.yaw_deg)
    rates = (state.roll_rate_deg_s, state.pitch_rate_deg_s, state.yaw_rate_deg_s)
    return struct.pack(">6f", *angles, *rates)


def _next(due_s: float, period_s: float, now_s: float) -> float:
    """Return when a stream is due again; a late one does not shift those after it."""
    return due_s + period_s if now_s < due_s + period_s else now_s + period_s
