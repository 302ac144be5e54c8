"""JSBSim, loaded with the model of an aircraft."""

from __future__ import annotations

import importlib
import os
import platform
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

from up_simulator.aircraft.flight import FlightUnavailableError

FOOT_M = 0.3048


def load_model(path: Path, step_s: float) -> Any:
    """Return JSBSim with the model at ``path``.

    Raises ``FlightUnavailableError`` where JSBSim is missing and for a model that it refuses.
    """
    # JSBSim reads its verbosity once, when it is built, and prints a banner without this.
    os.environ.setdefault("JSBSIM_DEBUG", "0")
    try:
        jsbsim = importlib.import_module("jsbsim")
    except ImportError as error:
        raise FlightUnavailableError(
            f"JSBSim is not installed here ({platform.machine()}: {error})"
        ) from error
    fdm = jsbsim.FGFDMExec(None)
    # Some aircraft open an output file while they are loaded, in the working directory.
    fdm.set_output_path(tempfile.gettempdir())
    folder = path.resolve().parent
    fdm.set_aircraft_path(str(folder))
    fdm.set_engine_path(str(folder))
    try:
        is_loaded = fdm.load_model(path.stem, False)
    except (jsbsim.BaseError, RuntimeError, ValueError) as error:
        raise FlightUnavailableError(f"{path}: JSBSim refuses it: {error}") from error
    if not is_loaded:
        raise FlightUnavailableError(f"{path}: JSBSim refuses it")
    fdm.disable_output()
    fdm.set_dt(step_s)
    return fdm


def reader(fdm: Any, name: str) -> Callable[[], float]:
    """Return a fast reader of a property."""
    found: Callable[[], float] = fdm.get_property_manager().get_node(name).get_double_value
    return found


def has_property(fdm: Any, name: str) -> bool:
    """Return whether JSBSim or the model has a property."""
    return bool(fdm.get_property_manager().hasNode(name))


def writer(fdm: Any, name: str) -> Callable[[float], None]:
    """Return a fast setter of a property. Raises ``FlightUnavailableError`` if it is missing."""
    if not has_property(fdm, name):
        raise FlightUnavailableError(f"the model has no property {name}")
    found: Callable[[float], None] = fdm.get_property_manager().get_node(name).set_double_value
    return found
