"""An aircraft from its folder, validated."""

from __future__ import annotations

import dataclasses
import difflib
import math
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from up.config import ConfigErrors
from up.config.nodes import MapNode, ScalarNode, compose
from up_simulator.aircraft.airframe_file import (
    FILENAME,
    AirframeFile,
    BatteryConfig,
    ImuConfig,
    LaunchConfig,
    LimitsConfig,
    MotorConfig,
    ServosConfig,
    file_named,
)
from up_simulator.aircraft.flight import FlightUnavailableError
from up_simulator.aircraft.geometry import GEOMETRY, ModelError
from up_simulator.aircraft.model_check import MOTOR, ModelRefusedError, check_model

_OUTPUTS = ("ailerons", "elevator", "rudder")
SHIPPED = Path(__file__).parent / "airframes"
DEFAULT_AIRFRAME = "glider"


class AirframeError(Exception):
    """An airframe cannot be flown: one line a problem, each with file, line and key.

    ``code`` is ``unknown_airframe``, ``invalid_file``, ``missing_key``, ``not_readable``,
    ``not_a_model``, ``invalid_mass``, ``invalid_geometry``, ``model_refused`` or
    ``unknown_property``.
    """

    def __init__(self, code: str, text: str) -> None:
        super().__init__(text)
        self.code = code


@dataclass(frozen=True, slots=True)
class Airframe:
    """An aircraft of the simulator.

    ``profile``, ``gains`` and ``navigation`` have the shape of ``config/airframe.yml``,
    ``config/pids.yml`` and ``config/navigation.yml``; the profile holds only the keys that the
    airframe sets.
    """

    name: str
    title: str
    folder: Path
    model: str
    launch: LaunchConfig
    servos: ServosConfig
    motor: MotorConfig
    battery: BatteryConfig
    imu: ImuConfig
    limits: LimitsConfig
    profile: dict[str, Any]
    gains: dict[str, Any]
    navigation: dict[str, Any]

    @property
    def model_path(self) -> Path:
        """Return the JSBSim model: the file of the folder, or the one that its geometry gives.

        Raises ``FlightUnavailableError`` where no model can be derived, ``ModelError`` for a
        geometry that cannot fly.
        """
        if self.model:
            return self.folder / self.model
        try:
            from up_simulator.aircraft.model_file import derived_model
        except ImportError as error:
            raise FlightUnavailableError(f"no flight model can be derived: {error}") from error
        return derived_model(self.folder)

    @property
    def has_motor(self) -> bool:
        return self.motor.diameter_m > 0


def airframe_names() -> tuple[str, ...]:
    """Return the names of the shipped airframes, the default one first."""
    names = sorted(each.parent.name for each in SHIPPED.glob(f"*/{FILENAME}"))
    return (DEFAULT_AIRFRAME, *(name for name in names if name != DEFAULT_AIRFRAME))


def load_airframe(name_or_path: str | Path) -> Airframe:
    """Return a shipped airframe by its name, or one of the user's by its folder or file.

    Raises ``AirframeError`` with every mistake that was found.
    """
    path = _path_of(name_or_path)
    try:
        file: AirframeFile = file_named(path.name).load(path.parent)
    except ConfigErrors as errors:
        raise AirframeError("invalid_file", str(errors)) from None
    if not file.title:
        raise AirframeError("missing_key", f"{path}:1:1: title: the key is missing")
    if file.model:
        _check_model(path.parent / file.model)
    else:
        _check_geometry(path.parent)
    airframe = Airframe(
        name=path.parent.resolve().name,
        title=file.title,
        folder=path.parent,
        model=file.model,
        launch=file.launch,
        servos=file.servos,
        motor=file.motor,
        battery=file.battery,
        imu=file.imu,
        limits=file.limits,
        profile=without_nulls(dataclasses.asdict(file.profile)),
        gains={"units": "degrees per second", **dataclasses.asdict(file.gains)},
        navigation=dataclasses.asdict(file.navigation),
    )
    if SHIPPED not in path.resolve().parents:
        _check(path, airframe)
    return airframe


