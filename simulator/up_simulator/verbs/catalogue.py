"""The scenarios that are shipped, and how a name finds one."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from pathlib import Path

from up_simulator.verbs.outcome import UsageError

SHIPPED = Path(__file__).resolve().parents[1] / "scenarios"
SUFFIXES = (".yml", ".yaml")


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
        raise UsageError(f"there is no file {name}{_hint(path.stem)}")
    known = {each.stem: each for each in shipped_paths()}
    if name in known:
        return known[name]
    raise UsageError(f"there is no scenario {name[:80]!r}{_hint(name)}")


def _hint(name: str) -> str:
    names = [each.stem for each in shipped_paths()]
    near = difflib.get_close_matches(name[:80], names, n=1, cutoff=0.5)
    return f", did you mean '{near[0]}'?" if near else " ('up-sim list' names them)"


def no_such_tag(wanted: Iterable[str], known: Iterable[str]) -> UsageError:
    """Return the exception for tags that no scenario has."""
    names = sorted(set(known))
    asked = " and ".join(f"'{tag[:80]}'" for tag in wanted)
    unknown = [tag for tag in wanted if tag not in names]
    near = difflib.get_close_matches(unknown[0][:80], names, n=1) if unknown else []
    hint = f"did you mean '{near[0]}'?" if near else f"there are {', '.join(names)}"
    return UsageError(f"no scenario has the tag {asked}: {hint}")


def name_of(path: Path) -> str:
    """Return the name of a scenario in reports and folders."""
    return path.stem
