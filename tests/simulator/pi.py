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
