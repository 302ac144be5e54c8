"""The first module of every program: until the program's own is imported, Ctrl-C ends it quietly.

It must import nothing slow.
"""

import os
import signal
from importlib import import_module
from typing import Any


def start(module: str, *arguments: Any) -> int:
    """Import a program's module and return the exit status of its ``main(*arguments)``.

    Nothing needs to be cleaned up before ``main`` runs: SIGINT ends the process, without a
    traceback. An interrupt, a closed pipe or an error of the system that ``main`` does not handle
    is not a traceback either. An unknown UP_LOG_FORMAT ends every program.
    """
    before = signal.getsignal(signal.SIGINT)
    if before is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    from up.cli.option_parser import EXIT_FAILED, EXIT_INTERRUPTED, EXIT_USAGE
    from up.errors import UserError
    from up.output import check_format, print_problems
    from up.system.gc_scheduler import frozen_imports
    from up.system.postponed_import import postpone

    try:
        check_format()
    except UserError as error:
        print_problems(error.problems)
        return EXIT_USAGE
    postpone("http.cookiejar")
    with frozen_imports():
        main = import_module(module).main
    signal.signal(signal.SIGINT, before)
    try:
        status: int = main(*arguments)
    except KeyboardInterrupt:
        return EXIT_INTERRUPTED
    except BrokenPipeError:
        # The reader, such as 'head', has closed the pipe.
        _drop_output()
        return EXIT_FAILED
    except OSError as error:
        where = f"{error.filename}: " if error.filename else ""
        print_problems([UserError(f"{where}{error.strerror or error}", "system_error")])
        _drop_output()
        return EXIT_FAILED
    return status


def _drop_output() -> None:
    """Let the end of the program write nowhere what could not be written."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for descriptor in (1, 2):
        os.dup2(nowhere, descriptor)
