"""The recorded flights, and the selection of one by the user."""

from __future__ import annotations

import contextlib
import difflib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path

from up.fields import printable
from up.flight_log.flight_file import FlightFile, flight_files
from up.flight_log.mcap_format import FlightLogError

SUFFIX = ".mcap"
LAST = "last"
_HINT = f" ('{LAST}', a number from 'up log list', a file or a folder)"
_MAX_DIGITS = 9
_MAX_SHOWN = 300
_DEMO = Path("run/demo/flights")
"""Where ``make run`` records, from the project's folder."""


class FlightNotFoundError(FlightLogError):
    """The flight that the user names does not exist; the text is one sentence."""

    status = 2


@dataclass(frozen=True, slots=True)
class Flight:
    """The files of one flight, in order; ``number``: None for a file with another name."""

    paths: tuple[Path, ...]
    number: int | None
    aircraft: str

    @property
    def name(self) -> str:
        return self.paths[0].stem

    @property
    def size(self) -> int:
        """Return its size in bytes; a deleted file counts 0."""
        return sum(path.stat().st_size for path in self.paths if path.is_file())


def flights_in(folder: Path) -> list[Flight]:
    """Return the flights of a folder, oldest first; files with other names are ignored.

    Raises FlightNotFoundError if the folder cannot be read.
    """
    try:
        files = flight_files(folder)
    except OSError as error:
        text = f"{folder}: {error.strerror or error}"
        raise FlightNotFoundError(text, "unreadable") from error
    return [
        Flight(tuple(file.path for file in parts), number, aircraft)
        for (number, _, aircraft), parts in groupby(files, lambda file: file.flight)
    ]


def find_flight(name: str, folder: Callable[[], Path]) -> Flight:
    """Return the flight that a user names; raises FlightNotFoundError with one sentence.

    ``name`` is a number or ``last``, looked up in the folder that ``folder`` returns, or the path
    of a file or folder.
    """
    if not name:
        raise FlightNotFoundError(f"the name of the flight is empty{_HINT}", "no_such_flight")
    if name == LAST:
        return _flights_of(folder())[-1]
    if name.isascii() and name.isdigit() and len(name) <= _MAX_DIGITS:
        return _numbered(int(name), folder())
    path = Path(name)
    # A text that the system refuses as a path (too long, a NUL inside) is not a path here either.
    with contextlib.suppress(OSError, ValueError):
        if path.is_dir():
            return _only_one(path)
        if path.exists():
            return _with_its_parts(path)
    name = name if len(name) <= _MAX_SHOWN else f"{name[:_MAX_SHOWN]}..."
    hint = _HINT
    if difflib.SequenceMatcher(None, name, LAST).ratio() > 0.7:
        hint = f", did you mean '{LAST}'?"
    raise FlightNotFoundError(f"{printable(name)}: no such flight{hint}", "no_such_flight")


def find_flight_of(names: Sequence[str], folder: Callable[[], Path]) -> Flight:
    """Return the flight that one name selects, as ``find_flight`` does, or that files form.

    Files named by the black box are put in their order, others stay in the order of ``names``.
    Raises FlightNotFoundError.
    """
    if len(names) == 1:
        return find_flight(names[0], folder)
    paths = [Path(name) for name in names]
    for path in paths:
        if not path.is_file():
            text = f"{printable(str(path))} is not a file: name one flight, or the files of one"
            raise FlightNotFoundError(text, "not_a_file")
    files = [file for file in map(FlightFile.of, paths) if file is not None]
    if len({file.flight for file in files}) > 1:
        listed = printable(" and ".join(path.name for path in paths))
        text = f"{listed} belong to several flights: name one"
        raise FlightNotFoundError(text, "several_flights")
    if len(files) < len(paths):
        return Flight(tuple(paths), None, "")
    files.sort(key=lambda file: file.part)
    return Flight(tuple(file.path for file in files), files[0].number, files[0].aircraft)


def _flights_of(folder: Path) -> list[Flight]:
    if not folder.is_dir():
        text = f"no flight recorded: no folder {folder}{demo_hint()}"
        raise FlightNotFoundError(text, "no_folder")
    flights = flights_in(folder)
    if not flights:
        raise FlightNotFoundError(f"no flight in {folder}{demo_hint()}", "no_flights")
    return flights


def demo_hint() -> str:
    """Return where the flights of ``make run`` are, if it recorded any below this folder."""
    return f"; those of 'make run': --folder {_DEMO}" if any(_DEMO.glob(f"*{SUFFIX}")) else ""


def _numbered(number: int, folder: Path) -> Flight:
    flights = _flights_of(folder)
    found = [flight for flight in flights if flight.number == number]
    if not found:
        first, last = flights[0].number, flights[-1].number
        known = f"the newest is {last}, the oldest {first}" if flights[1:] else f"only {first}"
        raise FlightNotFoundError(f"no flight {number} in {folder}: {known}", "no_such_flight")
    if found[1:]:
        files = " or ".join(str(flight.paths[0]) for flight in found)
        text = f"{len(found)} flights have the number {number}: name {files}"
        raise FlightNotFoundError(text, "several_flights")
    return found[0]


def _only_one(folder: Path) -> Flight:
    flights = flights_in(folder)
    if len(flights) == 1:
        return flights[0]
    if flights:
        text = f"{folder} has {len(flights)} flights: use --folder {folder} and a number"
        raise FlightNotFoundError(text, "several_flights")
    # Renamed parts still belong to one flight, in the order of their names.
    paths = sorted(folder.glob(f"*{SUFFIX}"))
    if not paths:
        text = f"no flight in {folder}: no file ends in {SUFFIX}"
        raise FlightNotFoundError(text, "no_flights")
    return Flight(tuple(paths), None, "")


def _with_its_parts(path: Path) -> Flight:
    """Return the flight that begins with a file; a later part named alone is read alone."""
    file = FlightFile.of(path)
    if file is None:
        return Flight((path,), None, "")
    alone = Flight((path,), file.number, file.aircraft)
    if file.part > 1:
        return alone
    return next((flight for flight in flights_in(path.parent) if path in flight.paths), alone)
