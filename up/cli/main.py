"""The command line ``up``: its verbs and its error handling."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from up.cli.cli_error import CliError
from up.cli.option_parser import EXIT_FAILED, EXIT_INTERRUPTED, EXIT_USAGE
from up.cli.parser import make_parser
from up.config import ConfigErrors
from up.errors import UserError


def main(arguments: Sequence[str] | None = None) -> int:
    """Carry out one command; return the exit status.

    0: done; 1: not done, with one sentence on stderr; 2: mistakes in configuration or arguments.
    """
    words = sys.argv[1:] if arguments is None else list(arguments)
    parser = make_parser(words)
    values = parser.parse_args(words)
    if getattr(values, "carry_out", None) is None:
        (getattr(values, "parser", None) or parser).print_help()
        return EXIT_FAILED
    try:
        status: int = values.carry_out(values)
    except ConfigErrors as errors:
        return _fail(str(errors), EXIT_USAGE)
    except CliError as error:
        return _fail(str(error), error.status)
    except UserError as error:
        return _fail(str(error), EXIT_FAILED)
    except BrokenPipeError:
        # The reader, such as 'head', has closed the pipe.
        sys.stderr.close()
        return EXIT_FAILED
    except OSError as error:
        return _fail(f"up: {error}", EXIT_FAILED)
    except KeyboardInterrupt:
        return _fail("interrupted", EXIT_INTERRUPTED)
    return status


def _fail(text: str, status: int) -> int:
    print(text, file=sys.stderr)  # noqa: T201 - the user's answer
    return status


if __name__ == "__main__":
    sys.exit(main())
