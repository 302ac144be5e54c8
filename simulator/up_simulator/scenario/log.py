"""The log of a flight: one row every 20 ms, one column for every signal, as CSV on the disk."""

from __future__ import annotations

import csv
import math
import sys
from array import array
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from up_simulator.scenario.signals import EVENT_COLUMN, Kind, signal_of

ROW_S = 0.02
DIGITS = 6
Value = float | str
"""A number (a flag is 1.0 or 0.0, NaN is unknown) or a text (empty: unknown)."""


class LogError(Exception):
    """A file is not a flight log: the message is one sentence with file and line.

    ``code`` is ``not_readable``, ``not_a_log``, ``duplicate_column``, ``row_length`` or
    ``not_a_number``; a ``line`` of 0 is the whole file.
    """

    def __init__(self, path: Path, line: int, code: str, text: str) -> None:
        super().__init__(f"{path}:{line}: {text}" if line else f"{path}: {text}")
        self.code = code


class FlightLog:
    """The value of every signal at every row; ``columns`` begin with time_s and end with event.

    Numbers are rounded to six decimals, so that a log read from the disk equals the one that was
    written; a column when it is read, because most are never read.
    """

    def __init__(self, columns: Sequence[str]) -> None:
        self.columns = tuple(columns)
        self._numbers: dict[str, array[float]] = {}
        self._texts: dict[str, list[str]] = {}
        self._count = 0
        self._appends: list[tuple[str, Callable[[Any], None]]] = []
        self._rounded: dict[str, int] = {}
        for name in self.columns:
            if is_text(name):
                self._texts[name] = []
            else:
                self._numbers[name] = numbers = array("d")
                self._appends.append((name, numbers.append))

    def __len__(self) -> int:
        return self._count

    def __contains__(self, column: object) -> bool:
        return column in self._numbers or column in self._texts

    def append(self, values: Mapping[str, float | bool | str | None]) -> None:
        for name, texts in self._texts.items():
            value = values.get(name)
            texts.append("" if value is None else sys.intern(str(value)))
        nan = math.nan
        for name, append in self._appends:
            try:
                append(values.get(name, nan))
            except TypeError:
                append(nan)
        self._count += 1

    @property
    def rows(self) -> Iterator[tuple[Value, ...]]:
        return zip(*(self._values(name) for name in self.columns), strict=True)

    def column(self, name: str) -> list[Value]:
        """Return all values of a column; raises KeyError."""
        return list(self._values(name))

    def _values(self, name: str) -> Sequence[Value]:
        texts = self._texts.get(name)
        if texts is not None:
            return texts
        numbers = self._numbers[name]
        for at in range(self._rounded.get(name, 0), len(numbers)):
            numbers[at] = _rounded(numbers[at])
        self._rounded[name] = len(numbers)
        return numbers

    def numbers(self, name: str) -> list[float]:
        """Return a column of numbers; raises KeyError, and TypeError for a column of texts."""
        if name in self._texts:
            raise TypeError(f"{name} holds text")
        return [float(value) for value in self._values(name)]

    def has_text(self, name: str) -> bool:
        return name in self._texts

    @property
    def events(self) -> list[tuple[float, str]]:
        if EVENT_COLUMN not in self:
            return []
        found: list[tuple[float, str]] = []
        for time_s, cell in zip(self.numbers("time_s"), self.column(EVENT_COLUMN), strict=True):
            found += [(time_s, name) for name in str(cell).split(EVENT_SEPARATOR) if name]
        return found

    def write(self, path: Path) -> None:
        with path.open("w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(self.columns)
            writer.writerows([_cell(value) for value in row] for row in self.rows)


EVENT_SEPARATOR = "; "


def is_text(name: str) -> bool:
    """Return whether a column of that name holds text."""
    if name == EVENT_COLUMN:
        return True
    try:
        return signal_of(name).kind is Kind.TEXT
    except KeyError:
        return False


def read_log(path: Path) -> FlightLog:
    """Return the log in a file; raises LogError with one sentence, also for an unreadable file."""
    try:
        with path.open(encoding="utf-8", newline="") as file:
            return _read(path, csv.reader(file))
    except OSError as error:
        text = f"cannot be read: {error.strerror or error}"
        raise LogError(path, 0, "not_readable", text) from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise LogError(path, 0, "not_a_log", f"is not a flight log: {error}") from error


def _read(path: Path, lines: Iterator[list[str]]) -> FlightLog:
    columns = next(lines, [])
    if not columns or columns[0] != "time_s":
        text = "is not a flight log: its first column is not time_s"
        raise LogError(path, 1, "not_a_log", text)
    if len(set(columns)) != len(columns):
        raise LogError(path, 1, "duplicate_column", "has two columns of the same name")
    log = FlightLog(columns)
    for line, row in enumerate(lines, 2):
        if len(row) != len(columns):
            text = f"has {len(row)} values, not {len(columns)}"
            raise LogError(path, line, "row_length", text)
        values: dict[str, float | str | None] = {}
        for name, cell in zip(columns, row, strict=True):
            try:
                values[name] = cell if log.has_text(name) else float(cell) if cell else None
            except ValueError:
                text = f"{name} is not a number: {cell[:40]!r}"
                raise LogError(path, line, "not_a_number", text) from None
        log.append(values)
    return log


def _rounded(number: float) -> float:
    # Adding zero makes minus zero plain: one value has one spelling.
    return round(number, DIGITS) + 0.0 if math.isfinite(number) else number


def _cell(value: Value) -> str:
    if isinstance(value, str):
        return value
    if math.isnan(value):
        return ""
    return str(int(value)) if value == int(value) and abs(value) < 1e15 else repr(value)
