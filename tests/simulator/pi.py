"""The Raspberry Pi's end of the wire for the tests: a second reading of docs/protocols.md."""

import binascii
import json
import struct
from dataclasses import dataclass, field
from pathlib import Path

VECTORS = Path(__file__).parents[1] / "vectors"


def vectors(name):
    return json.loads((VECTORS / name).read_text("utf-8"))["vectors"]


@dataclass
class Message:
    type: str
    payload: bytes
    sequence: int = 0


def frame(sequence, letter, payload=b""):
    """One checked frame, COBS done by walking from zero to zero."""
    body = bytes([sequence]) + letter.encode() + payload
    body += struct.pack(">H", binascii.crc_hqx(body, 0xFFFF))
    out = bytearray()
    rest = body + b"\0"
    while rest:
        zero = rest.index(0)
        assert zero < 254
        out += bytes([zero + 1]) + rest[:zero]
        rest = rest[zero + 1 :]
    return bytes(out) + b"\0"


@dataclass
class Listener:
    """Collects the frames of the board; every frame must be whole and in sequence."""

    buffer: bytes = b""
    messages: list = field(default_factory=list)

    def feed(self, data):
        *lines, self.buffer = (self.buffer + data).split(b"\0")
        for line in filter(None, lines):
            body, at = b"", 0
            while at < len(line):
                body += line[at + 1 : at + line[at]] + b"\0"
                at += line[at]
            body = body[:-1]
            assert binascii.crc_hqx(body, 0xFFFF) == 0, line.hex()
            self.messages.append(Message(chr(body[1]), body[2:-2], body[0]))

    def take(self, letters=None):
        """Return the messages since the last call, of these types only."""
        taken, self.messages = self.messages, []
        return [each for each in taken if letters is None or each.type in letters]


def pulses_for(state, gains, target=(0.0, 0.0)):
    """The cascade of the daemon, proportional only: degrees to deg/s to 1.25 us.

    ``gains`` is (stabilize, rate) for roll and pitch and the rate gain of the rudder.
    """
    (roll_stab, roll_rate), (pitch_stab, pitch_rate), yaw_rate = gains
    roll, pitch, rates = state
    asked = (roll_stab * (target[0] - roll), pitch_stab * (target[1] - pitch), 0.0)
    units = [
        gain * (want - rate)
        for gain, want, rate in zip((roll_rate, pitch_rate, yaw_rate), asked, rates, strict=True)
    ]
    ailerons, elevator, rudder = (max(1000, min(2000, round(1500 + 1.25 * u))) for u in units)
    return ailerons, elevator, rudder


GAINS = ((8.0, 6.0), (6.0, 3.0), 1.0)
