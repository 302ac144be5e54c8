"""``up-sim signals``: list the signals for expectations and logs."""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence

from up.cli.cli_error import UsageError
from up.cli.option_parser import add_json_option
from up.output import echo
from up_simulator.scenario.signals import SIGNALS, Kind, Signal
from up_simulator.verbs.catalogue import HELD, verb_parser

EPILOG = """\
examples:
  up-sim signals              all
  up-sim signals board truth  those of the Arduino, and the truth about the aircraft"""


def main(arguments: Sequence[str]) -> int:
    """List signals; return the exit status."""
    parser = verb_parser("signals", "Lists the signals for expectations and logs.", EPILOG)
    parser.add_argument("groups", nargs="*", metavar="GROUP", help="the part before the dot")
    add_json_option(parser)
    options = parser.parse_args(arguments)
    groups = {signal.source for signal in SIGNALS.values()}
    for group in options.groups:
        if group not in groups:
            raise UsageError(
                f"unknown group {group[:40]!r}; the groups are {', '.join(sorted(groups))}",
                "no_such_group",
            )
    width = max(map(len, SIGNALS))
    wanted = [each for each in SIGNALS.values() if each.source in (options.groups or groups)]
    if options.json:
        echo(json.dumps([_row(each) for each in wanted], indent=1))
        return HELD
    for signal in wanted:
        kind = signal.unit or ("" if signal.kind is Kind.NUMBER else signal.kind.value)
        sys.stdout.write(f"{signal.name:<{width}}  {kind:<6}  {signal.about}\n")
    return HELD


def _row(signal: Signal) -> dict[str, str]:
    return {
        "name": signal.name,
        "kind": signal.kind.value,
        "unit": signal.unit,
        "about": signal.about,
    }
