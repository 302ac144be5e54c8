"""``up-sim new``: write a commented scenario of your own."""

from __future__ import annotations

import importlib.resources
import sys
from collections.abc import Sequence
from pathlib import Path

from up.cli.cli_error import CliError, UsageError
from up_simulator.verbs.catalogue import HELD, verb_parser

TEMPLATE = "template.yml"
EPILOG = """\
The file flies and passes without a change.

examples:
  up-sim new first-flight             writes first-flight.yml
  up-sim new flights/steep-turns.yml  into an existing folder"""


def main(arguments: Sequence[str]) -> int:
    """Write the file; return the exit status."""
    parser = verb_parser(
        "new", "Writes a scenario with a comment at every key that it uses.", EPILOG
    )
    parser.add_argument("name", metavar="NAME", help="of the scenario, or the path of its file")
    path = _path(parser.parse_args(arguments).name)
    template = importlib.resources.files("up_simulator.scenario").joinpath(TEMPLATE)
    text = template.read_text(encoding="utf-8").replace("TITLE", _title(path))
    try:
        path.open("x").close()
    except FileExistsError:
        raise UsageError(f"{path} exists: choose another name", "exists") from None
    except FileNotFoundError:
        raise UsageError(f"{path.parent} is not a folder", "no_such_folder") from None
    try:
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        path.unlink()
        raise CliError(f"cannot write {path}: {error.strerror}", code="cannot_write") from None
    sys.stdout.write(f"{path} is written. Fly it:\n  up-sim fly {path}\n")
    return HELD


def _path(name: str) -> Path:
    path = Path(name)
    if path.suffix not in (".yml", ".yaml"):
        path = path.with_name(f"{path.name}.yml") if path.name else path
    if not path.stem.replace("-", "").replace("_", "").isalnum():
        raise UsageError(
            f"{name[:80]!r} cannot name a file: use letters, digits, - and _", "bad_name"
        )
    return path


def _title(path: Path) -> str:
    words = path.stem.replace("-", " ").replace("_", " ")
    title = words[:1].upper() + words[1:]
    return f'"{title}"' if not title[0].isalpha() else title
