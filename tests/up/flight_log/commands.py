"""Every Command class of the installation, found as a ground station finds them."""

import dataclasses
import importlib
import pkgutil
import typing
from importlib.metadata import packages_distributions
from typing import Any

from up.commands.builtin import BUILTIN_COMMANDS
from up.commands.command import BaseCommand, constraint_of


def installed_commands() -> list[type[BaseCommand]]:
    found = list(BUILTIN_COMMANDS)
    for cog in sorted(name for name in packages_distributions() if name.endswith("_cog")):
        try:
            package = importlib.import_module(f"{cog}.commands")
        except ModuleNotFoundError:
            continue
        for info in pkgutil.iter_modules(package.__path__):
            module = importlib.import_module(f"{cog}.commands.{info.name}")
            found += [
                each
                for each in vars(module).values()
                if isinstance(each, type)
                and issubclass(each, BaseCommand)
                and each.__module__ == module.__name__
            ]
    return found


GAINS = {axis: {"p": 1.0, "i": 0.0, "d": 0.0} for axis in ("ailerons", "elevator")}
_SPECIAL = {
    "pids": {"ratePIDs": GAINS, "stabPIDs": GAINS},
    "topic": "companion.airspeed",
    "id": "7f3c",
    # Instead of an altitude.
    "height": None,
}


def example(cls: type[BaseCommand], is_full: bool) -> BaseCommand:
    """Return a Command of a class: with every field, or only with those that it needs."""
    hints = typing.get_type_hints(cls)
    values: dict[str, Any] = {}
    for field in dataclasses.fields(cls):
        constraint = constraint_of(field, hints)
        # A request is a Command too; a record without either is not.
        if field.default is not dataclasses.MISSING and not is_full and field.name != "request":
            continue
        key = field.metadata.get("key") or field.name
        if constraint.nullable and not is_full and field.name != "request":
            values[field.name] = None
        elif key in _SPECIAL:
            values[field.name] = _SPECIAL[key]
        elif constraint.choices is not None:
            values[field.name] = constraint.choices[-1]
        elif constraint.type_ in (int, float):
            bound = constraint.maximum if constraint.maximum is not None else constraint.minimum
            values[field.name] = constraint.type_(bound if bound is not None else 7)
        else:
            plain = {bool: True, str: "x", dict: {"a": {"b": 1}}, list: ("a", "b")}
            values[field.name] = plain[constraint.type_]
    return cls(**values)
