"""The codec's tables, imported when an endpoint needs them: they take a tenth of a second."""

from __future__ import annotations

from importlib import import_module
from importlib.util import find_spec
from typing import Any

from up.errors import UserError


def is_available() -> bool:
    """Return whether pymavlink is installed."""
    return find_spec("pymavlink") is not None


def load_dialect() -> Any:
    """Return pymavlink's module of the dialect common; raises UserError without pymavlink."""
    if not is_available():
        text = "MAVLink needs the Python package pymavlink: pip install 'raspilot[mavlink]'"
        raise UserError(text, "package_missing")
    return import_module("pymavlink.dialects.v20.common")
