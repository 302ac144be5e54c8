"""Problems of configuration files, with their codes and places, for people to fix."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from up.errors import UserError
from up.fields import printable
from up.quick_dataclass import dataclass

MAX_PROBLEMS = 100
CODES = {
    "bad_format": "The text does not have the form that the key needs.",
    "cannot_read": "The operating system does not let the program read the file.",
    "cut_short": "A file of learned values lacks its last line.",
    "file_empty": "A file that must hold a whole set of values is empty.",
    "file_too_large": "More than 1 MiB, 50000 values or 20 levels.",
    "inconsistent": "The value contradicts another key.",
    "key_missing": "A set of values that is valid only as a whole lacks a key.",
    "key_removed": "The key is no longer used; the text names its replacement.",
    "key_renamed": "The key has a new name, which the text gives.",
    "key_repeated": "The key occurs twice.",
    "more_problems": "The file has more problems than are listed.",
    "needs_quotes": "YAML does not read the text as text.",
    "not_a_file": "The path leads to a folder, a device or nothing.",
    "not_finite": "The number is infinite or not a number.",
    "not_supported": "An anchor, an alias, a tag or a second document.",
    "not_utf8": "The file is not UTF-8 text.",
    "not_yaml": "The syntax is wrong; often it is the indentation.",
    "out_of_range": "The number is too small or too large.",
    "package_missing": "The value needs a Python package that is not installed.",
    "secrets_readable": "Other users may read a file of secrets.",
    "source_missing": "The folder of a cog has neither setup.py nor pyproject.toml.",
    "source_unclear": "A cog has no source, or several.",
    "too_long": "The text, list or map is too long.",
    "unknown_choice": "The value is not among the permitted ones.",
    "unsigned": "Strangers could send Commands: the link has no signatures.",
    "unknown_key": "The file has no such key.",
    "value_missing": "The key has no value.",
    "wrong_type": "Text instead of a number, a list instead of a map, and the like.",
}
"""The code of every problem, with its meaning."""


@dataclass(frozen=True, slots=True)
class ConfigProblem:
    """One error in one file: `line` and `column` count from 1, `key` is the dotted name."""

    path: Path
    line: int
    column: int
    what: str
    code: str = "inconsistent"
    key: str = ""
    value: str = ""

    def __str__(self) -> str:
        return f"{printable(str(self.path))}:{self.line}:{self.column}: {self.what}"

    @property
    def fields(self) -> Mapping[str, Any]:
        return {
            "file": str(self.path),
            "line": self.line,
            "column": self.column,
            "key": self.key,
            "value": self.value,
        }


class ConfigErrors(UserError):  # noqa: N818 - it holds several errors
    """All the problems that were found in one or more configuration files, one line each."""

    status = 2

    def __init__(self, problems: Sequence[ConfigProblem]) -> None:
        super().__init__("\n".join(map(str, problems)), problems[0].code)
        self._found = problems

    @property
    def problems(self) -> Sequence[ConfigProblem]:
        return self._found


class Problems:
    """Collects the problems of one file: at most MAX_PROBLEMS and a note that there are more."""

    def __init__(self, path: Path) -> None:
        self.found: list[ConfigProblem] = []
        self._path = path

    def report(
        self,
        line: int,
        column: int,
        what: str,
        code: str = "inconsistent",
        key: str = "",
        value: str = "",
    ) -> None:
        if len(self.found) == MAX_PROBLEMS:
            what = f"more than {MAX_PROBLEMS} problems, the rest is not shown"
            code, key, value = "more_problems", "", ""
        if len(self.found) <= MAX_PROBLEMS:
            problem = ConfigProblem(self._path, line, column, what, code, key, value)
            self.found.append(problem)

    def raise_if_any(self) -> None:
        """Raise ConfigErrors if there are problems, in the order of the file."""
        if self.found:
            raise ConfigErrors(sorted(self.found, key=lambda each: (each.line, each.column)))
