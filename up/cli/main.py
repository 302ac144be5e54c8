"""The command line ``up``: its verbs and its error handling."""

import sys
from collections.abc import Sequence

from up.cli.option_parser import EXIT_INTERRUPTED, EXIT_USAGE
from up.cli.parser import make_parser
from up.errors import UserError
from up.output import print_problems


def main(arguments: Sequence[str] | None = None) -> int:
    """Carry out one command; return the exit status.

    0: done; 1: not done, with one sentence on stderr; 2: mistakes in configuration or arguments.
    """
    words = sys.argv[1:] if arguments is None else list(arguments)
    parser = make_parser(words)
    values = parser.parse_args(words)
    if getattr(values, "carry_out", None) is None:
        (getattr(values, "parser", None) or parser).print_help()
        return EXIT_USAGE
    try:
        status: int = values.carry_out(values)
    except UserError as error:
        return _fail(error, error.status)
    except KeyboardInterrupt:
        return _fail(UserError("interrupted", "interrupted"), EXIT_INTERRUPTED)
    return status


def _fail(error: UserError, status: int) -> int:
    print_problems(error.problems)
    return status


if __name__ == "__main__":
    sys.exit(main())
