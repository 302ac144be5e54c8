"""The flight model of an aircraft: JSBSim, or the built-in one where JSBSim is missing."""

from __future__ import annotations

import importlib
import os
import platform
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any, Literal, Protocol

from up_simulator.aircraft.flight import FlightUnavailableError

FOOT_M = 0.3048
ModelChoice = Literal["auto", "jsbsim", "built-in"]
MODELS: tuple[ModelChoice, ...] = ("auto", "jsbsim", "built-in")
MODEL_TITLES = {"jsbsim": "JSBSim", "built-in": "the built-in flight model"}
MODEL_HELP = "jsbsim; built-in: needs no JSBSim; auto (default): JSBSim where it is installed"


class FlightModel(Protocol):
    """A flight model by the names and units of JSBSim's properties."""

    def __getitem__(self, name: str) -> float: ...

    def __setitem__(self, name: str, value: float) -> None: ...

    def __contains__(self, name: str) -> bool: ...

    def reader(self, name: str) -> Callable[[], float]:
        """Return a fast reader of a property."""

    def writer(self, name: str) -> Callable[[float], None]:
        """Return a fast setter; raises ``FlightUnavailableError`` for an unknown property."""

    def run_ic(self) -> object:
        """Set the initial conditions of the ``ic`` properties."""

    def run(self) -> bool:
        """Advance by a step; False: it has given up. Raises ``RuntimeError``."""


def chosen_model(choice: ModelChoice) -> ModelChoice:
    """Return ``jsbsim`` or ``built-in``, by the choice and by the installed packages."""
    if choice != "auto":
        return choice
    try:
        importlib.import_module("jsbsim")
    except ModuleNotFoundError as error:
        if error.name == "jsbsim":
            return "built-in"
        raise FlightUnavailableError(f"JSBSim cannot be imported: {error}") from error
    except ImportError as error:
        raise FlightUnavailableError(f"JSBSim cannot be imported: {error}") from error
    return "jsbsim"


def fall_back_note(choice: ModelChoice, model: ModelChoice) -> str:
    """Return the sentence about a model that flies for want of JSBSim; empty: it does not."""
    is_fall_back = choice == "auto" and model != "jsbsim"
    return f"JSBSim is not installed: {MODEL_TITLES[model]} flies" if is_fall_back else ""


def load_model(path: Path, step_s: float, choice: ModelChoice = "jsbsim") -> FlightModel:
    """Return the chosen flight model with the definition at ``path``.

    Raises ``FlightUnavailableError`` where JSBSim is chosen and missing, and for a definition that
    the flight model rejects.
    """
    if chosen_model(choice) == "jsbsim":
        return JsbsimModel(path, step_s)
    from up_simulator.aircraft.built_in_model import BuiltInModel

    return BuiltInModel(path, step_s)


class JsbsimModel:
    """JSBSim with the model at ``path``."""

    def __init__(self, path: Path, step_s: float) -> None:
        # JSBSim reads its verbosity once, when it is built, and prints a banner without this.
        os.environ.setdefault("JSBSIM_DEBUG", "0")
        try:
            jsbsim = importlib.import_module("jsbsim")
        except ImportError as error:
            raise FlightUnavailableError(
                f"JSBSim is not installed here ({platform.machine()}: {error})"
            ) from error
        self.fdm: Any = jsbsim.FGFDMExec(None)
        # Some aircraft open an output file while they are loaded, in the working directory.
        self.fdm.set_output_path(tempfile.gettempdir())
        folder = path.resolve().parent
        self.fdm.set_aircraft_path(str(folder))
        self.fdm.set_engine_path(str(folder))
        try:
            is_loaded = self.fdm.load_model(path.stem, False)
        except (jsbsim.BaseError, RuntimeError, ValueError) as error:
            raise FlightUnavailableError(f"{path}: JSBSim refuses it: {error}") from error
        if not is_loaded:
            raise FlightUnavailableError(f"{path}: JSBSim refuses it")
        self.fdm.disable_output()
        self.fdm.set_dt(step_s)
        self._properties = self.fdm.get_property_manager()
        self.run: Callable[[], bool] = self.fdm.run
        self.run_ic: Callable[[], object] = self.fdm.run_ic

    def __getitem__(self, name: str) -> float:
        return float(self.fdm[name])

    def __setitem__(self, name: str, value: float) -> None:
        self.fdm[name] = value

    def __contains__(self, name: str) -> bool:
        return bool(self._properties.hasNode(name))

    def reader(self, name: str) -> Callable[[], float]:
        found: Callable[[], float] = self._properties.get_node(name).get_double_value
        return found

    def writer(self, name: str) -> Callable[[float], None]:
        if name not in self:
            raise FlightUnavailableError(f"the model has no property {name}")
        found: Callable[[float], None] = self._properties.get_node(name).set_double_value
        return found
