"""A typed, bounded value, shared by configuration keys and the fields of Commands."""

import difflib
import math
import sys
from collections.abc import Callable, Iterable
from dataclasses import Field, field
from types import SimpleNamespace
from typing import Any, get_type_hints

from up.quick_dataclass import dataclass

_TYPES = (bool, int, float, str, dict, list)
_JSON_TYPES: dict[type, str] = {
    bool: "boolean",
    int: "integer",
    float: "number",
    str: "string",
    dict: "object",
    list: "array",
}
_LENGTH_NOUNS: dict[type, str] = {str: "characters", list: "items", dict: "keys"}
_LENGTH_KEYWORDS: dict[type, str] = {
    str: "maxLength",
    list: "maxItems",
    dict: "maxProperties",
}
_NOUNS: dict[type, str] = {str: "text", dict: "a map", list: "a list"}
_INT_LIMIT = 2**63
_SHOWN_CHARACTERS = 40
_GUESSED_CHARACTERS = 60


_PLAIN = {each.__name__: each for each in (bool, int, float, str)}


def type_of(cls: type[Any], field: Field[Any]) -> Any:
    """Return the type of a field, whose annotation may be text; that of a plain type at once."""
    annotation: Any = field.type
    if not isinstance(annotation, str):
        return annotation
    if annotation in _PLAIN:
        return _PLAIN[annotation]
    owner = next(
        each for each in cls.__mro__ if field.name in vars(each).get("__annotations__", ())
    )
    holder = SimpleNamespace(__annotations__={field.name: annotation})
    scope = vars(sys.modules[owner.__module__])
    return get_type_hints(holder, globalns=scope)[field.name]


class ConstraintError(ValueError):
    """A value violates a constraint; the text follows the value's name, as in 'must be ...'."""

    def __init__(self, text: str, code: str) -> None:
        super().__init__(text)
        self.code = code


@dataclass(frozen=True, slots=True)
class Constraint:
    """The constraint of a value: its type, bounds, choices, length and unit.

    `type_` is bool, int, float, str, dict or list (a tuple passes as a list). The contents of a
    dict or list are not checked. An int without bounds holds 64 bits. `max_length` counts
    characters, items or keys. With `ignore_case` a choice matches in any case and `check` returns
    it as spelled in `choices`. The constructor raises TypeError or ValueError for a constraint that
    contradicts itself.
    """

    type_: type
    minimum: float | None = None
    maximum: float | None = None
    choices: tuple[Any, ...] | None = None
    max_length: int | None = None
    nullable: bool = False
    unit: str = ""
    ignore_case: bool = False
    check: Callable[[object], Any] = field(init=False, repr=False, compare=False)
    """Returns the value (an int as float if `type_` is float), or raises ConstraintError."""

    def __post_init__(self) -> None:
        if self.type_ not in _TYPES:
            raise TypeError(f"a constraint cannot be of type {self.type_!r}")
        if self.type_ not in (int, float) and (self.minimum, self.maximum) != (None, None):
            raise TypeError(f"a {self.type_.__name__} has no minimum and no maximum")
        if self.type_ not in _LENGTH_NOUNS and self.max_length is not None:
            raise TypeError(f"a {self.type_.__name__} has no length")
        if self.minimum is not None and self.maximum is not None and self.minimum > self.maximum:
            raise ValueError(f"minimum {self.minimum} is above maximum {self.maximum}")
        if self.choices is not None and self.type_ in (dict, list):
            raise TypeError(f"a {self.type_.__name__} has no choices")
        object.__setattr__(self, "check", _compile(self))

    def describe(self) -> str:
        """Return the allowed values as read after 'must be': 'a number between 0 and 5 s'."""
        if self.choices is not None:
            text = "one of " + ", ".join(show(choice) for choice in self.choices)
        elif self.type_ is bool:
            text = "true or false"
        elif self.type_ in (int, float):
            text = ("a whole number" if self.type_ is int else "a number") + self._range_text()
        else:
            text = _NOUNS[self.type_]
            if self.max_length is not None:
                text += f" of at most {self.max_length} {_LENGTH_NOUNS[self.type_]}"
        return f"{text} or null" if self.nullable else text

    def json_schema(self) -> dict[str, Any]:
        """Return the JSON Schema (draft 2020-12) of the value; the unit goes into `x-unit`."""
        name = _JSON_TYPES[self.type_]
        schema: dict[str, Any] = {"type": [name, "null"] if self.nullable else name}
        if self.choices is not None:
            schema["enum"] = [*self._spellings(), None] if self.nullable else [*self._spellings()]
        for keyword, bound in (("minimum", self.minimum), ("maximum", self.maximum)):
            if bound is not None:
                schema[keyword] = bound
        if self.max_length is not None:
            schema[_LENGTH_KEYWORDS[self.type_]] = self.max_length
        if self.unit:
            schema["x-unit"] = self.unit
        return schema

    def _range_text(self) -> str:
        unit = f" {self.unit}" if self.unit else ""
        if self.unit[:1].isdigit():
            unit = f" ({self.unit})"
        if self.minimum is not None and self.maximum is not None:
            return f" between {number_text(self.minimum)} and {number_text(self.maximum)}{unit}"
        if self.minimum is not None:
            return f" of at least {number_text(self.minimum)}{unit}"
        if self.maximum is not None:
            return f" of at most {number_text(self.maximum)}{unit}"
        return f" ({self.unit})" if self.unit else ""

    def _spellings(self) -> Iterable[Any]:
        choices = self.choices or ()
        if not self.ignore_case:
            return choices
        return dict.fromkeys(form for choice in choices for form in (choice, choice.upper()))


