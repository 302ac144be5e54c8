"""A YAML file whose top level is a map with free keys, such as a list of cogs."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Generic, TypeVar

from up.config.loader import read_text
from up.config.nodes import compose
from up.config.problems import Problems
from up.config.scalars import is_null
from up.config.schema import MapOf, schema_of
from up.config.validator import Validator
from up.fields import Constraint

V = TypeVar("V")
_GREATEST_LENGTH = 1000


@dataclass(frozen=True, slots=True, eq=False)
class MapFile(Generic[V]):
    """A file that maps names to entries, each read into the frozen dataclass ``cls``."""

    filename: str
    cls: type[V]
    key: Constraint = field(default_factory=lambda: Constraint(str, max_length=100))

    def load(self, folder: Path) -> dict[str, V]:
        """Return the entries in the order of the file; none for a missing or empty file.

        Raises ConfigErrors with every problem of the file.
        """
        path = Path(folder) / self.filename
        problems = Problems(path)
        text = read_text(path, problems.report)
        entries: dict[str, V] = {}
        if text is not None:
            root = compose(text, problems.report)
            if root is not None and not is_null(root):
                spec: Any = MapOf(self.key, schema_of(self.cls), _GREATEST_LENGTH)
                entries = Validator(problems.report, {}).read(spec, root)
        problems.raise_if_any()
        return entries
