"""The folder in which the black box stores flights."""

import os
from collections.abc import Mapping
from pathlib import Path

_LEAF = "flights"


def default_folder(environ: Mapping[str, str] = os.environ) -> Path:
    """Return the default folder of flights.

    A service has the state directory from systemd, a user $XDG_STATE_HOME (XDG Base Directory
    Specification), by default ~/.local/state.
    """
    given = environ.get("STATE_DIRECTORY", "").split(":")[0]
    if given:
        return Path(given, _LEAF)
    home = environ.get("XDG_STATE_HOME", "")
    try:
        state = Path(home) if Path(home).is_absolute() else Path("~/.local/state").expanduser()
    except RuntimeError:
        # A user without a home: the state directory that a service would have.
        state = Path("/var/lib")
    return state / "raspilot" / _LEAF


def folder_of(configured: str, environ: Mapping[str, str] = os.environ) -> Path:
    """Return the folder that ``folder`` of black_box.yml selects."""
    return Path(configured).expanduser() if configured else default_folder(environ)
