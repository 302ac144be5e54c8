"""Checks how flight modes are declared: their names, fallbacks, and ``auto_mode``."""

import re
from collections.abc import Container, Iterable

from up.fields import suggestion
from up.flight_modes.flight_mode import FlightMode

MAX_NAME = 16
_NAME = re.compile(rf"[A-Z][A-Z0-9_]{{1,{MAX_NAME - 1}}}")
AUTO = "AUTO"
"""No flight mode: it selects ``navigation.yml: auto_mode``."""
RESERVED = (AUTO, "RATE")
BOARD_MODES = ("FBW", "RATE", "ACRO")
"""A fallback to one of these, where the Raspberry Pi has none of that name, is the board's."""


def usable(modes: Iterable[FlightMode]) -> tuple[dict[str, FlightMode], dict[str, str]]:
    """Return the modes by name, and by path the errors in others or in a fallback."""
    found: dict[str, FlightMode] = {}
    problems: dict[str, str] = {}
    for mode in modes:
        name, other = mode.NAME, found.get(mode.NAME)
        if not _NAME.fullmatch(name) or name in RESERVED:
            text = f"NAME {name!r} must be 2 to {MAX_NAME} capital letters, digits and _"
            problems[mode.path] = f"{mode.path}: {text}, and not {' or '.join(RESERVED)}"
        elif other is not None:
            problems[mode.path] = f"{mode.path} and {other.path} are both named {name}"
        else:
            found[name] = mode
    for mode in found.values():
        if mode.FALLBACK not in {"", *BOARD_MODES, *found}:
            text = f"{mode.path}: FALLBACK {mode.FALLBACK!r} is no loaded flight mode"
            problems[mode.path] = text + suggestion(mode.FALLBACK, found)
    return found, problems


def auto_mode_problem(name: str, modes: Container[str]) -> str | None:
    """Return why ``navigation.yml: auto_mode`` cannot be this mode; None: ``modes`` has it."""
    if name in modes:
        return None
    return f"navigation.yml: auto_mode: no flight mode {name!r} is loaded"
