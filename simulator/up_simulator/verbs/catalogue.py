"""The scenarios that are shipped, how a name finds one, and the outcomes of a verb."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from up.fields import suggestion

SHIPPED = Path(__file__).resolve().parents[1] / "scenarios"
SUFFIXES = (".yml", ".yaml")
HELD, NOT_HELD, WRONG_INPUT, INTERRUPTED = 0, 1, 2, 130


class FailedError(Exception):
    """The request cannot be carried out here: one sentence, exit status 1."""


class UsageError(Exception):
    """The request names a missing thing: one sentence, exit status 2."""


def shipped_paths() -> list[Path]:
    """Return the files of all scenarios that are shipped, by name."""
    return sorted(SHIPPED.glob("*.yml"))


def find(name: str) -> Path:
    """Return the file of a shipped scenario, or a path unchanged.

    Raises UsageError for an unknown name, with the nearest one.
    """
    path = Path(name)
    if path.suffix in SUFFIXES or path.is_file():
        if path.exists():
            return path
        raise UsageError(f"no file {name}{_hint(path.stem)}")
    known = {each.stem: each for each in shipped_paths()}
    if name in known:
        return known[name]
    raise UsageError(f"unknown scenario {name[:80]!r}{_hint(name)}")


def _hint(name: str) -> str:
    names = (each.stem for each in shipped_paths())
    return suggestion(name, names) or " ('up-sim list' lists them)"


def no_such_tag(wanted: Iterable[str], known: Iterable[str]) -> UsageError:
    """Return the exception for tags that no scenario has."""
    names = sorted(set(known))
    asked = " and ".join(f"'{tag[:80]}'" for tag in wanted)
    unknown = [tag for tag in wanted if tag not in names]
    hint = suggestion(unknown[0], names) if unknown else ""
    hint = hint or f": there are {', '.join(names)}"
    return UsageError(f"no scenario has the tag {asked}{hint}")


def name_of(path: Path) -> str:
    """Return the name of a scenario in reports and folders."""
    return path.stem
