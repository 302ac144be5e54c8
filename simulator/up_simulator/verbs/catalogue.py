"""The scenarios that are shipped, how a name finds one, and the outcomes of a verb."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from up.cli.cli_error import UsageError
from up.cli.option_parser import OptionParser
from up.config import ConfigErrors
from up.fields import suggestion
from up.output import print_problems
from up_simulator.scenario.file import read_scenario
from up_simulator.scenario.scenario import Scenario

SHIPPED = Path(__file__).resolve().parents[1] / "scenarios"
SUFFIXES = (".yml", ".yaml")
HELD, NOT_HELD, WRONG_INPUT, INTERRUPTED = 0, 1, 2, 130


def verb_parser(verb: str, description: str, epilog: str = "") -> OptionParser:
    """Return the parser of a verb of ``up-sim``."""
    prog = f"up-sim {verb}"
    return OptionParser(prog=prog, allow_abbrev=False, description=description, epilog=epilog)


def shipped_paths() -> list[Path]:
    """Return the files of all scenarios that are shipped, by name."""
    return sorted(SHIPPED.glob("*.yml"))


def scenarios_in(paths: Iterable[Path]) -> tuple[list[tuple[Path, Scenario]], bool]:
    """Return the scenarios, and whether every file is one; mistakes in the others are printed."""
    found = []
    are_right = True
    for path in paths:
        try:
            found.append((path, read_scenario(path)))
        except ConfigErrors as errors:
            print_problems(errors.problems)
            are_right = False
    return found, are_right


def tagged(
    scenarios: Sequence[tuple[Path, Scenario]], tags: Sequence[str]
) -> list[tuple[Path, Scenario]]:
    """Return the scenarios that have all of the tags; raises UsageError if there is none."""
    chosen = [each for each in scenarios if set(tags) <= set(each[1].tags)]
    if tags and not chosen:
        raise _no_such_tag(tags, {tag for _, scenario in scenarios for tag in scenario.tags})
    return chosen


def find(name: str) -> Path:
    """Return the file of a shipped scenario, or a path unchanged.

    Raises UsageError for an unknown name, with the nearest one, and for a path that is not a
    scenario's.
    """
    known = {each.stem: each for each in shipped_paths()}
    if name in known:
        return known[name]
    path = Path(name)
    if path.is_dir() and name:
        text = f"{name} is a folder: name a file ('up-sim list {name}' lists those in it)"
        raise UsageError(text, "not_a_file")
    if path.suffix not in SUFFIXES and path.exists() and name:
        text = f"{name} is not a scenario: its file ends in {SUFFIXES[0]}{_hint(path.stem)}"
        raise UsageError(text, "not_a_scenario")
    if path.suffix in SUFFIXES or "/" in name:
        if path.exists():
            return path
        raise UsageError(f"no file {name}{_hint(path.stem)}", "no_such_file")
    raise UsageError(f"unknown scenario {name[:80]!r}{_hint(name)}", "no_such_scenario")


def _hint(name: str) -> str:
    names = (each.stem for each in shipped_paths())
    return suggestion(name, names) or " ('up-sim list' lists them)"


def _no_such_tag(wanted: Sequence[str], known: Iterable[str]) -> UsageError:
    names = sorted(known)
    asked = " and ".join(f"'{tag[:80]}'" for tag in wanted)
    unknown = [tag for tag in wanted if tag not in names]
    hint = suggestion(unknown[0], names) if unknown else ""
    hint = hint or f": there are {', '.join(names)}"
    return UsageError(f"no scenario has the tag {asked}{hint}", "no_such_tag")
