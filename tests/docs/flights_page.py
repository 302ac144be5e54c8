"""Writes the tables of docs/flights.md from what ``up-sim all`` left.

``python -m tests.docs.flights_page FOLDER`` takes the figures from FOLDER (run/flights); what has
not been flown there keeps its table. It ends with a sentence where a scenario did not hold, or has
neither.
"""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from tests.docs.configuration_page import BEGIN, END
from up_simulator.scenario.file import read_scenario
from up_simulator.scenario.run import SUMMARY
from up_simulator.scenario.scenario import Scenario
from up_simulator.verbs.catalogue import shipped_paths

PAGE = Path(__file__).parents[2] / "docs" / "flights.md"
_SECTION = re.compile(r"^### (\S+)\n.*?(?=^##|\Z)", re.MULTILINE | re.DOTALL)
GROUPS = ("The Arduino flies alone", "With the daemon", "With real programs")


def shipped() -> dict[str, Scenario]:
    """Return the scenarios that are shipped, by name."""
    return {path.stem: read_scenario(path) for path in shipped_paths()}


def group_of(scenario: Scenario) -> str:
    """Return the heading under which a scenario stands."""
    if scenario.is_real:
        return GROUPS[2]
    return GROUPS[1] if scenario.has_raspilot else GROUPS[0]


def tables(summaries: dict[str, dict[str, Any]], kept: dict[str, str]) -> str:
    """Return the generated part of the page; ``kept``: the tables of those without a summary."""
    return "\n".join(_lines(summaries, kept)) + "\n"


def _lines(summaries: dict[str, dict[str, Any]], kept: dict[str, str]) -> Iterator[str]:
    scenarios = shipped()
    for group in GROUPS:
        yield f"## {group}\n"
        for name, scenario in scenarios.items():
            if group_of(scenario) != group:
                continue
            if name in summaries:
                yield from _scenario(name, scenario, summaries[name])
            else:
                yield kept[name].rstrip("\n") + "\n"


def _scenario(name: str, scenario: Scenario, summary: dict[str, Any]) -> Iterator[str]:
    yield f"### {name}\n"
    yield f"**{scenario.title}** ({scenario.duration_s:g} s). {' '.join(scenario.about.split())}\n"
    yield f"Guards: {scenario.guards}.\n"
    yield "| what must be true | figure | limit |"
    yield "|---|---|---|"
    for verdict in summary["expectations"]:
        yield f"| {verdict['name']} | {verdict['figure']} | {verdict['limit']} |"
    yield ""


def read_summaries(folder: Path) -> dict[str, dict[str, Any]]:
    """Return the results of the flights in a folder; raises ValueError with a sentence."""
    found = {}
    for name in shipped():
        path = folder / name / SUMMARY
        if not path.is_file():
            continue
        found[name] = json.loads(path.read_text(encoding="utf-8"))
        if not found[name]["held"]:
            raise ValueError(f"{name} did not hold")
    return found


def main() -> int:
    """Write the page's tables again; return the exit status."""
    try:
        summaries = read_summaries(Path(sys.argv[1] if sys.argv[1:] else "run/flights"))
        head, _, rest = PAGE.read_text(encoding="utf-8").partition(BEGIN)
        before, _, tail = rest.partition(END)
        kept = {each[1]: each[0] for each in _SECTION.finditer(before)}
        written = tables(summaries, kept)
    except KeyError as error:
        sys.stderr.write(f"{error.args[0]} has not been flown: up-sim all\n")
        return 2
    except ValueError as error:
        sys.stderr.write(f"{error}\n")
        return 2
    PAGE.write_text(f"{head}{BEGIN}\n{written}{END}{tail}", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
