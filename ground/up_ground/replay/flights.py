"""Which files a user means by a flight."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping, Sequence
from pathlib import Path

_PART = re.compile(r"(?P<flight>.+?)(?:\.(?P<part>[2-9]|[1-9][0-9]{1,5}))?\.mcap")
_NUMBERED = re.compile(r"(?P<number>[0-9]{4,9})-.+")


class FlightNotFoundError(ValueError):
    """There is no such flight; the text is one sentence."""


def flights_folder(environ: Mapping[str, str]) -> Path:
    """Return where the black box puts flights unless it is configured otherwise."""
    service = environ.get("STATE_DIRECTORY", "").partition(":")[0]
    if service:
        return Path(service) / "flights"
    state = environ.get("XDG_STATE_HOME", "")
    base = Path(state) if state.startswith("/") else Path.home() / ".local" / "state"
    return base / "raspilot" / "flights"


def find_flight(words: Sequence[str], folder: Path) -> list[Path]:
    """Return the parts of the one flight that ``words`` mean, in order.

    Files, a folder (its newest flight), a number, or ``last``. Of one file the parts beside it are
    taken along. Raises FlightNotFoundError.
    """
    paths = [_existing(word, folder) for word in words]
    if len(paths) > 1:
        for path in paths:
            if path.is_dir():
                raise FlightNotFoundError(f"{path} is a folder: name one folder, or files")
        return sorted(paths, key=_order)
    path = paths[0]
    return _newest(path) if path.is_dir() else _with_parts(path)


def _existing(word: str, folder: Path) -> Path:
    path = Path(word)
    if path.exists():
        return path
    if word == "last":
        return _newest(folder)[0]
    if word.isascii() and word.isdigit() and len(word) < 10:
        for each in _logs(folder):
            found = _NUMBERED.fullmatch(each.name)
            if found is not None and int(found["number"]) == int(word):
                return each
        raise FlightNotFoundError(f"there is no flight {word} in {folder}")
    raise FlightNotFoundError(f"there is no file {word}")


def _newest(folder: Path) -> list[Path]:
    logs = _logs(folder)
    if not logs:
        raise FlightNotFoundError(f"there is no flight in {folder}")
    return _with_parts(max(logs, key=_age))


def _age(path: Path) -> tuple[bool, int, float]:
    """Return what is greater for a newer flight: its number, else its time."""
    found = _NUMBERED.fullmatch(path.name)
    number = int(found["number"]) if found is not None else 0
    return found is not None, number, path.stat().st_mtime


def _with_parts(path: Path) -> list[Path]:
    name, _ = _order(path)
    beside = [each for each in _logs(path.parent) if _order(each)[0] == name]
    return sorted(beside, key=_order) if path in beside else [path]


def _order(path: Path) -> tuple[str, int]:
    found = _PART.fullmatch(path.name)
    return (found["flight"], int(found["part"] or 1)) if found is not None else (path.name, 1)


def _logs(folder: Path) -> list[Path]:
    try:
        with os.scandir(folder) as entries:
            names = [each.name for each in entries if each.name.endswith(".mcap")]
    except OSError as error:
        raise FlightNotFoundError(f"{folder} cannot be read: {error.strerror}") from None
    return [folder / name for name in sorted(names)]
