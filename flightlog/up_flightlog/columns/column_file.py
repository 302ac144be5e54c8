"""The file of a flight's columns: a head in JSON, then the arrays, to be mapped into memory.

``MAGIC``, the size of the head (u64), the head, and from the next multiple of 8 bytes the arrays:
doubles for times, floats for values and for the minima and maxima of their levels. The head has
the place of each array: its offset behind the head and its length. A cache of this machine: its
numbers have this machine's byte order.
"""

from __future__ import annotations

import json
import mmap
from array import array
from collections.abc import Mapping, Sequence
from pathlib import Path
from struct import Struct
from typing import Any, Literal

from up.flight_log.mcap_format import FlightLogError
from up_flightlog.columns.column import Column, Level, levels_of
from up_flightlog.export.output import new_file

MAGIC = b"UPCOLS01"
_SIZE = Struct("<Q")
_BEGIN = len(MAGIC) + _SIZE.size
_ALIGNED = 8
MAX_HEAD = 64 * 1024 * 1024


class ColumnWriter:
    """Collects the columns of a flight and writes them; columns share equal arrays of times."""

    def __init__(self) -> None:
        self._arrays: list[array[float]] = []
        self._places: dict[int, list[int]] = {}
        self._end = 0
        self._columns: list[dict[str, Any]] = []

    def add(
        self, name: str, unit: str, gap_s: float, times_s: array[float], values: array[float]
    ) -> None:
        """Add a column; ``times_s`` may be the array of another one."""
        self._columns.append(
            {
                "name": name,
                "unit": unit,
                "gap_s": gap_s,
                "times": self._place(times_s),
                "values": self._place(values),
                "levels": [list(map(self._place, each)) for each in levels_of(values)],
            }
        )

    def write(self, path: Path, about: Mapping[str, Any]) -> None:
        """Write the file atomically; raises CliError."""
        head = json.dumps({**about, "columns": self._columns}, allow_nan=False).encode()
        with new_file(path, may_overwrite=True) as file:
            file.write(MAGIC + _SIZE.pack(len(head)) + head + bytes(-(_BEGIN + len(head)) % 8))
            for each in self._arrays:
                file.write(each.tobytes())
                file.write(bytes(-len(each) * each.itemsize % _ALIGNED))

    def _place(self, numbers: array[float]) -> list[int]:
        place = self._places.get(id(numbers))
        if place is None:
            place = self._places[id(numbers)] = [self._end, len(numbers)]
            self._arrays.append(numbers)
            size = len(numbers) * numbers.itemsize
            self._end += size + -size % _ALIGNED
        return place


class ColumnFile:
    """The columns of one flight; ``about`` is the head's other content.

    Raises FlightLogError for another kind of file, or one that is shorter than its head claims.
    """

    def __init__(self, path: Path) -> None:
        try:
            with path.open("rb") as file:
                self._data = memoryview(mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ))
        except (OSError, ValueError) as error:
            raise FlightLogError(f"cannot read {path}: {error}", "unreadable") from None
        try:
            if self._data[: len(MAGIC)] != MAGIC:
                raise ValueError("it does not begin with its magic")
            (size,) = _SIZE.unpack_from(self._data, len(MAGIC))
            if size > MAX_HEAD:
                raise ValueError("its head is too long")
            self.about: dict[str, Any] = json.loads(bytes(self._data[_BEGIN : _BEGIN + size]))
            self._arrays = self._data[_BEGIN + size + -(_BEGIN + size) % _ALIGNED :]
            self.columns = list(map(self._column, self.about.pop("columns")))
        except (ValueError, LookupError, TypeError, AttributeError, RecursionError) as error:
            text = f"{path}: not a file of columns: {error}"
            raise FlightLogError(text, "not_columns") from None

    def _column(self, made: Mapping[str, Any]) -> Column:
        levels: list[Level] = [
            (self._array(low, "f"), self._array(high, "f")) for low, high in made["levels"]
        ]
        times_s, values = self._array(made["times"], "d"), self._array(made["values"], "f")
        if len(times_s) != len(values):
            raise ValueError("times and values differ in number")
        return Column(made["name"], made["unit"], made["gap_s"], times_s, values, levels)

    def _array(self, place: Sequence[int], kind: Literal["d", "f"]) -> memoryview[float]:
        begin, count = place
        size = count * array(kind).itemsize
        if begin < 0 or count < 0 or begin + size > len(self._arrays):
            raise ValueError("an array that is not within it")
        return self._arrays[begin : begin + size].cast(kind)
