"""``up-sim list``: the available scenarios."""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from pathlib import Path

from up.cli.option_parser import add_json_option
from up.fields import printable
from up.output import echo
from up_simulator.scenario.scenario import Scenario
from up_simulator.verbs.catalogue import (
    HELD,
    WRONG_INPUT,
    scenarios_in,
    shipped_paths,
    tagged,
    verb_parser,
)

EPILOG = """\
examples:
  up-sim list                 every shipped scenario
  up-sim list --tag faults    those that have this tag
  up-sim list my-flights/     those of a folder of your own"""


def main(arguments: Sequence[str]) -> int:
    """List scenarios; return the exit status."""
    parser = verb_parser(
        "list",
        "Lists scenarios: name, how long, title, tags, and the rule that each guards.",
        EPILOG,
    )
    parser.add_argument("folder", nargs="?", type=Path, help="another folder than the shipped one")
    parser.add_argument("--tag", action="append", default=[], help="only those with this tag")
    add_json_option(parser)
    options = parser.parse_args(arguments)
    if options.folder is None:
        paths = shipped_paths()
    elif options.folder.is_dir():
        paths = sorted(options.folder.glob("*.yml"))
    else:
        parser.error(f"{options.folder} is not a folder")
    scenarios, are_right = scenarios_in(paths)
    chosen = tagged(scenarios, options.tag)
    if options.json:
        echo(json.dumps([_row(*each) for each in chosen], indent=1))
    else:
        _print(chosen, max((len(path.stem) for path in paths), default=0))
    return HELD if are_right else WRONG_INPUT


def _print(scenarios: Sequence[tuple[Path, Scenario]], width: int) -> None:
    for path, scenario in scenarios:
        pace = "real time" if scenario.is_real else ""
        title = scenario.title.strip()
        line = f"{path.stem:<{width}}  {scenario.duration_s:>5g} s  {title}"
        more = "; ".join(part for part in (", ".join(scenario.tags), pace) if part)
        sys.stdout.write(printable(f"{line}  [{more}]" if more else line) + "\n")
        if scenario.guards:
            sys.stdout.write(printable(f"{'':<{width}}  guards: {scenario.guards}") + "\n")


def _row(path: Path, scenario: Scenario) -> dict[str, object]:
    return {
        "name": path.stem,
        "file": str(path),
        "duration_s": scenario.duration_s,
        "title": scenario.title.strip(),
        "tags": list(scenario.tags),
        "is_real": scenario.is_real,
        "guards": scenario.guards,
    }
