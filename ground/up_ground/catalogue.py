"""The Commands that this installation knows, as a ground and its pages see them."""

from __future__ import annotations

import dataclasses
import difflib
import importlib
import json
import pkgutil
import typing
from collections.abc import Collection, Iterable, Iterator, Mapping
from importlib.metadata import packages_distributions
from typing import Any

from up.commands.builtin import BUILTIN_COMMANDS
from up.commands.command import BaseCommand, InvalidCommandError, constraint_of
from up.commands.command_registry import CommandRegistry, DuplicateCommandError
from up.commands.roles import Role
from up.flight_log.command_schema import sentence_of

# An aircraft answers with them; a ground has nothing to answer.
_ANSWERS = ("up.ack", "up.nack")
GAINS = "arduino.pids.tunings"
_CONTENT_OF = {GAINS: "arduino.pids.values", "arduino.profile.request": "arduino.profile.values"}
_GROUND_ROLES = (Role.OBSERVER, Role.OPERATOR, Role.PILOT, Role.ADMIN)


class Catalogue:
    """Commands by name, with their fields; ``problems`` lists the omitted ones, a sentence each."""

    def __init__(self, classes: Iterable[type[BaseCommand]], problems: Iterable[str] = ()) -> None:
        self.problems = list(problems)
        self._registry = CommandRegistry()
        for cls in classes:
            try:
                self._registry.add(cls)
            except (ValueError, TypeError) as error:
                kind = "" if isinstance(error, DuplicateCommandError) else f"{cls.__name__}: "
                self.problems.append(f"{kind}{error}")

    @classmethod
    def installed(cls) -> Catalogue:
        """Return Up's own Commands and those of every cog that is installed here."""
        problems: list[str] = []
        return cls([*BUILTIN_COMMANDS, *_cog_commands(problems)], problems)

    def __iter__(self) -> Iterator[type[BaseCommand]]:
        return iter(self._registry)

    def get(self, name: str) -> type[BaseCommand] | None:
        return self._registry.get(name)

    def sendable(self) -> list[type[BaseCommand]]:
        """Return the Commands that a ground may send and an aircraft carries out, by name."""
        return [
            cls
            for cls in self._registry
            if least_role(_all_roles(cls)) and cls.NAME not in _ANSWERS
        ]

    def suggestions(self, name: str) -> list[str]:
        """Return names similar to a mistyped one, the nearest first."""
        names = {
            each.casefold(): each for cls in self.sendable() for each in (cls.NAME, *cls.ALIASES)
        }
        near = difflib.get_close_matches(name.casefold(), names, n=3, cutoff=0.6)
        within = [full for low, full in names.items() if name and name.casefold() in low]
        return list(dict.fromkeys([*(names[each] for each in near), *sorted(within)]))[:3]


def least_role(roles: Collection[Role]) -> str:
    """Return the least role of a ground among them; empty: none is a ground's."""
    return next((role.value for role in _GROUND_ROLES if role in roles), "")


def _all_roles(cls: type[BaseCommand]) -> frozenset[Role]:
    """Return the roles that may send it with some data."""
    special = (roles for values in cls.ROLES_WHERE.values() for roles in values.values())
    return cls.ROLES.union(*special)


def roles_text(cls: type[BaseCommand]) -> str:
    """Return who may send it from outside, in words."""
    special = (
        f"; {name} {json.dumps(given)}: {_words(roles)}"
        for name, values in cls.ROLES_WHERE.items()
        for given, roles in values.items()
    )
    return _words(cls.ROLES) + "".join(special)


def _words(roles: frozenset[Role]) -> str:
    if roles == frozenset(Role):
        return "any"
    least = next((f"{each.value} or more" for each in _GROUND_ROLES if each in roles), "")
    others = sorted(each.value for each in roles.difference(_GROUND_ROLES))
    return " or ".join(filter(None, (least, *others))) or "only modules"


def describe(cls: type[BaseCommand]) -> Iterator[str]:
    """Return the lines that teach a Command: its name, its role, its fields with their bounds."""
    role = roles_text(cls) if least_role(_all_roles(cls)) else "no ground may send it"
    yield f"{cls.NAME}   [{role}]"
    yield f"    {about(cls)}"
    if cls.ALIASES:
        yield f"    also called {', '.join(cls.ALIASES)}"
    if cls.NEEDS_BEACON:
        yield "    needs fresh telemetry: its beacon is echoed"
    hints = typing.get_type_hints(cls)
    for field in dataclasses.fields(cls):
        optional = field.default is not dataclasses.MISSING
        mark = "?" if optional else ""
        yield f"      {wire_name(field)}{mark:1}  {constraint_of(field, hints).describe()}"


