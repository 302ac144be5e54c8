"""A faster constructor for frozen dataclasses that each frame of the board needs."""

from dataclasses import MISSING, fields
from functools import update_wrapper
from typing import Any, TypeVar

_T = TypeVar("_T")
# Plain assignment is fast only in a class whose parents guard neither of the two.
_GUARDS = {"__setattr__": object.__setattr__, "__delattr__": object.__delattr__}


def quick_init(cls: type[_T]) -> type[_T]:
    """Let the constructor of a frozen, slotted dataclass need half of its time, or a quarter.

    That of ``dataclass`` calls ``object.__setattr__`` for each field. This one assigns them while
    the new object belongs to a subclass without the guard. Raises TypeError for a class with
    ``__post_init__``, or a field that is not a plain parameter.
    """
    usual: Any = cls.__init__
    found: Any = fields(cls)  # type: ignore[arg-type]
    if hasattr(cls, "__post_init__") or not all(
        each.init and not each.kw_only and each.default_factory is MISSING for each in found
    ):
        raise TypeError(f"{cls.__qualname__} needs the constructor of dataclass")
    given = ", ".join(each.name for each in found)
    scope: dict[str, Any] = {
        "_cls": cls,
        "_usual": usual,
        "_unguarded": type(cls.__name__, (cls,), {"__slots__": (), **_GUARDS}),
        "_set_class": vars(object)["__class__"].__set__,
    }
    lines = (
        f"def __init__(self, {given}):",
        f"  if type(self) is not _cls: return _usual(self, {given})",
        "  _set_class(self, _unguarded)",
        *(f"  self.{each.name} = {each.name}" for each in found),
        "  self.__class__ = _cls",
    )
    exec("\n".join(lines), scope)
    scope["__init__"].__defaults__ = usual.__defaults__
    setattr(cls, "__init__", update_wrapper(scope["__init__"], usual))  # noqa: B010
    return cls
