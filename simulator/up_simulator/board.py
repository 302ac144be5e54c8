"""The stand-in for the Arduino: answers Commands and sends its streams, apart from any port."""

from __future__ import annotations

import struct
from collections.abc import Callable
from dataclasses import dataclass

from up_simulator.authority import OUTPUT, Authority
from up_simulator.clock import Clock
from up_simulator.commands import OUTPUT_AGE_S, CommandTable
from up_simulator.flight import Flight
from up_simulator.memory import Gains
from up_simulator.reason import Reason, RefusedError
from up_simulator.receiver import Receiver
from up_simulator.status import StatusMeter, status_payload
from up_simulator.wire import CheckedReader, Command, Odd, ThesisReader, checked_frame

STREAM_S = 0.02
STATUS_S = 0.2
THESIS_STREAM_S = 0.05
HEARD_S = 1.0
REFUSALS_APART_S = 1.0
STREAMED = frozenset("hbBluSv")
THESIS_COMMANDS_TO_SWITCH = 2
THESIS_POINTS_TO_SWITCH = 8
THESIS_POINTS = {"t": 8, "p": 4, "b": 3, "B": 3, "l": 2}
SLACK_S = 1e-6


@dataclass(frozen=True, slots=True)
class OldFirmware:
    """How an old firmware behaves: whether it echoes Commands, and the text it prints at boot."""

    confirms: bool = False
    boot_text: str = ""


