"""The configuration of a daemon in a simulation: its defaults, and a scenario's changes."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import yaml

GROUND_PORT, METRICS_PORT, MAVLINK_PORT = 50002, 9304, 5760
SERIAL_PORT = "/dev/ttySimulated"
GPS_PORT, CRSF_PORT = "/dev/ttySimulatedGps", "/dev/ttySimulatedCrsf"
GOGGLES_PORT = "/dev/ttySimulatedGoggles"
BASE: Mapping[str, Mapping[str, Any]] = {
    "arduino.yml": {"port": SERIAL_PORT},
    "mission_control.yml": {
        "listener": {"port": GROUND_PORT, "address": "127.0.0.1"},
        "role": "pilot",
    },
    "black_box.yml": {"enabled": False},
    "navigation.yml": {"arm_without_home": True},
}
"""A wired Arduino, a port for a ground station that may do everything, and no black box.

The recorder writes from a separate thread, which has no simulated time. A scenario begins in the
air: its first fix, and with it home, comes after it was armed.
"""


def write_config(folder: Path, files: Mapping[str, Mapping[str, Any]] | None = None) -> Path:
    """Write the configuration of a flight and return its folder.

    ``files`` has a mapping for each file that differs from the defaults, ``airframe.yml`` and
    ``pids.yml`` among them; keys of ``BASE`` that it does not name stay. It is not judged here:
    the daemon does that when it starts. Raises OSError.
    """
    folder.mkdir(parents=True, exist_ok=True)
    for name, values in _plain(merge(BASE, files or {})).items():
        text = yaml.safe_dump(values, sort_keys=False, allow_unicode=True)
        (folder / name).write_text(text, encoding="utf-8")
    return folder


def mavlink_file(port: int) -> dict[str, Any]:
    """Return the mavlink.yml of an aircraft with one endpoint, at this TCP port."""
    return {"endpoints": [{"url": f"tcpin:127.0.0.1:{port}"}]}


def merge(base: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """Return a copy of nested maps with others laid over it."""
    merged: dict[str, Any] = {
        key: merge(value, {}) if isinstance(value, Mapping) else value
        for key, value in base.items()
    }
    for key, value in changes.items():
        below = merged.get(key)
        if isinstance(value, Mapping):
            merged[key] = merge(below if isinstance(below, Mapping) else {}, value)
        else:
            merged[key] = value
    return merged


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {key: _plain(each) for key, each in value.items()}
    if isinstance(value, tuple | list):
        return [_plain(each) for each in value]
    return value
