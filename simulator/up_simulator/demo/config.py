"""The configuration that the demo writes: everything on this machine."""

from __future__ import annotations

import json
from pathlib import Path

import yaml

from up_simulator.aircraft import Airframe
from up_simulator.aircraft.start import GROUND_M, START_LATITUDE_DEG, START_LONGITUDE_DEG
from up_simulator.harness.ports import Ports

HOME = {
    "latitude_deg": START_LATITUDE_DEG,
    "longitude_deg": START_LONGITUDE_DEG,
    "altitude_m": GROUND_M,
    "radius_m": None,
}
QGROUNDCONTROL = "udpout:127.0.0.1:14550"
"""Where QGroundControl listens without any configuration."""
FLIGHTS = "flights"
"""Where, in the folder of a run, the black box writes."""


def write_config(
    folder: Path,
    board: Path,
    ports: Ports,
    *,
    controller: str,
    airframe: Airframe,
    uplink_port: int = 0,
    is_plain: bool = False,
    has_mavlink: bool = False,
) -> None:
    """Write the files of a run; gains that an earlier run of the same airframe saved stay.

    ``controller`` (arduino or raspberry) holds the attitude: nothing else differs. The aircraft
    finds the proxy at ``uplink_port`` if a bad link lies between them. ``is_plain``: everyone who
    reaches the proxy may arm and tune, otherwise only devices with a key. ``has_mavlink``: every
    program of this machine may do so by MAVLink.
    """
    folder.mkdir(parents=True, exist_ok=True)
    files = {
        "config.yml": f"flight controller: {controller}\n",
        "arduino.yml": f"port: {_quoted(board)}\n",
        "black_box.yml": f"folder: {_quoted(folder.parent / FLIGHTS)}\n",
        "android.yml": f"general port: {ports.general}\norientation port: {ports.orientation}\n",
        "discovery.yml": f"port: {ports.discovery}\n",
        "mission_control.yml": (
            "remote_server:\n"
            "  url: 127.0.0.1\n"
            f"  port: {uplink_port or ports.airborne}\n"
            + ("role: pilot\n" if is_plain else "  security: require\n")
            + "tune_in_flight: true\n"
        ),
        "mavlink.yml": _mavlink(ports) if has_mavlink else "endpoints: []\n",
        # The flight begins in the air, where the daemon resumes it: home is on the ground below, as
        # after an arming.
        "flight_state.yml": yaml.safe_dump({"mode": "", "home": HOME}),
        "navigation.yml": yaml.safe_dump(airframe.navigation, sort_keys=False),
        "proxy.yml": (
            f"airborne port: {ports.airborne}\n"
            f"ground port: {ports.ground}\n"
            f"metrics port: {ports.metrics}\n"
        ),
    }
    # An earlier run kept home and flight mode of another flight.
    (folder / "flight_state.yml.good").unlink(missing_ok=True)
    for name, text in files.items():
        head = "# Written by 'make run', at every start.\n"
        (folder / name).write_text(head + text, encoding="utf-8")
    _keep_gains(folder, airframe)


def _mavlink(ports: Ports) -> str:
    urls = (QGROUNDCONTROL, f"tcpin:127.0.0.1:{ports.mavlink}")
    return "".join(["endpoints:\n", *(f"- url: {url}\n  role: pilot\n" for url in urls)])


def _quoted(path: Path) -> str:
    return json.dumps(str(path), ensure_ascii=False)


def _keep_gains(folder: Path, airframe: Airframe) -> None:
    """Leave the gains of an earlier run, unless another airframe flew it."""
    gains, flew = folder / "pids.yml", folder / "airframe.txt"
    if gains.exists() and flew.exists() and flew.read_text(encoding="utf-8") == airframe.name:
        return
    head = f"# Gains of the virtual {airframe.name}; the ground's tuning is saved here.\n"
    text = yaml.safe_dump(airframe.gains, sort_keys=False)
    gains.write_text(head + text, encoding="utf-8")
    flew.write_text(airframe.name, encoding="utf-8")
