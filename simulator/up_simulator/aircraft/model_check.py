"""Loads and flies a foreign JSBSim model in a separate process: JSBSim may abort there."""

from __future__ import annotations

import difflib
import os
import subprocess
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path

from up_simulator.aircraft.flight import FlightUnavailableError
from up_simulator.aircraft.model import FOOT_M, JsbsimModel

MOTOR = "external_reactions/motor/magnitude"
_LIMIT_S = 60.0
_STEPS = 50
_REFUSED, _UNKNOWN, _UNAVAILABLE = 1, 2, 3
_MARK = "unknown property: "


class ModelRefusedError(Exception):
    """JSBSim does not fly a model: the message is its reason, in one line."""


def check_model(path: Path, properties: Sequence[str], airspeed_m_s: float) -> dict[str, str]:
    """Fly the model for a moment; return its unknown properties, and the nearest names.

    Raises ``ModelRefusedError``. Without JSBSim the result is empty.
    """
    program = f"from {__name__} import main; main()"
    command = [sys.executable, "-c", program, str(path), str(airspeed_m_s), *properties]
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, errors="replace", timeout=_LIMIT_S, check=False
        )
    except subprocess.TimeoutExpired:
        raise ModelRefusedError(f"no answer within {_LIMIT_S:.0f} s") from None
    if done.returncode == _UNKNOWN:
        marked = (line for line in done.stdout.splitlines() if line.startswith(_MARK))
        pairs = (line.removeprefix(_MARK).partition(" ") for line in marked)
        return {name: match for name, _, match in pairs}
    if done.returncode == _UNAVAILABLE or (not done.returncode and not done.stderr + done.stdout):
        return {}
    # JSBSim only prints a message about a function that it does not understand, and continues.
    output = " ".join((done.stderr + "\n" + done.stdout).split())
    raise ModelRefusedError(output[:500] or f"it ended with status {done.returncode}")


def _fly(path: Path, airspeed_m_s: float, properties: Sequence[str]) -> int:
    try:
        import jsbsim
    except ImportError:
        return _UNAVAILABLE
    try:
        fdm = JsbsimModel(path, 0.002)
        fdm["ic/h-sl-ft"] = 1000.0
        fdm["ic/vt-fps"] = airspeed_m_s / FOOT_M
        fdm.run_ic()
        for _ in range(_STEPS):
            if not fdm.run():
                raise FlightUnavailableError("it stops within the first steps")
    except FlightUnavailableError as error:
        # JSBSim's own output has more details.
        sys.stderr.write(f"{error}\n".removeprefix(f"{path}: JSBSim refuses it"))
        return _REFUSED
    except (jsbsim.BaseError, RuntimeError, ValueError) as error:
        sys.stderr.write(f"{error}\n")
        return _REFUSED
    unknown = [name for name in properties if name not in fdm]
    for name in unknown:
        matches = difflib.get_close_matches(name, _catalog(fdm), n=1)
        sys.stdout.write(f"{_MARK}{name} {''.join(matches)}\n")
    return _UNKNOWN if unknown else 0


def _catalog(fdm: JsbsimModel) -> Iterable[str]:
    return [line.split(" ")[0] for line in str(fdm.fdm.query_property_catalog("/")).splitlines()]


def main() -> None:
    """Run as the process of ``check_model``."""
    code = _fly(Path(sys.argv[1]), float(sys.argv[2]), sys.argv[3:])
    sys.stdout.flush()
    sys.stderr.flush()
    # JSBSim's own end may crash after a model that it refused.
    os._exit(code)
