"""``up-sim check``: validate scenario files without flying."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from up.config import ConfigErrors
from up.fields import printable
from up.output import print_problems
from up_simulator.scenario.file import read_scenario
from up_simulator.verbs.catalogue import HELD, WRONG_INPUT, find, verb_parser

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
    status = HELD
    for path in [find(name) for name in options.files]:
        try:
            scenario = read_scenario(path)
        except ConfigErrors as errors:
            print_problems(errors.problems)
            status = WRONG_INPUT
            continue
        count = len(scenario.expect)
        title = printable(scenario.title.strip())
        what = f"{title}: {scenario.duration_s:g} s, {count} expectations, no error"
        sys.stdout.write(f"{path}: {what}\n")
    return status
