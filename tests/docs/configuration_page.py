"""Writes the tables of docs/configuration.md: ``python -m tests.docs.configuration_page``."""

from __future__ import annotations

import argparse
import ast
import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from up.cli.verbs import cog_files, system_of
from up.config import ConfigFile
from up.config.application import DISABLED_MODULES
from up.config.problems import CODES
from up.config.schema import Entry, ListOf, MapOf, Schema, plain_value
from up.config.template import yaml_scalar
from up.fields import Constraint, number_text
from up.flight_controller.pids_file import PIDS
from up.loading.application import UP_FILE_CONFIG
from up.loading.checking import check_application
from up_cluster.config import FLEET
from up_proxy.config import PROXY
from up_runner.config import RUNNER

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "configuration.md"
_ERRORS = (
    "output.py",
    "cli/*.py",
    "cogs/*.py",
    "config/file.py",
    "loading/*.py",
    "program.py",
    "life_cycle.py",
    "registrar.py",
)
_ERROR = re.compile(r"Error$|(^|\.)_?(problem|problem_of|cog_error|import_error)$|LoadProblem$")
_CODE = re.compile(r"[a-z]+(_[a-z]+)+|usage|exists|locked|interrupted")
BEGIN = "<!-- tables: begin -->\n"
END = "<!-- tables: end -->\n"


def configuration_files() -> list[ConfigFile[Any]]:
    """Every file that Up, Raspilot, its cogs and the programs read, by name; config.yml first."""
    system = system_of(argparse.Namespace(file=str(ROOT / "raspilot"), config=None, mode=None))
    more = (DISABLED_MODULES, PIDS, FLEET, PROXY, RUNNER, *cog_files(system.application))
    found = check_application(system.application, system.context, more).files
    named = {file.filename: file for file in found if file is not UP_FILE_CONFIG}
    first = ["config.yml", "disabled_modules.yml", "providers.yml"]
    return [named[name] for name in [*first, *sorted(set(named) - set(first))]]


def tables() -> str:
    """Return the generated part of the page."""
    files = [line for file in configuration_files() for line in _table(file)]
    codes = [f"| `{code}` | {meaning} |" for code, meaning in CODES.items()]
    return "\n".join([*files, "## Codes of a file's problems\n", "| code | |", "|---|---|", *codes])


def error_codes() -> set[str]:
    """Return the codes of the other errors that a start and ``up`` report, from their source."""
    found: set[str] = set()
    for path in (path for each in _ERRORS for path in sorted((ROOT / "up").glob(each))):
        for call in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if not isinstance(call, ast.Call) or not _ERROR.search(ast.unparse(call.func)):
                continue
            given = [*call.args[1:], *(each.value for each in call.keywords if each.arg == "code")]
            texts = [each.value for each in given if isinstance(each, ast.Constant)]
            found.update(each for each in texts if isinstance(each, str) and _CODE.fullmatch(each))
    return found - set(CODES)


def documented_error_codes() -> set[str]:
    """Return the codes in the page's table of other errors."""
    text = PAGE.read_text(encoding="utf-8").partition("## Codes of other errors\n")[2]
    return set(re.findall(r"`([a-z]+(?:_[a-z]+)*)`", text.partition("\n\n<!-- codes: end")[0]))


def keys_of(schema: Schema, above: str = "") -> Iterator[str]:
    """Yield every key of a file, those of sections as ``section: key``."""
    for entry in schema.entries:
        yield above + entry.name
        if isinstance(entry.spec, Schema):
            yield from keys_of(entry.spec, f"{above}{entry.name}: ")


def _table(file: ConfigFile[Any]) -> Iterator[str]:
    yield f"## {file.filename}\n"
    yield f"{' '.join(file.schema.comment.split())}\n"
    yield "| key | default | unit, range | |"
    yield "|---|---|---|---|"
    yield from _rows(file.schema.entries, "")
    yield ""


def _rows(entries: Iterable[Entry], above: str) -> Iterator[str]:
    for entry in entries:
        comment = " ".join(entry.comment.split()).replace("|", "\\|")
        name = f"`{above}{entry.name}`"
        if isinstance(entry.spec, Schema):
            yield f"| {name} | | | {comment} |"
            yield from _rows(entry.spec.entries, f"{above}{entry.name}: ")
        else:
            yield f"| {name} | {_default(entry)} | {_bounds(entry)} | {comment} |"


def _default(entry: Entry) -> str:
    value = plain_value(entry.spec, entry.default)
    if isinstance(value, dict):
        return ", ".join(f"`{each}`" for each in value) or "none"
    if isinstance(value, list):
        return ", ".join(f"`{each}`" for each in value) or "none"
    return "empty" if value == "" else f"`{yaml_scalar(value)}`"


def _bounds(entry: Entry) -> str:
    spec = entry.spec
    if isinstance(spec, ListOf | MapOf):
        return f"at most {spec.max_length} entries"
    if not isinstance(spec, Constraint):
        return ""
    if spec.type_ is bool:
        return "true, false" + (", null" if spec.nullable else "")
    if spec.choices is not None:
        return ", ".join(yaml_scalar(choice) for choice in spec.choices)
    parts = [spec.unit] if spec.unit else []
    if spec.minimum is not None and spec.maximum is not None:
        parts.append(f"{number_text(spec.minimum)} to {number_text(spec.maximum)}")
    elif spec.minimum is not None:
        parts.append(f"at least {number_text(spec.minimum)}")
    if spec.nullable:
        parts.append("null")
    return ", ".join(parts)


def main() -> None:
    """Write the page's tables again."""
    head, _, rest = PAGE.read_text(encoding="utf-8").partition(BEGIN)
    _, _, tail = rest.partition(END)
    PAGE.write_text(f"{head}{BEGIN}\n{tables()}\n{END}{tail}", encoding="utf-8")


if __name__ == "__main__":
    main()
