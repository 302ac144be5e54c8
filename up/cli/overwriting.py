"""Whether something that is there may be overwritten."""

from __future__ import annotations

import sys
from pathlib import Path

from up.cli.cli_error import CliError


def may_overwrite(path: Path, yes: bool) -> bool:
    """Ask the user, as the prototype did: y(es), n(o) or c(ancel).

    Raises CliError where nobody can be asked.
    """
    if yes:
        return True
    if not sys.stdin.isatty():
        raise CliError(f"{path} is there already: say --yes to overwrite it")
    while True:
        try:
            answer = input(f"{path} is there already. Overwrite it? (y)es, (n)o, (c)ancel: ")
        except EOFError:
            return False
        answer = answer.strip().lower()
        if answer in ("y", "yes"):
            return True
        if answer in ("n", "no", "c", "cancel"):
            return False