def about(cls: type[BaseCommand]) -> str:
    """Return the purpose of a Command, one sentence."""
    return sentence_of(cls.__doc__)


def title_of(cls: type[BaseCommand] | None, name: str, data: Mapping[str, Any]) -> str:
    """Return what a person calls a Command, with the value of its only field."""
    title = (cls.TITLE if cls else "") or name
    value = str(*data.values()) if len(data) == 1 else ""
    return title.replace("{}", value.replace("_", " "))


def wire_name(field: dataclasses.Field[Any]) -> str:
    """Return a field's name on the wire."""
    return str(field.metadata.get("key") or field.name)


def requested_content(name: str, data: Mapping[str, Any]) -> str:
    """Return the message that a Command requests in addition to its ack; empty: none."""
    is_request = name != GAINS or data.get("request") is True
    return _CONTENT_OF.get(name, "") if is_request else ""


def fault_of(cls: type[BaseCommand], data: Mapping[str, Any]) -> str:
    """Return why the data do not fit the Command, one sentence; empty if they do."""
    known = {wire_name(field) for field in dataclasses.fields(cls)}
    strange = [key for key in data if key not in known]
    if strange:
        fields = ", ".join(sorted(known)) or "none"
        return f"{cls.NAME} has no field {strange[0]} (its fields: {fields})"
    try:
        cls.from_data(data)
    except InvalidCommandError as error:
        return str(error)
    return ""


def _cog_commands(problems: list[str]) -> Iterator[type[BaseCommand]]:
    for cog in sorted(name for name in packages_distributions() if name.endswith("_cog")):
        for module in _command_modules(cog, problems):
            for each in vars(module).values():
                if (
                    isinstance(each, type)
                    and issubclass(each, BaseCommand)
                    and each.__module__ == module.__name__
                ):
                    yield each


def _command_modules(cog: str, problems: list[str]) -> Iterator[Any]:
    package = f"{cog}.commands"
    try:
        place = importlib.import_module(package).__path__
    except ModuleNotFoundError:
        return
    except Exception as error:  # noqa: BLE001 - a broken cog must not take the ground station along
        problems.append(f"the Commands of {cog} are left out: {type(error).__name__}: {error}")
        return
    for info in pkgutil.iter_modules(place):
        try:
            yield importlib.import_module(f"{package}.{info.name}")
        except Exception as error:  # noqa: BLE001 - as above
            problems.append(f"{package}.{info.name} is left out: {type(error).__name__}: {error}")


BYTES_LIMIT = 1 << 18
"""A page for which more waits is cut off; this must never do that."""
MAX_TEXT = 400
_TYPES = {
    bool: "boolean",
    int: "integer",
    float: "number",
    str: "text",
    dict: "object",
    list: "list",
}


def catalogue_message(catalogue: Catalogue) -> dict[str, Any]:
    """Return the message ``catalogue``: every Command that some ground may send, by name."""
    commands: list[dict[str, Any]] = []
    size = 0
    for cls in catalogue.sendable():
        told = command_fields(cls)
        size += len(json.dumps(told))
        if size > BYTES_LIMIT:
            break
        commands.append(told)
    return {"type": "catalogue", "commands": commands}


def command_fields(cls: type[BaseCommand]) -> dict[str, Any]:
    """Return a Command with its fields and their bounds, for programs."""
    hints = typing.get_type_hints(cls)
    return {
        "name": cls.NAME,
        "aliases": list(cls.ALIASES),
        "title": cls.TITLE or cls.NAME,
        # Without the fields it is offered to a ground that may send it with some.
        "role": least_role(cls.ROLES) or least_role(_all_roles(cls)),
        "role_where": [
            {"field": field, "value": given, "role": least_role(roles)}
            for field, values in cls.ROLES_WHERE.items()
            for given, roles in values.items()
        ],
        "text": about(cls)[:MAX_TEXT],
        "needs_beacon": cls.NEEDS_BEACON,
        "fields": [_field(each, hints) for each in dataclasses.fields(cls)],
    }


def _field(field: dataclasses.Field[Any], hints: dict[str, Any]) -> dict[str, Any]:
    constraint = constraint_of(field, hints)
    missing = dataclasses.MISSING
    choices = constraint.choices
    return {
        "name": wire_name(field),
        "type": _TYPES[constraint.type_],
        "unit": constraint.unit,
        "minimum": constraint.minimum,
        "maximum": constraint.maximum,
        "choices": None if choices is None else list(choices),
        "max_length": constraint.max_length,
        "nullable": constraint.nullable,
        "required": field.default is missing and field.default_factory is missing,
        "text": constraint.describe()[:MAX_TEXT],
    }
