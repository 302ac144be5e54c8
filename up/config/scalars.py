"""Converts the text of a scalar to the declared type, without YAML's surprises.

YAML 1.1 reads an unquoted `no` as false, `12:30` as 750 and `010` as 8. Here the key declares the
type, and a text value that YAML could read as another type must be quoted.
"""

import re

from up.config.nodes import ScalarNode
from up.fields import Constraint, ConstraintError, show

_NULLS = frozenset({"", "~", "null", "Null", "NULL"})
_BOOLS = {
    spelling: value
    for word, value in {
        "true": True,
        "yes": True,
        "on": True,
        "false": False,
        "no": False,
        "off": False,
    }.items()
    for spelling in (word, word.capitalize(), word.upper())
}
_INT = re.compile(r"[-+]?(0|[1-9][0-9]*)", re.ASCII)
_FLOAT = re.compile(r"[-+]?((0|[1-9][0-9]*)(\.[0-9]*)?|\.[0-9]+)([eE][-+]?[0-9]+)?", re.ASCII)
_NOT_FINITE = re.compile(r"[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN)")
_OCTAL = re.compile(r"[-+]?0[0-9_]+")
_SEXAGESIMAL = re.compile(r"[-+]?[0-9][0-9_]*(:[0-9]{1,2})+(\.[0-9_]*)?")
_NUMBER_LIKE = re.compile(
    r"[-+]?(0x[0-9a-fA-F_]+|0o[0-7_]+|0b[01_]+"
    r"|([0-9][0-9_]*(\.[0-9_]*)?|\.[0-9][0-9_]*)([eE][-+]?[0-9]+)?)"
)
_TIMESTAMP = re.compile(r"[0-9]{4}-[0-9]{1,2}-[0-9]{1,2}([Tt \t].*)?")
_MAX_DIGITS = 400


def is_null(node: object) -> bool:
    """Return whether a node is an empty or null value."""
    return isinstance(node, ScalarNode) and node.plain and node.text in _NULLS


def needs_quotes(text: str) -> bool:
    """Return whether some YAML reader reads this plain text as another type."""
    return (
        text in _NULLS
        or text in _BOOLS
        or text in ("<<", "=", "y", "Y", "n", "N")
        or any(
            pattern.fullmatch(text)
            for pattern in (_NUMBER_LIKE, _NOT_FINITE, _SEXAGESIMAL, _TIMESTAMP)
        )
    )


def read_scalar(node: ScalarNode, constraint: Constraint) -> object:
    """Return the checked value of a scalar; raises ConstraintError."""
    if is_null(node):
        return constraint.check(None)
    if constraint.type_ is str:
        return constraint.check(_text(node, constraint))
    if not node.plain:
        hint = ""
        if constraint.type_ in (bool, int, float):
            hint = " (remove the quotes)"
        what = f"must be {constraint.describe()}, not text: {show(node.text)}{hint}"
        raise ConstraintError(what, "wrong_type")
    if constraint.type_ is bool:
        return constraint.check(_BOOLS.get(node.text, node.text))
    if constraint.type_ in (int, float):
        return constraint.check(_number(node.text, constraint))
    raise ConstraintError(f"must be {constraint.describe()}, not {show(node.text)}", "wrong_type")


def _text(node: ScalarNode, constraint: Constraint) -> str:
    # Among choices the meaning of a word is unambiguous, so it needs no quotes.
    if node.plain and constraint.choices is None and needs_quotes(node.text):
        what = f"must be in quotes, YAML does not read it as text: write {show(node.text)}"
        raise ConstraintError(what, "needs_quotes")
    return node.text


def _number(text: str, constraint: Constraint) -> object:
    if len(text) > _MAX_DIGITS:
        return text
    if _INT.fullmatch(text):
        return int(text)
    if _NOT_FINITE.fullmatch(text):
        raise ConstraintError(f"must be a finite number, not {text}", "not_finite")
    if _OCTAL.fullmatch(text):
        what = f"must not begin with 0, which YAML reads as octal: {show(text)}"
        raise ConstraintError(what, "bad_format")
    if _SEXAGESIMAL.fullmatch(text):
        what = f"must be {constraint.describe()}, not {show(text)} (YAML counts it in sixties)"
        raise ConstraintError(what, "bad_format")
    if _FLOAT.fullmatch(text):
        return float(text)
    return text
