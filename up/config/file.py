"""A configuration file: its name, its schema, and how it is read and written."""

from collections.abc import Iterable, Mapping
from dataclasses import field
from pathlib import Path
from typing import Any, Generic, TypeVar

from up.config.loader import decode, read_text
from up.config.nodes import Node, Report, compose
from up.config.problems import ConfigErrors, ConfigProblem, Problems
from up.config.scalars import is_null
from up.config.schema import Entry, ListOf, MapOf, Schema, Spec, plain_value, schema_of
from up.config.template import template_of
from up.config.validator import Validator
from up.errors import UserError
from up.fields import Constraint
from up.quick_dataclass import dataclass

T = TypeVar("T")


@dataclass(frozen=True, slots=True, eq=False)
class ConfigFile(Generic[T]):
    """One YAML file of a configuration folder, read into the frozen dataclass `cls`.

    ``removed`` maps an old key (dotted inside a section) that is no longer used, or has another
    meaning, to the sentence that names its replacement; ``ignored`` maps one that has no effect any
    more to the sentence why: it is no mistake. Only its owner may read a file that `is_secret`.
    Raises TypeError or ValueError when `cls` is declared wrongly.
    """

    filename: str
    cls: type[T]
    removed: Mapping[str, str] = field(default_factory=dict)
    ignored: Mapping[str, str] = field(default_factory=dict)
    is_secret: bool = False
    schema: Schema = field(init=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "schema", schema_of(self.cls))

    def load(self, folder: Path) -> T:
        """Return the values of the file in `folder`, or the defaults if it does not exist.

        Raises ConfigErrors with every problem of the file.
        """
        path = Path(folder) / self.filename
        problems = Problems(path)
        text = read_text(path, problems.report)
        if text is not None and self.is_secret and path.stat().st_mode & 0o077:
            what = f"others may read these secrets: run 'chmod 600 {path}'"
            problems.report(1, 1, what, "secrets_readable")
        value = self.cls() if text is None else self._parse(text, problems, whole=False)
        problems.raise_if_any()
        return value

    def ignored_keys(self, folder: Path) -> list[ConfigProblem]:
        """Return the keys of the file in `folder` that no longer have an effect, for a warning."""
        path = Path(folder) / self.filename
        problems = Problems(path)
        root = read_tree(path, problems.report) if self.ignored else None
        if root is not None:
            Validator(problems.report, dict(self.ignored)).read(self.schema, root)
        return [each for each in problems.found if each.key in self.ignored]

    def parse(self, text: str | bytes, path: Path, *, whole: bool = False) -> T:
        """Return the values in a text; `path` appears only in problems. Raises ConfigErrors.

        With `whole` the text must not be empty and every map in it must be complete: half a set of
        related numbers is refused.
        """
        problems = Problems(Path(path))
        if isinstance(text, bytes):
            text = decode(text, problems.report) or ""
        value = None if problems.found else self._parse(text, problems, whole)
        problems.raise_if_any()
        return value  # type: ignore[return-value]

    def template(self) -> str:
        return self.render(self.cls())

    def render(self, values: T) -> str:
        return template_of(self.schema, values)

    def json_schema(self) -> dict[str, Any]:
        """Return the JSON Schema (draft 2020-12) of the file, for editors."""
        return {"$schema": _DRAFT, "title": self.filename, **_schema(self.schema)}

    def _parse(self, text: str, problems: Problems, whole: bool) -> T:
        root = compose(text, problems.report)
        if root is None or is_null(root):
            if whole and not problems.found:
                problems.report(1, 1, "is empty", "file_empty")
            return self.cls()
        removed = {**self.removed, **dict.fromkeys(self.ignored, "")}
        value: T = Validator(problems.report, removed, whole).read(self.schema, root)
        return value


def load_all(folder: Path, files: Iterable[ConfigFile[Any]]) -> dict[ConfigFile[Any], Any]:
    """Return the values of all files; raises ConfigErrors once, with the problems of all."""
    values: dict[ConfigFile[Any], Any] = {}
    problems: list[ConfigProblem] = []
    for file in files:
        try:
            values[file] = file.load(folder)
        except ConfigErrors as errors:
            problems.extend(errors.problems)
    if problems:
        raise ConfigErrors(problems)
    return values


def no_configuration(
    folder: Path,
    files: Iterable[ConfigFile[Any]],
    advice: str = "start with --defaults to use the defaults",
) -> UserError | None:
    """Return the error for a folder without any of the files: its name is perhaps mistyped."""
    if any((folder / file.filename).exists() for file in files):
        return None
    text = f"{folder}: no configuration file is here; {advice}"
    return UserError(text, "no_configuration", folder=folder)


def unknown_files(folder: Path, files: Iterable[ConfigFile[Any]]) -> list[Path]:
    """Return the YAML files of the folder that no ConfigFile reads, sorted, for a warning."""
    known = {file.filename for file in files}
    try:
        found = sorted(Path(folder).iterdir())
    except OSError:
        return []
    return [path for path in found if path.suffix in (".yml", ".yaml") and path.name not in known]


_DRAFT = "https://json-schema.org/draft/2020-12/schema"


def _schema(spec: Spec) -> dict[str, Any]:
    if isinstance(spec, Constraint):
        return spec.json_schema()
    if isinstance(spec, ListOf):
        schema: dict[str, Any] = {"type": "array", "items": _schema(spec.item)}
        if spec.max_length is not None:
            schema["maxItems"] = spec.max_length
        return schema
    if isinstance(spec, MapOf):
        schema = {"type": "object", "additionalProperties": _schema(spec.value)}
        schema["propertyNames"] = spec.key.json_schema()
        if spec.max_length is not None:
            schema["maxProperties"] = spec.max_length
        return schema
    schema = {"type": "object", "additionalProperties": False}
    if spec.comment:
        schema["description"] = spec.comment
    schema["properties"] = {entry.name: _entry_schema(entry) for entry in spec.entries}
    return schema


def _entry_schema(entry: Entry) -> dict[str, Any]:
    schema = _schema(entry.spec)
    if entry.comment:
        schema["description"] = entry.comment
    if entry.default is not None or (isinstance(entry.spec, Constraint) and entry.spec.nullable):
        schema["default"] = plain_value(entry.spec, entry.default)
    return schema


V = TypeVar("V")
_MAX_ENTRIES = 1000


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
        root = read_tree(path, problems.report)
        entries: dict[str, V] = {}
        if root is not None:
            spec: Any = MapOf(self.key, schema_of(self.cls), _MAX_ENTRIES)
            entries = Validator(problems.report, {}).read(spec, root)
        problems.raise_if_any()
        return entries


def read_tree(path: Path, report: Report) -> Node | None:
    """Return the root of a file; None if it is missing or empty, or a problem was reported."""
    text = read_text(path, report)
    root = None if text is None else compose(text, report)
    return None if is_null(root) else root