def number_text(number: float) -> str:
    """Return a bound in its short form: 90 instead of 90.0."""
    return str(int(number)) if number == int(number) and abs(number) < 1e15 else repr(number)


def show(value: object) -> str:
    """Return any value, however large or strange, as a short printable text for a message."""
    if value is None:
        return "null"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        shown = value if len(value) <= _SHOWN_CHARACTERS else value[:_SHOWN_CHARACTERS] + "..."
        return f'"{printable(shown)}"'
    if isinstance(value, int):
        return str(value) if value.bit_length() <= 128 else "a huge number"
    if isinstance(value, float):
        return repr(value)
    if isinstance(value, dict):
        return "a map"
    if isinstance(value, list | tuple):
        return "a list"
    return f"a {type(value).__name__}"


def suggestion(word: str, known: Iterable[str]) -> str:
    """Return ", did you mean 'x'?" for the known word closest to a wrong one; empty if none is."""
    by_lower = {each.lower(): each for each in known}
    close = difflib.get_close_matches(word.lower()[:_GUESSED_CHARACTERS], by_lower, n=1)
    return f", did you mean {by_lower[close[0]]!r}?" if close else ""


def printable(text: str) -> str:
    """Return the text with every non-printable character escaped."""
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)


def _compile(constraint: Constraint) -> Callable[[object], Any]:
    """Build the check as one closure: it runs for every field of every received Command."""
    makers: dict[type, Callable[[Constraint], Callable[[object], Any]]] = {
        bool: _check_bool,
        int: _check_int,
        float: _check_float,
        str: _check_str,
        dict: _check_sized,
        list: _check_sized,
    }
    check = makers[constraint.type_](constraint)
    if constraint.choices is not None:
        check = _check_choice(constraint, check)
    if not constraint.nullable:
        return check

    def check_nullable(value: object) -> Any:
        return None if value is None else check(value)

    return check_nullable


def _refusal(constraint: Constraint, value: object, code: str = "wrong_type") -> ConstraintError:
    return ConstraintError(f"must be {constraint.describe()}, not {show(value)}", code)


def _too_long(constraint: Constraint, length: int) -> ConstraintError:
    return ConstraintError(f"must be {constraint.describe()}, not of {length}", "too_long")


def _check_bool(constraint: Constraint) -> Callable[[object], Any]:
    def check(value: object) -> bool:
        if value is True or value is False:
            return value
        raise _refusal(constraint, value)

    return check


def _check_int(constraint: Constraint) -> Callable[[object], Any]:
    low = -_INT_LIMIT if constraint.minimum is None else constraint.minimum
    high = _INT_LIMIT - 1 if constraint.maximum is None else constraint.maximum

    def check(value: object) -> int:
        if type(value) is int:
            if low <= value <= high:
                return value
            raise _refusal(constraint, value, "out_of_range")
        if isinstance(value, int) and not isinstance(value, bool):
            return check(int(value))
        raise _refusal(constraint, value)

    return check


def _check_float(constraint: Constraint) -> Callable[[object], Any]:
    # The greatest finite numbers as bounds refuse infinity; NaN fails every comparison.
    low = -sys.float_info.max if constraint.minimum is None else float(constraint.minimum)
    high = sys.float_info.max if constraint.maximum is None else float(constraint.maximum)

    def check(value: object) -> float:
        if type(value) is float:
            number = value
        elif isinstance(value, int | float) and not isinstance(value, bool):
            try:
                number = float(value)
            except OverflowError:
                raise _refusal(constraint, value, "out_of_range") from None
        else:
            raise _refusal(constraint, value)
        if low <= number <= high:
            return number
        if not math.isfinite(number):
            raise ConstraintError(f"must be a finite number, not {number!r}", "not_finite")
        raise _refusal(constraint, value, "out_of_range")

    return check


def _check_str(constraint: Constraint) -> Callable[[object], Any]:
    limit = sys.maxsize if constraint.max_length is None else constraint.max_length

    def check(value: object) -> str:
        if not isinstance(value, str):
            raise _refusal(constraint, value)
        if len(value) > limit:
            raise _too_long(constraint, len(value))
        if not value.isascii():
            try:
                value.encode()
            except UnicodeEncodeError:
                what = "must be valid Unicode text, not lone surrogates"
                raise ConstraintError(what, "bad_format") from None
        return value

    return check


def _check_sized(constraint: Constraint) -> Callable[[object], Any]:
    types = (list, tuple) if constraint.type_ is list else (dict,)
    limit = sys.maxsize if constraint.max_length is None else constraint.max_length

    def check(value: object) -> Any:
        if not isinstance(value, types):
            raise _refusal(constraint, value)
        if len(value) > limit:
            raise _too_long(constraint, len(value))
        return value

    return check


def _check_choice(
    constraint: Constraint, check_type: Callable[[object], Any]
) -> Callable[[object], Any]:
    fold: Callable[[Any], Any] = str.casefold if constraint.ignore_case else lambda choice: choice
    # A choice that violates the type is a programming error, found here.
    choices = {fold(check_type(choice)): choice for choice in constraint.choices or ()}

    def check(value: object) -> Any:
        try:
            return choices[fold(check_type(value))]
        except (ValueError, KeyError):
            refusal = _refusal(constraint, value, "unknown_choice")
        if isinstance(value, str):
            for choice in constraint.choices or ():
                if str(choice).casefold() == value.casefold():
                    what = f"{refusal}, did you mean {show(choice)}?"
                    raise ConstraintError(what, "unknown_choice")
        raise refusal

    return check
