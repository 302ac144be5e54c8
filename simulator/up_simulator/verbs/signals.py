"""``up-sim signals``: list the signals for expectations and logs."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from up.cli.option_parser import OptionParser
from up_simulator.scenario.signals import SIGNALS, Kind
from up_simulator.verbs.catalogue import HELD, UsageError

EPILOG = """\
examples:
  up-sim signals              all
  up-sim signals board truth  those of the Arduino, and the truth about the aircraft"""


def main(arguments: Sequence[str]) -> int:
    """List signals; return the exit status."""
    parser = OptionParser(
        prog="up-sim signals",
        allow_abbrev=False,
        description="Lists the signals for expectations and logs.",
        epilog=EPILOG,
    )
    parser.add_argument("groups", nargs="*", metavar="GROUP", help="the part before the dot")
    options = parser.parse_args(arguments)
    groups = {signal.source for signal in SIGNALS.values()}
    for group in options.groups:
        if group not in groups:
            raise UsageError(
                f"unknown group {group[:40]!r}; the groups are {', '.join(sorted(groups))}"
            )
    width = max(map(len, SIGNALS))
    for signal in SIGNALS.values():
        if not options.groups or signal.source in options.groups:
            kind = signal.unit or ("" if signal.kind is Kind.NUMBER else signal.kind.value)
            sys.stdout.write(f"{signal.name:<{width}}  {kind:<6}  {signal.about}\n")
    return HELD