def _path_of(name_or_path: str | Path) -> Path:
    text = str(name_or_path)
    if text in airframe_names():
        return SHIPPED / text / FILENAME
    path = Path(name_or_path)
    if path.is_dir():
        path = path / FILENAME
    if not path.is_file():
        names = ", ".join(airframe_names())
        matches = difflib.get_close_matches(text, airframe_names(), n=1)
        hint = f", did you mean '{matches[0]}'?" if matches else ""
        what = f"{text}: is neither an airframe ({names}) nor a folder with an {FILENAME}{hint}"
        raise AirframeError("unknown_airframe", what)
    return path


def without_nulls(values: dict[str, Any]) -> dict[str, Any]:
    """Return nested maps without the keys that set nothing."""
    kept = {
        name: without_nulls(value) if isinstance(value, dict) else value
        for name, value in values.items()
    }
    return {name: value for name, value in kept.items() if value is not None and value != {}}


def _check_geometry(folder: Path) -> None:
    if not (folder / GEOMETRY.filename).is_file():
        place = f"{folder / FILENAME}:1:1"
        what = f"model: the key is missing, and no {GEOMETRY.filename} is beside the file"
        raise AirframeError("missing_key", f"{place}: {what}")
    try:
        GEOMETRY.load(folder)
    except ConfigErrors as errors:
        raise AirframeError("invalid_geometry", str(errors)) from None


def _check_model(model_path: Path) -> None:
    try:
        root = ElementTree.parse(model_path).getroot()
    except OSError as error:
        what = f"{model_path}: cannot be read: {error.strerror or error}"
        raise AirframeError("not_readable", what) from None
    except ElementTree.ParseError as error:
        line, column = error.position
        what = f"{model_path}:{line}:{column + 1}: is not XML: {str(error).split(':')[0]}"
        raise AirframeError("not_a_model", what) from None
    weight = root.find("mass_balance/emptywt")
    if root.tag != "fdm_config" or weight is None:
        what = f"{model_path}:1:1: is not a JSBSim model with a mass_balance/emptywt"
        raise AirframeError("not_a_model", what)
    try:
        mass = float(weight.text or "")
    except ValueError:
        mass = 0.0
    if not 0.0 < mass < math.inf:
        what = f"{model_path}: emptywt: is not a mass: {weight.text}"
        raise AirframeError("invalid_mass", what)


def _check(path: Path, airframe: Airframe) -> None:
    """Fly a foreign model with JSBSim. Raises ``AirframeError`` with the message of JSBSim."""
    servos = airframe.servos
    moved = {node: output for output in _OUTPUTS for node in getattr(servos, output).moves}
    required = [*moved, *([MOTOR] if airframe.has_motor else [])]
    try:
        model_path = airframe.model_path
        unknown = check_model(model_path, required, airframe.launch.airspeed_m_s)
    except FlightUnavailableError:
        return
    except ModelError as error:
        raise AirframeError("invalid_geometry", str(error)) from None
    except ModelRefusedError as error:
        what = f"{model_path}: JSBSim rejects it: {error}"
        raise AirframeError("model_refused", what) from None
    problems = []
    for node, match in unknown.items():
        if node == MOTOR:
            place = _position_of(path, "motor")
            what = "motor: the model has no force 'motor' in its external_reactions"
        else:
            place = _position_of(path, "servos", moved[node], "moves", node)
            what = f'servos.{moved[node]}.moves: the model has no property "{node}"'
            what += f", did you mean '{match}'?" if match else ""
        problems.append(f"{path}:{place[0]}:{place[1]}: {what}")
    if problems:
        raise AirframeError("unknown_property", "\n".join(problems))


def _position_of(path: Path, *keys: str) -> tuple[int, int]:
    node = compose(path.read_text(encoding="utf-8-sig"), lambda *_problem: None)
    place = (1, 1)
    for name in keys:
        pairs = node.pairs if isinstance(node, MapNode) else []
        for key, value in pairs:
            if isinstance(key, ScalarNode) and key.text == name:
                place, node = (key.line, key.column), value
    return place