class Board:
    """Speaks checked framing as the firmware of this project does, thesis framing as it falls to.

    ``write`` takes bytes for the line. ``tick`` is to be called every few milliseconds; it
    listens to the receiver, moves the servos of ``flight`` and sends what is due. In checked
    framing nothing is streamed before a Start Command; answers always are. With ``old`` it is an
    old firmware, which knows nothing but thesis framing and streams from boot.
    """

    def __init__(
        self,
        flight: Flight,
        receiver: Receiver,
        clock: Clock,
        write: Callable[[bytes], None],
        *,
        has_motor: bool = False,
        old: OldFirmware | None = None,
        say: Callable[[str], None] = lambda _text: None,
    ) -> None:
        self.flight = flight
        self.authority = Authority(receiver, has_motor)
        self.gains = Gains()
        self.is_started = False
        self.is_thesis = old is not None
        self.period_s = STREAM_S
        self._receiver = receiver
        self._clock = clock
        self._write = write
        self._say = say
        self._table = CommandTable(self)
        self._checked = CheckedReader()
        self._thesis = ThesisReader()
        self._thesis_commands = 0
        self._thesis_points = 0
        self._sequence = 0
        self._orientation_sequence = 0
        self._orientation_sent_s: dict[int, float] = {}
        self._refused_s: dict[int, float] = {}
        self._due_s = {"r": 0.0, "i": 0.0, "O": 0.0, "x": 0.0}
        self._heard_s: float | None = None
        self._meter = StatusMeter(clock.seconds())
        self._old = old
        # An old firmware has no arming gate.
        self._was_armed = self.authority.is_armed = old is not None
        self._told_mode = ""

    def opened(self) -> None:
        """Send the one extra zero that ends whatever the other side heard before."""
        if not self.is_thesis:
            self._write(b"\0")
        elif self._old is not None and self._old.boot_text:
            self._write(self._old.boot_text.encode("ascii") + b"\r\n")

    def data_received(self, data: bytes) -> None:
        """Take bytes from the line."""
        now_s = self._clock.seconds()
        self._listen(now_s)
        if self.is_thesis:
            self._hear_thesis(data, now_s)
            return
        for found in self._checked.feed(data, now_s):
            if isinstance(found, Odd):
                self.refuse(found.type, found.sequence, Reason(found.reason), now_s)
                continue
            self._heard_s = now_s
            self._carry_out(found, now_s)
        if not self._checked.valid and not self.authority.is_armed:
            self._look_for_thesis(data, now_s)

    def tick(self) -> None:
        """Listen to the receiver, move the servos, send what is due."""
        now_s = self._clock.seconds()
        self._meter.tick(now_s)
        self._listen(now_s)
        self.flight.set_servos(self.authority.servos(now_s))
        self._checked.expire(now_s)
        if self._thesis.expire(now_s):
            self._thesis_commands = self._thesis_points = 0
            if self.is_thesis:
                self._write(b"!")
        self._tell(now_s)
        if self.is_thesis:
            self._stream_thesis(now_s)
        elif self.is_started:
            self._stream(now_s)

    def send(self, letter: str, payload: bytes = b"") -> None:
        """Send one message in the framing that is spoken."""
        if self.is_thesis:
            self._write(letter.encode("ascii") + payload)
            return
        self._write(checked_frame(self._sequence, letter, payload))
        self._sequence = (self._sequence + 1) % 256

    def refuse(self, type_code: int, sequence: int, reason: Reason, now_s: float) -> None:
        """Send ``!``; for streams and frames that are no Commands at most once a second a type."""
        if chr(type_code) in STREAMED or reason in (Reason.UNKNOWN_TYPE, Reason.WRONG_SIZE):
            if now_s - self._refused_s.get(type_code, -REFUSALS_APART_S) < REFUSALS_APART_S:
                return
            self._refused_s[type_code] = now_s
        self.send("!", bytes((type_code, sequence, reason)))

    def orientation_age_s(self, sequence: int, now_s: float) -> float:
        """Return how long ago the orientation with this sequence was sent."""
        return now_s - self._orientation_sent_s.get(sequence, float("-inf"))

    def _listen(self, now_s: float) -> None:
        if self._receiver.listen(now_s):
            self.authority.on_pulses(now_s)

    def _carry_out(self, command: Command, now_s: float) -> None:
        try:
            answer = self._table.carry_out(command, now_s)
        except RefusedError as refusal:
            self.refuse(ord(command.type), command.sequence, refusal.reason, now_s)
            return
        if answer is not None:
            self.send(*answer)
        elif command.type not in STREAMED:
            self.send("K", bytes((ord(command.type), command.sequence)))

    def _look_for_thesis(self, data: bytes, now_s: float) -> None:
        self._expire_thesis(now_s)
        for found in self._thesis.feed(data, now_s):
            if not isinstance(found, Command) or not self._table.is_in_range(found):
                self._thesis_commands = self._thesis_points = 0
                continue
            self._thesis_commands += 1
            self._thesis_points += THESIS_POINTS.get(found.type, 0)
            if (
                self._thesis_commands >= THESIS_COMMANDS_TO_SWITCH
                and self._thesis_points >= THESIS_POINTS_TO_SWITCH
            ):
                self._say("a run of thesis Commands: thesis framing until reset")
                self.is_thesis = True
                return

    def _expire_thesis(self, now_s: float) -> bool:
        """Drop an unfinished thesis Command, which ends a run of them; true when there was one."""
        if not self._thesis.expire(now_s):
            return False
        self._thesis_commands = self._thesis_points = 0
        return True

    def _hear_thesis(self, data: bytes, now_s: float) -> None:
        for found in self._thesis.feed(data, now_s):
            if isinstance(found, int):
                self._write(b"!" + bytes((found,)))
                continue
            self._heard_s = now_s
            try:
                answer = self._table.carry_out(found, now_s)
            except RefusedError:
                self._write(b"!" + found.type.encode("ascii"))
                continue
            if answer is not None:
                self.send(*answer)
            elif self._old is not None and self._old.confirms:
                self.send(found.type, found.payload)

    def _stream(self, now_s: float) -> None:
        is_consumed = self.authority.mode(now_s) == OUTPUT
        quick_s = min(self.period_s, STREAM_S) if is_consumed else self.period_s
        if self._is_due("i", quick_s, now_s):
            pulses_us = self._receiver.pulses_us
            validity = self.authority.channel_validity(now_s)
            self.send("i", struct.pack(">6HB", *pulses_us, validity))
        if self._is_due("O", quick_s, now_s):
            self._send_orientation(now_s)
        if self._is_due("r", self.period_s, now_s):
            self.send("r", struct.pack(">4H", *self.authority.servos(now_s)))
        if self._is_due("x", STATUS_S, now_s):
            has_heard = self._heard_s is not None and now_s - self._heard_s <= HEARD_S
            link = (self._checked.dropped, self._checked.missing)
            self.send("x", status_payload(self.authority, self._meter, link, has_heard, now_s))

    def _stream_thesis(self, now_s: float) -> None:
        period_s = max(self.period_s, THESIS_STREAM_S)
        if self._is_due("r", period_s, now_s):
            self.send("r", struct.pack(">4H", *self.authority.servos(now_s)))
        if self._is_due("O", period_s, now_s):
            state = self.flight.state
            self.send("o", struct.pack(">3f", state.yaw_deg, state.pitch_deg, state.roll_deg))

    def _send_orientation(self, now_s: float) -> None:
        state = self.flight.state
        angles = (state.yaw_deg, state.pitch_deg, state.roll_deg)
        rates = (state.yaw_rate_deg_s, state.pitch_rate_deg_s, state.roll_rate_deg_s)
        self.send("O", struct.pack(">H6f", self._orientation_sequence, *angles, *rates))
        sent_s = self._orientation_sent_s
        sent_s[self._orientation_sequence] = now_s
        for sequence in [each for each, at_s in sent_s.items() if now_s - at_s > OUTPUT_AGE_S]:
            del sent_s[sequence]
        self._orientation_sequence = (self._orientation_sequence + 1) % 65536

    def _is_due(self, stream: str, period_s: float, now_s: float) -> bool:
        """Return whether a stream's period is over; a late one does not shift the next."""
        due_s = self._due_s[stream]
        if now_s < due_s - SLACK_S:
            # A shorter period holds at once, not after the long one that was waited for.
            self._due_s[stream] = min(due_s, now_s + period_s)
            return False
        self._due_s[stream] = due_s + period_s if now_s < due_s + period_s else now_s + period_s
        return True

    def _tell(self, now_s: float) -> None:
        mode = self.authority.mode(now_s)
        if mode != self._told_mode:
            self._told_mode = mode
            self._say("following the Raspberry Pi" if mode == OUTPUT else "sticks pass through")
        if self.authority.is_armed is not self._was_armed:
            self._was_armed = self.authority.is_armed
            self._say("armed" if self._was_armed else "disarmed")
