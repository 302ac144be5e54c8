"""The Command: a named, typed and validated message (thesis 4.1.4)."""

import dataclasses
import types
import typing
from collections.abc import Callable, Iterable, Mapping
from typing import Any, ClassVar, Self, TypeVar

from up.commands.roles import Role
from up.fields import Constraint, type_of
from up.quick_dataclass import dataclass

_T = TypeVar("_T", bound="BaseCommand")
RolesWhere = Mapping[str, Mapping[Any, frozenset[Role]]]
"""The roles that may send a Command whose field of that name has that value."""


class InvalidCommandError(ValueError):
    """A Command's data violate its definition; the text names the field."""


@dataclass(frozen=True, slots=True)
class WireFields:
    """A frozen, slotted dataclass whose fields are declared by ``value``: checked data of JSON."""

    @property
    def data(self) -> dict[str, Any]:
        return {key: _plain(getattr(self, name)) for name, key, _ in wire_fields(type(self))}

    @classmethod
    def from_data(cls, data: Mapping[str, Any]) -> Self:
        """Build it from decoded JSON; a default stands for what is absent.

        Raises InvalidCommandError with one sentence that names the field.
        """
        values: dict[str, Any] = {}
        for name, key, check in wire_fields(cls):
            try:
                values[name] = check(data.get(key, _ABSENT))
            except ValueError as error:
                raise InvalidCommandError(f"{key} {error}") from None
        try:
            return cls(**{n: v for n, v in values.items() if v is not _ABSENT})
        except ValueError as error:
            raise InvalidCommandError(str(error)) from None


@dataclass(frozen=True, slots=True)
class BaseCommand(WireFields):
    """The base of every Command: subclass it as a frozen, slotted dataclass.

    ``NAME`` is the name on the wire, ``ALIASES`` its older names, ``TITLE`` what a person calls it
    (``{}`` is the value of its field; empty: its name), ``ROLES`` the roles that may send
    it from outside (empty: none), ``ROLES_WHERE`` those for a value of a field, ``ROUTE`` the link
    to which it is forwarded instead of being handled here, ``NEEDS_BEACON`` whether it must echo a
    fresh beacon, ``NEEDS_CONTROL`` whether only one module at a time may publish it
    (``PublisherControl``).
    """

    NAME: ClassVar[str] = ""
    ALIASES: ClassVar[tuple[str, ...]] = ()
    TITLE: ClassVar[str] = ""
    ROLES: ClassVar[frozenset[Role]] = frozenset()
    ROLES_WHERE: ClassVar[RolesWhere] = types.MappingProxyType({})
    ROUTE: ClassVar[str] = ""
    NEEDS_BEACON: ClassVar[bool] = False
    NEEDS_CONTROL: ClassVar[bool] = False

    def roles(self) -> frozenset[Role]:
        """Return the roles that may send this instance."""
        for name, roles in self.ROLES_WHERE.items():
            if (given := getattr(self, name)) in roles:
                return roles[given]
        return self.ROLES

    @property
    def name(self) -> str:
        return self.NAME


_ABSENT: Any = object()
_Check = Callable[[Any], Any]
_plans: dict[type, tuple[tuple[str, str, _Check], ...]] = {}


def value(
    default: Any = dataclasses.MISSING,
    *,
    key: str = "",
    unit: str = "",
    minimum: float | None = None,
    maximum: float | None = None,
    choices: Iterable[Any] | None = None,
    max_length: int | None = None,
) -> Any:
    """Declare a field of a Command: its name on the wire, its unit and its bounds.

    The type comes from the annotation; ``X | None`` allows null. A field without a default is
    required.
    """
    bounds = {
        "unit": unit,
        "minimum": minimum,
        "maximum": maximum,
        "max_length": max_length,
        "choices": None if choices is None else tuple(choices),
    }
    return dataclasses.field(default=default, metadata={"key": key, "bounds": bounds})


def wire_fields(cls: type[WireFields]) -> tuple[tuple[str, str, _Check], ...]:
    """Return (attribute, name on the wire, check) for every field; computed once per class."""
    plan = _plans.get(cls)
    if plan is None:
        fields = dataclasses.fields(cls)
        hints = {field.name: type_of(cls, field) for field in fields}
        plan = _plans[cls] = tuple(
            (field.name, field.metadata.get("key") or field.name, _checker(field, hints))
            for field in fields
        )
    return plan


def _checker(field: dataclasses.Field[Any], hints: Mapping[str, Any]) -> _Check:
    constraint = constraint_of(field, hints)
    required = field.default is dataclasses.MISSING and field.default_factory is dataclasses.MISSING
    check = constraint.check

    def checked(given: Any) -> Any:
        if given is _ABSENT:
            if required:
                raise ValueError("is missing")
            return _ABSENT
        checked_value = check(given)
        return tuple(checked_value) if isinstance(checked_value, list) else checked_value

    return checked


def constraint_of(field: dataclasses.Field[Any], hints: Mapping[str, Any]) -> Constraint:
    """Return the constraint of a field's annotation and bounds."""
    hint = hints[field.name]
    arguments = typing.get_args(hint)
    nullable = isinstance(hint, types.UnionType) and type(None) in arguments
    if nullable:
        hint = next(each for each in arguments if each is not type(None))
    kind = typing.get_origin(hint) or hint
    if kind is tuple:
        kind = list
    return Constraint(kind, nullable=nullable, **field.metadata.get("bounds", {}))


def _plain(given: Any) -> Any:
    return list(given) if isinstance(given, tuple) else given
