"""``up-sim check``: validate scenario files without flying."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from up.fields import printable
from up_simulator.verbs.catalogue import HELD, WRONG_INPUT, find, scenarios_in, verb_parser

EPILOG = """\
Every error is reported with file, line, column and, if possible, a suggestion.
Exit status: 0 no error, 2 errors.

examples:
  up-sim check my-flight.yml
  up-sim check flights/*.yml"""


def main(arguments: Sequence[str]) -> int:
    """Check files; return the exit status."""
    parser = verb_parser("check", "Reads scenario files and reports all their errors.", EPILOG)
    parser.add_argument("files", nargs="+", metavar="FILE", help="a file, or a shipped one's name")
    options = parser.parse_args(arguments)
    scenarios, are_right = scenarios_in([find(name) for name in options.files])
    for path, scenario in scenarios:
        count = len(scenario.expect)
        title = printable(scenario.title.strip())
        what = f"{title}: {scenario.duration_s:g} s, {count} expectations, no error"
        sys.stdout.write(f"{path}: {what}\n")
    return HELD if are_right else WRONG_INPUT
