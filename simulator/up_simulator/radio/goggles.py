"""Goggles at the Raspberry Pi: what their video transmitter shows, decoded from the format alone.

MSP DisplayPort as Betaflight documents it: message 182, whose first byte is the operation.
"""

from __future__ import annotations

import re
from functools import reduce
from operator import xor

from up_simulator.sensors.ubx_receiver import Line

REPLY, REFUSAL, DISPLAYPORT = b"$M>", b"$M!", 182
HEARTBEAT, RELEASE, CLEAR, WRITE, DRAW = range(5)
OVERHEAD = 6
MAX_TEXT = 30
FONT = range(0x20, 0x60)
READ_BYTES = 512
MODE_ROW, WARNING_ROW = 1, -5
"""Of the mode and the warnings in the shipped osd.yml."""


class Goggles:
    """``shown`` are the rows since the last DRAW, ``operations`` the received codes.

    ``answers`` has head, number and payload of everything else. ``errors`` counts what no goggles
    understand: noise, wrong checksums, text outside the grid or the font.
    """

    def __init__(self, columns: int, rows: int) -> None:
        self.columns, self.rows = columns, rows
        self.answers: list[tuple[bytes, int, bytes]] = []
        self.operations: list[int] = []
        self.errors = self.received = 0
        self._unread = b""
        self._cells: dict[tuple[int, int], str] = {}
        self.shown = self._rows()

    def exchange(self, line: Line) -> None:
        self.feed(line.read(0.0, READ_BYTES))

    def feed(self, data: bytes) -> None:
        self.received += len(data)
        self._unread += data
        while len(self._unread) >= OVERHEAD:
            head, size, number = self._unread[:3], self._unread[3], self._unread[4]
            if head not in (REPLY, REFUSAL):
                self.errors += 1
                self._unread = self._unread[1:]
                continue
            if len(self._unread) < OVERHEAD + size:
                return
            body, check = self._unread[3 : 5 + size], self._unread[5 + size]
            self._unread = self._unread[OVERHEAD + size :]
            if reduce(xor, body) != check:
                self.errors += 1
            elif (head, number) == (REPLY, DISPLAYPORT) and size:
                self._on_operation(body[2], body[3:])
            else:
                self.answers.append((head[2:], number, body[2:]))

    def row(self, number: int) -> str:
        return self.shown[number].rstrip()

    @property
    def mode(self) -> str:
        return self._found(r" *(\S+)", self.shown[MODE_ROW])

    @property
    def warning(self) -> str:
        return self.shown[WARNING_ROW].strip()

    @property
    def satellites(self) -> str:
        return self._found(r".*\bSAT (\S+)", *self.shown)

    @property
    def altitude_m(self) -> float | None:
        """Return the shown height above home; None: dashes."""
        text = self._found(r".*\bALT (-?\d+)M", *self.shown)
        return float(text) if text else None

    @staticmethod
    def _found(pattern: str, *rows: str) -> str:
        found = (re.match(pattern, row) for row in rows)
        return next((each[1] for each in found if each), "")

    def _on_operation(self, code: int, rest: bytes) -> None:
        self.operations.append(code)
        if code == CLEAR:
            self._cells.clear()
        elif code == WRITE:
            self._write(rest)
        elif code == DRAW:
            self.shown = self._rows()
        elif code not in (HEARTBEAT, RELEASE):
            self.errors += 1

    def _write(self, rest: bytes) -> None:
        place, text = rest[:3], rest[3:]
        row, column, attribute = place if len(place) == 3 else (self.rows, 0, 0)
        fits = row < self.rows and column + len(text) <= self.columns and attribute == 0
        if not (fits and 0 < len(text) <= MAX_TEXT and all(each in FONT for each in text)):
            self.errors += 1
            return
        for at, each in enumerate(text, column):
            self._cells[row, at] = chr(each)

    def _rows(self) -> list[str]:
        places = [[(row, column) for column in range(self.columns)] for row in range(self.rows)]
        return ["".join(self._cells.get(each, " ") for each in row) for row in places]
