"""The schema of a configuration file, declared as frozen dataclasses.

`key`, `section`, `mapping` and `items` take the place of a dataclass field's default; `schema_of`
reads them back as a tree for the validator, the template and the schema.
"""

from __future__ import annotations

import dataclasses
import inspect
import types
import typing
from collections.abc import Iterable, Mapping
from typing import Any, TypeVar, cast

from up.fields import Constraint, show, type_of
from up.quick_dataclass import dataclass

T = TypeVar("T")
V = TypeVar("V")
_METADATA = "up.config"


@dataclass(frozen=True, slots=True)
class Schema:
    """A map with known keys, read into an instance of the dataclass `cls`."""

    cls: type[Any]
    comment: str
    entries: tuple[Entry, ...]

    def defaults(self) -> Any:
        return self.cls()


@dataclass(frozen=True, slots=True)
class MapOf:
    """A map with free keys, read into a dict."""

    key: Constraint
    value: Spec
    max_length: int | None


@dataclass(frozen=True, slots=True)
class ListOf:
    """A list, read into a tuple."""

    item: Spec
    max_length: int | None


Spec = Constraint | Schema | MapOf | ListOf


@dataclass(frozen=True, slots=True)
class Entry:
    """One key of a Schema: its attribute, its constraint and its description."""

    attribute: str
    name: str
    comment: str
    spec: Spec
    default: Any
    replaced: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class _Declared:
    """The declaration of a dataclass field; for a key before its annotation is known."""

    comment: str
    name: str | None
    spec: Spec | None = None
    bounds: Mapping[str, Any] = dataclasses.field(default_factory=dict)
    replaced: tuple[str, ...] = ()


def key(
    default: T,
    comment: str,
    *,
    name: str | None = None,
    unit: str = "",
    minimum: float | None = None,
    maximum: float | None = None,
    choices: tuple[Any, ...] | None = None,
    max_length: int | None = None,
    ignore_case: bool = False,
    is_secret: bool = False,
    replaced: tuple[str, ...] = (),
) -> T:
    """Declare a key with one value, whose type is the field's annotation (`X | None`: nullable).

    The value of one that `is_secret` is not part of the dataclass's text.

    In the file its name is `name`, otherwise the attribute's. `replaced` lists its former names:
    they are refused with a sentence that gives the new one.
    """
    bounds = {
        "unit": unit,
        "minimum": minimum,
        "maximum": maximum,
        "choices": choices,
        "max_length": max_length,
        "ignore_case": ignore_case,
    }
    metadata = {_METADATA: _Declared(comment, name, None, bounds, replaced)}
    return dataclasses.field(default=default, repr=not is_secret, metadata=metadata)


def section(
    cls: type[T],
    comment: str = "",
    *,
    name: str | None = None,
    optional: bool = False,
) -> T:
    """Declare a map with known keys, itself a dataclass; an absent `optional` one reads as None."""
    declared = _Declared(comment, name, schema_of(cls))
    factory: Any = (lambda: None) if optional else cls
    return cast(T, dataclasses.field(default_factory=factory, metadata={_METADATA: declared}))


def mapping(
    key: Constraint,
    value: Constraint | type[V] | MapOf | ListOf,
    comment: str,
    *,
    default: Mapping[str, Any] | None = None,
    name: str | None = None,
    max_length: int | None = 1000,
) -> Any:
    """Declare a map with free keys, read into a dict; in a file it replaces the whole default."""
    declared = _Declared(comment, name, MapOf(key, _spec_of(value), max_length))
    start = dict(default or {})
    return dataclasses.field(default_factory=lambda: dict(start), metadata={_METADATA: declared})


def items(
    item: Constraint | type[V] | MapOf | ListOf,
    comment: str,
    *,
    default: Iterable[Any] = (),
    name: str | None = None,
    max_length: int | None = 1000,
) -> Any:
    """Declare a list, read into a tuple; in a file it replaces the whole default."""
    declared = _Declared(comment, name, ListOf(_spec_of(item), max_length))
    return dataclasses.field(default=tuple(default), metadata={_METADATA: declared})


