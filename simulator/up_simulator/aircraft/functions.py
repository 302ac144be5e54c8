"""JSBSim's functions, compiled to Python: those that the derived models use."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Mapping, Sequence
from math import cos, isfinite, nan, pow, sin
from typing import Any
from xml.etree.ElementTree import Element

_OPERATORS = {"product": "*", "sum": "+", "difference": "-"}
_CALLS = {"sin": (sin, 1), "cos": (cos, 1), "pow": (pow, 2)}
"""With the number of arguments."""


class FunctionError(Exception):
    """A function has an element or a property that is not supported: one sentence."""


def compile_sum(functions: Sequence[Element], values: Mapping[str, float]) -> Callable[[], float]:
    """Return the sum of JSBSim's functions over ``values``, by property name.

    Raises ``FunctionError``. The expression is built from numbers and quoted names only.
    """
    names: dict[str, Any] = {"values": values, **{name: call for name, (call, _) in _CALLS.items()}}
    text = " + ".join(_expression(each, names) for each in functions) or "0.0"
    found: Callable[[], float] = eval(f"lambda: {text}", names)
    return found


def _expression(element: Element, names: dict[str, Any]) -> str:
    tag, text = element.tag, (element.text or "").strip()
    if tag == "value":
        return repr(number(text))
    if tag == "property":
        return _value(text, names)
    if tag == "table":
        name = f"table_{len(names)}"
        names[name], by = _table(element)
        return f"{name}({_value(by, names)})"
    arguments = [_expression(each, names) for each in element]
    if tag in _CALLS and len(arguments) == _CALLS[tag][1]:
        return f"{tag}({', '.join(arguments)})"
    if tag in _OPERATORS and (len(arguments) == 2 or tag in ("product", "sum")) and arguments:
        return f"({_OPERATORS[tag].join(arguments)})"
    raise FunctionError(f"<{tag}> with {len(arguments)} arguments")


def _value(name: str, names: Mapping[str, Any]) -> str:
    if name not in names["values"]:
        raise FunctionError(f"the property {name}")
    return f"values[{name!r}]"


def _table(element: Element) -> tuple[Callable[[float], float], str]:
    """Return a table of one variable, linear between its rows and constant beyond, and its name."""
    if [each.tag for each in element] != ["independentVar", "tableData"]:
        raise FunctionError("a table of more than one variable")
    by = (element[0].text or "").strip()
    cells = [number(each) for each in (element[1].text or "").split()]
    keys, found = cells[::2], cells[1::2]
    if len(keys) < 2 or len(keys) != len(found) or keys != sorted(set(keys)):
        raise FunctionError(f"a table by {by} without ascending rows of two numbers")
    slopes = [
        (found[at + 1] - found[at]) / (keys[at + 1] - keys[at]) for at in range(len(keys) - 1)
    ]
    least, most, end = keys[0], keys[-1], found[-1]

    def look_up(at: float) -> float:
        if not at > least:
            return found[0]
        if at >= most:
            return end
        row = bisect_right(keys, at) - 1
        return found[row] + (at - keys[row]) * slopes[row]

    return look_up, by


def number(text: str) -> float:
    """Return a finite number. Raises ``FunctionError``."""
    try:
        found = float(text)
    except ValueError:
        found = nan
    if not isfinite(found):
        raise FunctionError(f"the number {text[:40]!r}")
    return found
