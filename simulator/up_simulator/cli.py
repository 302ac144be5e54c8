"""The program ``up-sim``: its verbs, and their error exits."""

from __future__ import annotations

import argparse
import importlib
import os
import sys
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

from up.cli.cli_error import UsageError
from up.cli.completion import Verb, verb_of
from up.cli.option_parser import OptionParser, parser_in
from up.config import ConfigErrors
from up.errors import UserError
from up.fields import suggestion
from up.output import print_problems, program_error
from up.version import VERSION
from up_simulator.harness.signal_handling import orderly_exit
from up_simulator.verbs.catalogue import INTERRUPTED, NOT_HELD, WRONG_INPUT

DESCRIPTION = """\
The virtual aircraft: the firmware of the Arduino and the daemon of the Raspberry Pi, flown
by a flight dynamics model, in flights that are logged and evaluated."""
EPILOG = """\
A first flight in three commands:
  up-sim list                        the scenarios
  up-sim fly level-flight-in-gusts   flies it; the picture is in run/flights/
  up-sim new first-flight            a scenario of your own, with a comment at every key

  up-sim start                       the aircraft in real time, for Raspilot and a ground station
'up-sim VERB --help' explains a verb; docs/simulator.md explains the virtual aircraft and
docs/scenarios.md scenarios."""
ROOT = Path(__file__).resolve().parents[2]
VERBS = {
    "fly": ("fly scenarios and report what held", "up_simulator.verbs.fly"),
    "list": ("list the scenarios", "up_simulator.verbs.listing"),
    "new": ("write a commented scenario of your own", "up_simulator.verbs.new"),
    "check": ("look for mistakes in scenario files without flying", "up_simulator.verbs.check"),
    "signals": ("list what can be expected and logged", "up_simulator.verbs.signals"),
    "all": ("fly every scenario that is shipped, and count", "up_simulator.verbs.all"),
    "prove": ("fly your configuration through every failure", "up_simulator.verbs.prove"),
    "tune": ("step tests over gains; proposes a set", "tools.tuning.cli"),
    "start": ("the virtual aircraft in real time", "up_simulator.harness.start"),
    "radio": ("take the sticks of an aircraft that flies", "up_simulator.radio.rc_override"),
}
"""A verb's module has ``main(arguments) -> exit status``."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Carry out one verb; return the exit status.

    0: held; 1: not held, or it could not be flown; 2: wrong input; 130, 143, 129: ended by Ctrl-C,
    SIGTERM, SIGHUP (a closed terminal), each in the same order.
    """
    _open_closed_streams()
    with orderly_exit() as ending:
        try:
            return ending.status(_main(list(sys.argv[1:] if arguments is None else arguments)))
        finally:
            _flush()


def _main(words: list[str]) -> int:
    parser = _parser()
    if not words:
        parser.print_help()
        return WRONG_INPUT
    verb = words[0]
    if verb.startswith("-"):
        parser.parse_args(words)
        return _fail("a verb is missing; 'up-sim --help' lists them", WRONG_INPUT, "usage")
    if verb not in VERBS:
        hint = suggestion(verb, VERBS) or " ('up-sim --help' lists them)"
        return _fail(f"unknown verb {verb[:60]!r}{hint}", WRONG_INPUT, "usage")
    try:
        carry_out: Callable[[list[str]], int] = _module(verb).main
        return carry_out(words[1:])
    except ConfigErrors as errors:
        print_problems(errors.problems)
        return WRONG_INPUT
    except UserError as error:
        return _fail(str(error), error.status, error.code)
    except BrokenPipeError:
        # The reader, such as 'head', has closed the pipe; nothing more can be written.
        sys.stderr.close()
        return NOT_HELD
    except OSError as error:
        where = f"{error.filename}: " if error.filename else ""
        return _fail(f"{where}{error.strerror or error}", NOT_HELD, "system_error")
    except KeyboardInterrupt:
        return _fail("interrupted", INTERRUPTED, "interrupted")


def _module(verb: str) -> Any:
    if VERBS[verb][1].startswith("tools."):
        sys.path.append(str(ROOT))
    try:
        return importlib.import_module(VERBS[verb][1])
    except ModuleNotFoundError as error:
        if error.name is not None and error.name.split(".")[0] in ("up_simulator", "tools"):
            raise UsageError(
                f"'{verb}' is not built in here ({error.name})", "not_built"
            ) from error
        raise UsageError(
            f"'{verb}' needs {error.name}, which is not installed:"
            " pip install -e '.[sim]' ./flightlog",
            "import_missing",
        ) from error


class _Parser(OptionParser):
    """The parser of the program; each verb's module makes its own."""

    def completion(self) -> Verb:
        root = verb_of(self)
        for name, (about, _) in VERBS.items():
            with suppress(UsageError):
                root.verbs[name] = verb_of(parser_in(_module(name).main), about)
        return root


def _parser() -> argparse.ArgumentParser:
    verbs = "\n".join(f"  {name:<9}{about}" for name, (about, _) in VERBS.items())
    parser = _Parser(
        prog="up-sim",
        allow_abbrev=False,
        usage="up-sim VERB ...",
        description=f"{DESCRIPTION}\n\nverbs:\n{verbs}",
        epilog=EPILOG,
    )
    parser.add_argument("--version", action="version", version=f"up-sim {VERSION}")
    return parser


def _open_closed_streams() -> None:
    """Open streams closed before the start (``>&-``) on /dev/null, for children too."""
    while (descriptor := os.open(os.devnull, os.O_RDWR)) <= 2:
        os.set_inheritable(descriptor, True)
    os.close(descriptor)
    sys.stdout = sys.stdout or open(1, "w", closefd=False)  # noqa: SIM115
    sys.stderr = sys.stderr or open(2, "w", closefd=False)  # noqa: SIM115


def _fail(text: str, status: int, code: str) -> int:
    # The terminal may be closed already.
    with suppress(OSError):
        sys.stderr.write(f"{program_error('up-sim', text, code)}\n")
    return status


def _flush() -> None:
    """Flush the output; without a reader drop it silently."""
    try:
        sys.stdout.flush()
    except (OSError, ValueError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        with suppress(OSError, ValueError):
            os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)


if __name__ == "__main__":
    sys.exit(main())
