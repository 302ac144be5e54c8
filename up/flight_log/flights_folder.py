"""The folder that the black box keeps flights in."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

_LEAF = "flights"


def default_folder(environ: Mapping[str, str] = os.environ) -> Path:
    """Return where flights are kept unless the configuration says it.

    A service has a state directory of systemd's, a user $XDG_STATE_HOME (XDG Base Directory
    Specification), which is ~/.local/state.
    """
    given = environ.get("STATE_DIRECTORY", "").split(":")[0]
    if given:
        return Path(given, _LEAF)
    home = environ.get("XDG_STATE_HOME", "")
    try:
        state = Path(home) if Path(home).is_absolute() else Path("~/.local/state").expanduser()
    except RuntimeError:
        # A user without a home: where the state directory of a service would be.
        state = Path("/var/lib")
    return state / "raspilot" / _LEAF


def folder_of(configured: str, environ: Mapping[str, str] = os.environ) -> Path:
    """Return the folder that ``folder`` of black_box.yml means."""
    return Path(configured).expanduser() if configured else default_folder(environ)
