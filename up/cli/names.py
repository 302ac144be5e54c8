"""A user-supplied name in the forms for files, classes and distributions."""

from __future__ import annotations

import keyword
import re
import sys

from up.cli.cli_error import UsageError
from up.quick_dataclass import dataclass

_GIVEN = re.compile(r"[A-Za-z][A-Za-z0-9_ -]*", re.ASCII)
_IDENTIFIER = re.compile(r"[a-z][a-z0-9_]*(\.[a-z0-9_]+)+", re.ASCII)
_WORD = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z0-9]+|[0-9]+")
_TAKEN = {"up", "raspilot", "twisted", "yaml", "serial", "psutil", "tests", "modules", "config"}
_MAX_NAME = 24
_MAX_IDENTIFIER = 45


@dataclass(frozen=True, slots=True)
class Name:
    """The words of a name."""

    words: tuple[str, ...]

    @classmethod
    def of(cls, given: str, ending: str = "") -> Name:
        """Read ``FuelGauge``, ``fuel_gauge``, ``fuel-gauge`` or ``fuel gauge``.

        Drops an ``ending`` that the generated name gets anyway. Raises UsageError.
        """
        words = tuple(word.lower() for word in _WORD.findall(given))
        if not _GIVEN.fullmatch(given) or len("_".join(words)) > _MAX_NAME:
            raise UsageError(
                f'"{given[:40]}" cannot be a name: use letters, digits and _, beginning with'
                " a letter, like FuelGauge",
                "name_invalid",
            )
        if len(words) > 1 and words[-1] == ending:
            words = words[:-1]
        if keyword.iskeyword("_".join(words)):
            raise UsageError(
                f'"{given}" cannot be a name: Python has another use for that word',
                "name_invalid",
            )
        return cls(words)

    @property
    def snake(self) -> str:
        """Return the name for files and packages: fuel_gauge."""
        return "_".join(self.words)

    @property
    def camel(self) -> str:
        return "".join(word.capitalize() for word in self.words)

    @property
    def text(self) -> str:
        """Return the name for sentences: Fuel gauge."""
        return " ".join(self.words).capitalize()

    def check_free(self) -> None:
        if self.snake in _TAKEN or self.snake in sys.stdlib_module_names:
            raise UsageError(
                f"{self.snake} is the name of another Python package: choose one more",
                "name_taken",
            )


def check_identifier(identifier: str) -> str:
    """Return a Command's name; raises UsageError for an invalid or taken name."""
    from up.commands.builtin import BUILTIN_COMMANDS

    if not _IDENTIFIER.fullmatch(identifier) or len(identifier) > _MAX_IDENTIFIER:
        raise UsageError(
            f'"{identifier[:40]}" cannot name a Command: use at most {_MAX_IDENTIFIER}'
            " characters, words with dots between, like plane.bay.open",
            "name_invalid",
        )
    for cls in BUILTIN_COMMANDS:
        if identifier in (cls.NAME, *cls.ALIASES):
            raise UsageError(
                f"{identifier} is a Command of Up ({cls.__name__}): choose another name",
                "name_taken",
            )
    return identifier
