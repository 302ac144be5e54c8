"""The parser base of the programs: one-sentence errors with a suggestion, exit status 2."""

from __future__ import annotations

import argparse
import difflib
import functools
from collections.abc import Iterable, Sequence
from typing import Any, NoReturn

WRONG_INPUT = 2
WIDTH = 80
_MAX_COMPARED = 80


def suggestion(wrong: str, known: Iterable[str], otherwise: str = "", cutoff: float = 0.6) -> str:
    """Return "did you mean 'NAME'?" with the nearest known name, or ``otherwise``."""
    near = difflib.get_close_matches(wrong[:_MAX_COMPARED], list(known), n=1, cutoff=cutoff)
    return f"did you mean {near[0]!r}?" if near else otherwise


class OptionParser(argparse.ArgumentParser):
    """Ends the program with status 2 and one sentence on standard error at a wrong option.

    Options are not abbreviated; description and epilog keep their lines.
    """

    def __init__(self, **settings: Any) -> None:
        formatter = functools.partial(argparse.RawDescriptionHelpFormatter, width=WIDTH)
        settings = {"formatter_class": formatter, "allow_abbrev": False, **settings}
        super().__init__(**settings)

    def error(self, message: str) -> NoReturn:
        """Report the error."""
        self.exit(WRONG_INPUT, f"{self.prog}: {message}\n")

    def parse_args(  # type: ignore[override]
        self, args: Sequence[str] | None = None, namespace: argparse.Namespace | None = None
    ) -> argparse.Namespace:
        """Parse, with a suggestion for an unknown option."""
        options, unknown = self.parse_known_args(args, namespace)
        if unknown:
            known = [each for each in self._option_string_actions if each.startswith("--")]
            help_ = f"'{self.prog} --help' lists the options"
            hint = suggestion(unknown[0].partition("=")[0], known, help_, cutoff=0.7)
            self.error(f"unrecognized arguments: {' '.join(unknown)}; {hint}")
        return options

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        if action.choices is None or value in action.choices:
            return
        choices = [str(each) for each in action.choices]
        hint = suggestion(str(value), choices)
        text = f"invalid choice: {str(value)[:_MAX_COMPARED]!r} (choose from {', '.join(choices)})"
        raise argparse.ArgumentError(action, f"{text}; {hint}" if hint else text)
