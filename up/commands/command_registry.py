"""The known Commands: names and aliases to classes."""

from collections.abc import Iterable, Iterator

from up.commands.command import BaseCommand, wire_fields


class DuplicateCommandError(ValueError):
    """Two Command classes use the same name."""


class CommandRegistry:
    """The Commands that can be received, by name and by alias."""

    def __init__(self, classes: Iterable[type[BaseCommand]] = ()) -> None:
        self._classes: dict[str, type[BaseCommand]] = {}
        for cls in classes:
            self.add(cls)

    def add(self, cls: type[BaseCommand]) -> None:
        """Register a class; idempotent. A name that another class uses is an error."""
        if not (isinstance(cls, type) and issubclass(cls, BaseCommand)):
            raise TypeError(f"{cls!r} is not a Command")
        if not cls.NAME:
            raise ValueError(f"{cls.__module__}.{cls.__qualname__} has no NAME")
        wire_fields(cls)
        for name in (cls.NAME, *cls.ALIASES):
            other = self._classes.get(name)
            if other is not None and _path(other) != _path(cls):
                raise DuplicateCommandError(
                    f"Command {name!r} is defined by both {_path(other)} and {_path(cls)}"
                )
            self._classes[name] = cls

    def get(self, name: str) -> type[BaseCommand] | None:
        return self._classes.get(name)

    def primary_name(self, name: str) -> str:
        """Return the Command's current name; an unknown name is returned unchanged."""
        cls = self._classes.get(name)
        return name if cls is None else cls.NAME

    def __iter__(self) -> Iterator[type[BaseCommand]]:
        """Iterate over the classes, each once, by name."""
        return iter(sorted(set(self._classes.values()), key=lambda cls: cls.NAME))


def _path(cls: type) -> str:
    return f"{cls.__module__}.{cls.__qualname__}"
