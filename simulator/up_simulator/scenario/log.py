"""The log of a flight: one row every 20 ms, one column for every signal, as CSV on the disk."""

from __future__ import annotations

import csv
import io
import math
import sys
from array import array
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TextIO

from up_simulator.scenario.signals import EVENT_COLUMN, Kind, signal_of

ROW_S = 0.02
DIGITS = 6
Value = float | str
"""A number (a flag is 1.0 or 0.0, not a number is not known) or a word (empty: not known)."""


class LogError(Exception):
    """A file is not a flight's log: the message is one sentence with file and line."""


class FlightLog:
    """The value of every signal at every row; ``columns`` begin with time_s and end with event.

    A number is rounded to six decimals when it is taken, so that a log read from the disk equals
    the one that was written.
    """

    def __init__(self, columns: Sequence[str]) -> None:
        self.columns = tuple(columns)
        self._numbers: dict[str, array[float]] = {}
        self._words: dict[str, list[str]] = {}
        self._count = 0
        for name in self.columns:
            if is_word(name):
                self._words[name] = []
            else:
                self._numbers[name] = array("d")

    def __len__(self) -> int:
        """Return the number of rows."""
        return self._count

    def __contains__(self, column: object) -> bool:
        """Return whether there is a column of that name."""
        return column in self._numbers or column in self._words

    def append(self, values: Mapping[str, float | bool | str | None]) -> None:
        """Take a row; signals missing in it are unknown."""
        for name, words in self._words.items():
            value = values.get(name)
            words.append("" if value is None else sys.intern(str(value)))
        for name, numbers in self._numbers.items():
            value = values.get(name)
            is_number = isinstance(value, bool | int | float)
            numbers.append(_rounded(float(value)) if is_number else math.nan)  # type: ignore[arg-type]
        self._count += 1

    @property
    def rows(self) -> Iterator[tuple[Value, ...]]:
        """Yield every row, its values in the order of the columns."""
        return zip(*(self._values(name) for name in self.columns), strict=True)

    def column(self, name: str) -> list[Value]:
        """Return all values of a column; raises KeyError."""
        return list(self._values(name))

    def _values(self, name: str) -> Sequence[Value]:
        words = self._words.get(name)
        return self._numbers[name] if words is None else words

    def numbers(self, name: str) -> list[float]:
        """Return a column of numbers; raises KeyError, and TypeError for a column of words."""
        if name in self._words:
            raise TypeError(f"{name} holds words")
        return list(self._numbers[name])

    def has_words(self, name: str) -> bool:
        """Return whether a column holds words."""
        return name in self._words

    @property
    def events(self) -> list[tuple[float, str]]:
        """Return time and name of everything that happened."""
        if EVENT_COLUMN not in self:
            return []
        found: list[tuple[float, str]] = []
        for time_s, cell in zip(self.numbers("time_s"), self.column(EVENT_COLUMN), strict=True):
            found += [(time_s, name) for name in str(cell).split(EVENT_SEPARATOR) if name]
        return found

    def text(self) -> str:
        """Return the log as CSV."""
        into = io.StringIO()
        self._write(into)
        return into.getvalue()

    def write(self, path: Path) -> None:
        """Write the CSV file; raises OSError."""
        with path.open("w", encoding="utf-8", newline="") as file:
            self._write(file)

    def _write(self, into: TextIO) -> None:
        writer = csv.writer(into, lineterminator="\n")
        writer.writerow(self.columns)
        writer.writerows([_cell(value) for value in row] for row in self.rows)


EVENT_SEPARATOR = "; "


def is_word(name: str) -> bool:
    """Return whether a column of that name holds words."""
    if name == EVENT_COLUMN:
        return True
    try:
        return signal_of(name).kind is Kind.WORD
    except KeyError:
        return False


def read_log(path: Path) -> FlightLog:
    """Return the log in a file; raises LogError with one sentence, also for an unreadable file."""
    try:
        with path.open(encoding="utf-8", newline="") as file:
            return _read(path, csv.reader(file))
    except OSError as error:
        raise LogError(f"{path}: cannot be read: {error.strerror or error}") from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise LogError(f"{path}: is no log of a flight: {error}") from error


def _read(path: Path, lines: Iterator[list[str]]) -> FlightLog:
    columns = next(lines, [])
    if not columns or columns[0] != "time_s":
        raise LogError(f"{path}:1: is no log of a flight: its first column is not time_s")
    if len(set(columns)) != len(columns):
        raise LogError(f"{path}:1: has two columns of one name")
    log = FlightLog(columns)
    for line, row in enumerate(lines, 2):
        if len(row) != len(columns):
            what = f"has {len(row)} values, not {len(columns)}"
            raise LogError(f"{path}:{line}: {what}")
        values: dict[str, float | str | None] = {}
        for name, cell in zip(columns, row, strict=True):
            if log.has_words(name):
                values[name] = cell
            else:
                values[name] = _number(path, line, name, cell)
        log.append(values)
    return log


def _number(path: Path, line: int, name: str, cell: str) -> float | None:
    if not cell:
        return None
    try:
        number = float(cell)
    except ValueError:
        raise LogError(f"{path}:{line}: {name} is no number: {cell[:40]!r}") from None
    return number


def _rounded(number: float) -> float:
    # Adding zero makes minus zero plain: one value has one spelling.
    return round(number, DIGITS) + 0.0 if math.isfinite(number) else number


def _cell(value: Value) -> str:
    if isinstance(value, str):
        return value
    if math.isnan(value):
        return ""
    return str(int(value)) if value == int(value) and abs(value) < 1e15 else repr(value)
