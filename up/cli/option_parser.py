"""The argument parser of every command line: suggestions, width 80, exit status 0, 1 or 2."""

from __future__ import annotations

import argparse
import functools
import math
import re
import sys
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, NoReturn

from up.cli.completion import SHELLS, Verb, script, verb_of
from up.errors import UserError
from up.fields import suggestion
from up.output import FORMAT_VARIABLE, print_problems, wants_json

EXIT_OK = 0
EXIT_FAILED = 1
EXIT_USAGE = 2
"""A mistake in the arguments or the configuration."""
EXIT_INTERRUPTED = 130
_GIVE_PARSER = "\0"
"""No argument of a process can be this."""


def add_json_option(parser: argparse.ArgumentParser) -> None:
    """Add ``--json``: the answer is one JSON document; UP_LOG_FORMAT=json implies it."""
    text = f"print one JSON document, as with {FORMAT_VARIABLE}=json"
    parser.add_argument("--json", action="store_true", default=wants_json(), help=text)


def add_defaults_option(parser: argparse.ArgumentParser) -> None:
    """Add ``--defaults``."""
    parser.add_argument(
        "--defaults", action="store_true", help="use the defaults if no configuration file exists"
    )


def whole_number(minimum: int, maximum: int) -> Callable[[str], int]:
    """Return the type of an option whose value is a whole number within bounds."""

    def read(text: str) -> int:
        is_whole = text.isascii() and text.isdigit() and len(text) <= len(str(maximum))
        if not is_whole or not minimum <= int(text) <= maximum:
            bounds = f"from {minimum} to {maximum}"
            raise argparse.ArgumentTypeError(f"must be a whole number {bounds}, not {text[:60]!r}")
        return int(text)

    return read


def bounded_number(minimum: float, maximum: float, unit: str) -> Callable[[str], float]:
    """Return the type of an option whose value is a number within bounds."""

    def read(text: str) -> float:
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not minimum <= value <= maximum:
            bounds = f"from {minimum:g} to {maximum:g} {unit}"
            raise argparse.ArgumentTypeError(f"must be {bounds}, not {text[:60]!r}")
        return value

    return read


port_number = whole_number(1, 65535)


class _PrintCompletion(argparse.Action):
    """Prints the completion script of the program for a shell, and ends it."""

    def __call__(self, parser: Any, namespace: object, values: Any, option: Any = None) -> None:
        sys.stdout.write(script(values, parser.prog, parser.completion()))
        parser.exit(EXIT_OK)


class _ParserFound(BaseException):
    """Carries the parser of a verb out of its main function."""


def parser_in(main: Callable[[list[str]], object]) -> OptionParser:
    """Return the parser of a verb's main function, which ends where it parses its arguments."""
    try:
        main([_GIVE_PARSER])
    except _ParserFound as found:
        parser: OptionParser = found.args[0]
        return parser
    raise AssertionError(f"{main} parses no arguments")


class OptionParser(argparse.ArgumentParser):
    """Reports a wrong argument in one sentence, with the probable intention, and exits with 2.

    Descriptions and epilogs keep their line breaks. Parsers of verbs are of the same class. The
    parser of a program has ``--print-completion``.
    """

    def __init__(self, *args: Any, **options: Any) -> None:
        formatter = functools.partial(argparse.RawDescriptionHelpFormatter, width=80)
        options.setdefault("formatter_class", formatter)
        super().__init__(*args, **options)
        # "make run" and "main.py" are not commands that a shell completes.
        if not re.search(r"[ .]", self.prog):
            text = "print the completion script for a shell"
            self.add_argument(
                "--print-completion", action=_PrintCompletion, choices=SHELLS, help=text
            )

    def completion(self) -> Verb:
        return verb_of(self)

    def parse_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Return the values; ends the program at a mistake."""
        if args == [_GIVE_PARSER]:
            raise _ParserFound(self)
        values, unknown = self.parse_known_args(args, namespace)
        if unknown:
            parser = getattr(values, "parser", None) or self
            options = (each for each in parser._option_string_actions if each.startswith("--"))
            word = unknown[0].partition("=")[0]
            parser.error(f"unrecognized argument {word!r}{suggestion(word, options)}")
        return values

    def error(self, message: str) -> NoReturn:
        """Print the error and how to get help; exit with EXIT_USAGE."""
        text = f"{self.prog}: {message} ('{self.prog} --help' explains)"
        print_problems([UserError(text, "usage", program=self.prog)])
        self.exit(EXIT_USAGE)

    def _get_value(self, action: argparse.Action, arg_string: str) -> Any:
        # Path("") is the current folder, and an empty text often an unset variable of a script.
        if action.type is Path and not arg_string:
            raise argparse.ArgumentError(action, "the path is empty")
        return super()._get_value(action, arg_string)

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        choices: Iterable[Any] | None = action.choices
        if choices is not None and value not in choices:
            known = [str(each) for each in choices]
            hint = suggestion(str(value), known) or f" (choose from {', '.join(known)})"
            raise argparse.ArgumentError(action, f"invalid choice {str(value)[:60]!r}{hint}")
