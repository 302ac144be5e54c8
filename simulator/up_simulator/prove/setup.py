"""The owner's configuration, as the simulated daemon flies it."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from up.cli.cli_error import UsageError
from up.config import load_all
from up.config.loader import read_text
from up.config.nodes import compose
from up.config.problems import Problems
from up_simulator.aircraft import AirframeError, load_airframe
from up_simulator.aircraft.airframe import without_nulls
from up_simulator.in_process.config_folder import merge
from up_simulator.scenario.file import daemon_files, plain_of
from up_simulator.scenario.run import CannotFlyError
from up_simulator.scenario.scenario import SwitchPart

SIMULATED: Mapping[str, Mapping[str, Any]] = {
    "config.yml": {"log file": "", "mode": "auto"},
    "android.yml": {"general port": 50001, "orientation port": 50000, "address": ""},
    "black_box.yml": {"enabled": False},
}
"""Values of the owner's files that concern the machine, not the flight."""
NOT_FLOWN = (
    "mission_control.yml", "arduino.yml", "discovery.yml", "proxy.yml", "runner.yml",
    "flight_state.yml",
)  # fmt: skip
_INSTALLATION = ("ailerons", "elevator", "throttle", "rudder", "mix")
"""Keys of airframe.yml about the owner's servos; the simulated airframe has its own."""
_SWITCH = SwitchPart().positions()


@dataclass(frozen=True, slots=True)
class Setup:
    """The input of a proof. ``files`` has the owner's values, ``values`` with the defaults."""

    folder: str
    airframe: str
    controller: str
    files: dict[str, dict[str, Any]]
    values: dict[str, dict[str, Any]]
    stall_m_s: float
    cells: int
    divider: float

    def value(self, file: str, *keys: str) -> Any:
        found: Any = self.values[file]
        for key in keys:
            found = found[key]
        return found

    @property
    def fence(self) -> dict[str, Any]:
        return dict(self.value("failsafe.yml", "fence"))

    @property
    def switch(self) -> dict[str, str]:
        own = self.value("airframe.yml", "switch")
        return {name: own[name] or mode for name, mode in _SWITCH.items()}

    def trigger(self, code: str) -> dict[str, Any]:
        return dict(self.value("failsafe.yml", code))


def read_setup(folder: Path, airframe: str, controller: str | None) -> Setup:
    """Read and check a configuration folder.

    Raises UsageError, ConfigErrors with every mistake of the files, and CannotFlyError for an
    airframe that cannot be flown.
    """
    if not folder.is_dir() or not any(folder.glob("*.yml")):
        text = f"--config {folder}: is not a folder with configuration files"
        raise UsageError(text, "no_configuration")
    try:
        aircraft = load_airframe(airframe)
    except AirframeError as error:
        raise CannotFlyError(error) from error
    known = daemon_files()
    values = load_all(folder, known.values())
    files = {name: _plain(folder / name) for name in known if (folder / name).exists()}
    own = merge({name: each for name, each in files.items() if name not in NOT_FLOWN}, SIMULATED)
    # The daemon has no other values of navigation than the owner's and its defaults.
    found = {file.filename: dataclasses.asdict(value) for file, value in values.items()}
    own["navigation.yml"] = found["navigation.yml"]
    own["config.yml"]["flight controller"] = chosen = controller or str(
        own["config.yml"].get("flight controller", "arduino")
    )
    profile = without_nulls(own.get("airframe.yml", {}))
    own["airframe.yml"] = {name: profile[name] for name in profile if name not in _INSTALLATION}
    # The board keeps what the owner's file leaves out: here what the airframe's file has.
    board = merge(aircraft.profile, own["airframe.yml"])
    found["airframe.yml"] = merge(found["airframe.yml"], board)
    return Setup(
        str(folder), airframe, chosen, own, found,
        float(aircraft.navigation["airspeed"]["stall_m_s"]),
        aircraft.battery.cells, aircraft.battery.divider,
    )  # fmt: skip


def _plain(path: Path) -> dict[str, Any]:
    problems = Problems(path)
    text = read_text(path, problems.report)
    root = compose(text or "", problems.report)
    plain = {} if root is None else plain_of(root, path.name, problems.report)
    problems.raise_if_any()
    return plain if isinstance(plain, dict) else {}