def schema_of(cls: type[Any]) -> Schema:
    """Return the schema that a frozen dataclass declares.

    Raises TypeError for an invalid declaration and ValueError for a default that violates its own
    constraint: both are programming errors.
    """
    if not dataclasses.is_dataclass(cls):
        raise TypeError(f"{cls.__qualname__} is not a dataclass")
    entries = tuple(_entry_of(cls, field) for field in dataclasses.fields(cls))
    names = [name for entry in entries for name in (entry.name, *entry.replaced)]
    if len(names) != len(set(names)):
        raise TypeError(f"{cls.__qualname__} gives one name to two keys")
    return Schema(cls, _doc_of(cls), entries)


def _entry_of(cls: type[Any], field: dataclasses.Field[Any]) -> Entry:
    where = f"{cls.__qualname__}.{field.name}"
    declared = field.metadata.get(_METADATA)
    if not isinstance(declared, _Declared):
        raise TypeError(f"{where} is not declared with key, section, mapping or items")
    default = field.default_factory() if callable(field.default_factory) else field.default
    spec, comment = declared.spec, declared.comment
    if spec is None:
        spec = _constraint_of(cls, field, declared.bounds, where)
    if isinstance(spec, Schema):
        comment = comment or spec.comment
    else:
        try:
            _check_default(spec, default)
        except ValueError as error:
            raise ValueError(f"the default of {where} {error}") from None
    return Entry(field.name, declared.name or field.name, comment, spec, default, declared.replaced)


def _check_default(spec: Spec, value: Any) -> None:
    if isinstance(spec, Constraint):
        spec.check(value)
    elif isinstance(spec, Schema):
        if not isinstance(value, spec.cls):
            raise ValueError(f"must be a {spec.cls.__name__}, not {show(value)}")
    elif isinstance(spec, MapOf):
        for name, inner in value.items():
            spec.key.check(name)
            _check_default(spec.value, inner)
    else:
        for inner in value:
            _check_default(spec.item, inner)


def _constraint_of(
    cls: type[Any], field: dataclasses.Field[Any], bounds: Mapping[str, Any], where: str
) -> Constraint:
    annotation = type_of(cls, field)
    arguments = dict(bounds)
    members = typing.get_args(annotation)
    if types.NoneType in members:
        arguments["nullable"] = True
        rest = [member for member in members if member is not types.NoneType]
        annotation = rest[0] if len(rest) == 1 else annotation
    if typing.get_origin(annotation) is typing.Literal:
        choices = typing.get_args(annotation)
        arguments["choices"] = choices
        annotation = type(choices[0])
    if annotation not in (bool, int, float, str):
        raise TypeError(f"{where}: a key is a bool, int, float or str, not {annotation!r}")
    return Constraint(annotation, **arguments)


def _spec_of(value: Constraint | type[Any] | MapOf | ListOf) -> Spec:
    return schema_of(value) if isinstance(value, type) else value


def _doc_of(cls: type[Any]) -> str:
    # A dataclass without a docstring gets its signature as one; that is not a comment.
    doc = inspect.cleandoc(cls.__doc__ or "")
    return "" if doc.startswith(f"{cls.__name__}(") else doc


def plain_value(spec: Spec, value: Any) -> Any:
    """Return a value as JSON and YAML types, with the file's key names; None stays None."""
    if value is None:
        return None
    if isinstance(spec, Schema):
        return {
            entry.name: plain_value(entry.spec, getattr(value, entry.attribute))
            for entry in spec.entries
        }
    if isinstance(spec, MapOf):
        return {name: plain_value(spec.value, inner) for name, inner in value.items()}
    if isinstance(spec, ListOf):
        return [plain_value(spec.item, inner) for inner in value]
    return value
