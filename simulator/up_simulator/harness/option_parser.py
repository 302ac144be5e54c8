"""A parser of options whose errors are one sentence, with a suggestion where something is near."""

from __future__ import annotations

import argparse
import difflib
import re
import sys
from typing import NoReturn

WRONG_INPUT = 2
_CHOICE = re.compile(r"invalid choice: '(?P<word>.*?)' \(choose from (?P<known>.*)\)")
_UNKNOWN = re.compile(r"unrecognized arguments: (?P<word>[^\s=]+)")


class OptionParser(argparse.ArgumentParser):
    """Ends the program with status 2 and one sentence on standard error at a wrong option."""

    def error(self, message: str) -> NoReturn:
        """Report the error, with the probable intention."""
        sys.stderr.write(f"{self.prog}: {message}{self._hint(message)}\n")
        raise SystemExit(WRONG_INPUT)

    def _hint(self, message: str) -> str:
        if choice := _CHOICE.search(message):
            known = re.findall(r"'([^']+)'", choice["known"])
            near = difflib.get_close_matches(choice["word"][:60], known, n=1)
            return f", did you mean {near[0]!r}?" if near else ""
        if unknown := _UNKNOWN.search(message):
            options = [each for each in self._option_string_actions if each.startswith("--")]
            near = difflib.get_close_matches(unknown["word"][:60], options, n=1, cutoff=0.7)
            return f", did you mean {near[0]}?" if near else f" ('{self.prog} --help' lists them)"
        return ""
