"""Declares which other modules a module uses; the loader orders and injects them."""

from __future__ import annotations

from collections.abc import Container
from typing import TYPE_CHECKING, Any, TypeVar, cast
from weakref import WeakKeyDictionary

from up.quick_dataclass import dataclass

if TYPE_CHECKING:
    from up.base_module import BaseModule

_M = TypeVar("_M")


@dataclass(slots=True, eq=False)
class Need:
    """A declared reference to the loaded module of a class; if ``optional``, None when absent.

    The loader fills the module's own attribute, which hides this one.
    """

    wanted: type[BaseModule]
    optional: bool
    attribute: str = ""

    def __set_name__(self, owner: type, name: str) -> None:
        self.attribute = name

    def __get__(self, instance: Any, owner: type) -> Any:
        if instance is None:
            return self
        raise AttributeError(
            f"{owner.__name__}.{self.attribute} is available from initialization on"
        )


def needs(module: type[_M]) -> _M:
    """Declare a module that this one requires: ``serial = needs(SerialProvider)``.

    The needed module is initialized and started before, stopped after, and its absence is a boot
    error.
    """
    return cast(_M, Need(cast(Any, module), optional=False))


def wants(module: type[_M]) -> _M | None:
    """Declare a module that this one uses if it is loaded; otherwise it gets None."""
    return cast("_M | None", Need(cast(Any, module), optional=True))


_declared: WeakKeyDictionary[type, tuple[Need, ...]] = WeakKeyDictionary()


def declared_needs(cls: type) -> tuple[Need, ...]:
    """Return the declarations of a module class, including those of its base classes."""
    if cls not in _declared:
        found: dict[str, Need] = {}
        for base in reversed(cls.__mro__):
            found.update({n: each for n, each in vars(base).items() if isinstance(each, Need)})
        _declared[cls] = tuple(found.values())
    return _declared[cls]


def needed_by(module: BaseModule) -> list[BaseModule]:
    """Return the modules that a filled-in module needs."""
    return [
        getattr(module, need.attribute)
        for need in declared_needs(type(module))
        if not need.optional
    ]


def discard_wanted(module: BaseModule, failed: Container[BaseModule]) -> None:
    """Clear a module's optional reference to a module that has failed."""
    references = vars(module)
    for need in declared_needs(type(module)):
        if need.optional and references.get(need.attribute) in failed:
            references[need.attribute] = None
