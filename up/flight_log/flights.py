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
_LONGEST_NUMBER = 9
_LONGEST_SHOWN = 300


class FlightNotFoundError(FlightLogError):
    """The flight does not exist; the text is one sentence."""


@dataclass(frozen=True, slots=True)
class Flight:
    """The files of one flight, in order; ``number``: None for a file with another name."""

    paths: tuple[Path, ...]
    number: int | None
    aircraft: str

    @property
    def name(self) -> str:
        """Return the base name for files about this flight."""
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
        raise FlightNotFoundError(f"{folder}: {error.strerror or error}") from error
    return [
        Flight(tuple(file.path for file in parts), number, aircraft)
        for (number, _, aircraft), parts in groupby(files, lambda file: file.flight)
    ]


def find_flight(named: str, folder: Callable[[], Path]) -> Flight:
    """Return the flight that a user names; raises FlightNotFoundError with one sentence.

    ``named`` is a number or ``last``, looked up in the folder that ``folder`` returns, or the path
    of a file or folder.
    """
    if named == LAST:
        return _those_in(folder())[-1]
    if named.isascii() and named.isdigit() and len(named) <= _LONGEST_NUMBER:
        return _numbered(int(named), folder())
    path = Path(named)
    # A text that the system refuses as a path (too long, a NUL inside) is not a path here either.
    with contextlib.suppress(OSError, ValueError):
        if path.is_dir():
            return _only_one(path)
        if path.exists():
            return _with_its_parts(path)
    named = named if len(named) <= _LONGEST_SHOWN else f"{named[:_LONGEST_SHOWN]}..."
    raise FlightNotFoundError(f"{printable(named)}: no such flight{_hint(named)}")


def find_flight_of(words: Sequence[str], folder: Callable[[], Path]) -> Flight:
    """Return the flight that one word names, as ``find_flight`` does, or that several files form.

    Files named by the black box are put in their order, others stay in the order of ``words``.
    Raises FlightNotFoundError.
    """
    if len(words) == 1:
        return find_flight(words[0], folder)
    paths = [Path(word) for word in words]
    for path in paths:
        if not path.is_file():
            raise FlightNotFoundError(
                f"{printable(str(path))} is no file: name one flight, or the files of one"
            )
    files = [file for file in map(FlightFile.of, paths) if file is not None]
    if len({file.flight for file in files}) > 1:
        raise FlightNotFoundError(f"{_listed(paths)} are of several flights: name one")
    if len(files) < len(paths):
        return Flight(tuple(paths), None, "")
    files.sort(key=lambda file: file.part)
    return Flight(tuple(file.path for file in files), files[0].number, files[0].aircraft)


def _those_in(folder: Path) -> list[Flight]:
    if not folder.is_dir():
        raise FlightNotFoundError(f"no flight has been recorded: there is no folder {folder}")
    flights = flights_in(folder)
    if not flights:
        raise FlightNotFoundError(f"no flight is in {folder}")
    return flights


def _numbered(number: int, folder: Path) -> Flight:
    flights = _those_in(folder)
    found = [flight for flight in flights if flight.number == number]
    if not found:
        numbers = [flight.number for flight in flights]
        raise FlightNotFoundError(
            f"there is no flight {number} in {folder}: the newest is {numbers[-1]}, the"
            f" oldest {numbers[0]}"
            if len(numbers) > 1
            else f"there is no flight {number} in {folder}: it has {numbers[0]} only"
        )
    if len(found) > 1:
        raise FlightNotFoundError(
            f"{len(found)} flights have the number {number}: name {_files(found)}"
        )
    return found[0]


def _only_one(folder: Path) -> Flight:
    flights = flights_in(folder)
    if len(flights) == 1:
        return flights[0]
    if flights:
        raise FlightNotFoundError(
            f"{folder} has {len(flights)} flights: say --folder {folder} and a number"
        )
    # Renamed parts still belong to one flight, in the order of their names.
    paths = sorted(folder.glob(f"*{SUFFIX}"))
    if not paths:
        raise FlightNotFoundError(f"no flight is in {folder}: it has no file that ends in {SUFFIX}")
    return Flight(tuple(paths), None, "")


def _with_its_parts(path: Path) -> Flight:
    """Return the flight that begins with a file; a later part named alone is read alone."""
    named = FlightFile.of(path)
    if named is None:
        return Flight((path,), None, "")
    if named.part > 1:
        return Flight((path,), named.number, named.aircraft)
    flights = flights_in(path.parent)
    return next(
        (flight for flight in flights if path in flight.paths),
        Flight((path,), named.number, named.aircraft),
    )


def _listed(paths: Sequence[Path]) -> str:
    return printable(" and ".join(path.name for path in paths))


def _files(flights: Sequence[Flight]) -> str:
    return " or ".join(str(flight.paths[0]) for flight in flights)


def _hint(named: str) -> str:
    if difflib.SequenceMatcher(None, named, LAST).ratio() > 0.7:
        return f", did you mean '{LAST}'?"
    return f" ('{LAST}', a number that 'up log list' tells, a file or a folder)"
