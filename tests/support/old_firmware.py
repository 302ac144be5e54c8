"""The thesis's firmware on a pty, as a separate program: its input, its echoes, its stream."""

import argparse
import struct
import time
from pathlib import Path

from up.protocols.frame import UNFINISHED_TIMEOUT_S
from up_rig.pty_line import PtyLine
from up_simulator.firmware.wire import Command

THESIS_SIZES = {"p": 3, "t": 48, "T": 0, "h": 2, "b": 2, "B": 2, "l": 8}
STREAM_S = 0.05


class ThesisReader:
    """Finds bare Commands in a stream (thesis 3.1.2); unknown type bytes are dropped alone."""

    def __init__(self):
        self._buffer = b""
        self._first_s = 0.0

    def feed(self, data, now_s):
        if now_s - self._first_s >= UNFINISHED_TIMEOUT_S:
            self._buffer = b""
        for byte in data:
            if not self._buffer and chr(byte) not in THESIS_SIZES:
                continue
            if not self._buffer:
                self._first_s = now_s
            self._buffer += bytes([byte])
            letter = chr(self._buffer[0])
            if len(self._buffer) == 1 + THESIS_SIZES[letter]:
                payload, self._buffer = self._buffer[1:], b""
                yield Command(letter, payload)


def run(link, boot_text):
    """Print the text, echo Commands and stream servo pulses and an orientation, without an end."""
    line, reader, gains, due_s = PtyLine(link), ThesisReader(), bytes(48), 0.0
    line.returned = lambda: line.write(boot_text.encode() + b"\r\n")
    line.returned()
    while True:
        for command in reader.feed(line.read(0.01, 4096), time.monotonic()):
            if command.type == "t":
                gains = command.payload
            answer = gains if command.type == "T" else command.payload
            line.write(command.type.encode() + answer)
        if time.monotonic() >= due_s:
            due_s = time.monotonic() + STREAM_S
            line.write(b"r" + struct.pack(">4H", 1500, 1500, 1000, 1500))
            line.write(b"o" + struct.pack(">3f", 10.5, -5.5, 3.25))


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--pty-link", type=Path)
    parser.add_argument("--boot-text", default="")
    options = parser.parse_args()
    run(options.pty_link, options.boot_text)
