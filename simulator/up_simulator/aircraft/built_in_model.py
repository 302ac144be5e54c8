"""The built-in flight model: a rigid body of six degrees of freedom over a flat Earth."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable
from functools import partial
from pathlib import Path
from xml.etree.ElementTree import Element

from up_simulator.aircraft.flight import FlightUnavailableError
from up_simulator.aircraft.functions import FunctionError, compile_sum, number
from up_simulator.aircraft.model import FOOT_M
from up_simulator.aircraft.model_check import MOTOR
from up_simulator.aircraft.start import MERIDIAN_M, PARALLEL_M
from up_simulator.aircraft.turbulence import DrydenTurbulence

_POUND_N = 4.4482216
_FOOT_POUND_NM = _POUND_N * FOOT_M
_PSF_PA = _POUND_N / FOOT_M**2
# Normal gravity (WGS 84) at 50 degrees of latitude and 370 m, and the standard atmosphere.
_GRAVITY_M_S2 = 9.8096
_STANDARD_GRAVITY_M_S2 = 9.80665
_SEA_KG_M3, _SEA_K, _LAPSE_K_M, _DENSITY_EXPONENT = 1.225, 288.15, 0.0065, 4.25588
_MINIMUM_K = 200.0
_AXES = ("LIFT", "DRAG", "SIDE", "ROLL", "PITCH", "YAW")
_PARTS = {
    ".": {"fileheader", "metrics", "mass_balance", "ground_reactions", "external_reactions",
          "aerodynamics"},
    "metrics": {"wingarea", "wingspan", "chord", "location"},
    "mass_balance": {"ixx", "iyy", "izz", "emptywt", "location"},
    "external_reactions": {"force"},
    "aerodynamics": {"axis"},
}  # fmt: skip
_INPUTS = (
    *(f"ic/{name}" for name in (
        "terrain-elevation-ft", "lat-geod-deg", "long-gc-deg", "h-sl-ft", "phi-deg", "theta-deg",
        "psi-true-deg", "u-fps", "v-fps", "w-fps", "vw-mag-fps", "vw-dir-deg", "p-rad_sec",
        "q-rad_sec", "r-rad_sec",
    )),
    *(f"fcs/{name}-pos-rad" for name in ("left-aileron", "right-aileron", "elevator", "rudder")),
    *(f"atmosphere/gust-{axis}-fps" for axis in ("north", "east", "down")),
    "atmosphere/turb-type", "atmosphere/turbulence/milspec/windspeed_at_20ft_AGL-fps",
    "atmosphere/turbulence/milspec/severity", "simulation/randomseed",
    *(f"{point}-{axis}-in" for point in ("metrics/eyepoint", "inertia/cg") for axis in "xyz"),
)  # fmt: skip
_AIR = (
    "aero/alpha-rad", "aero/alpha-deg", "aero/beta-rad", "aero/beta-deg", "aero/qbar-psf",
    "aero/alphadot-rad_sec", "aero/bi2vel", "aero/ci2vel", "velocities/p-aero-rad_sec",
    "velocities/q-aero-rad_sec", "velocities/r-aero-rad_sec",
)  # fmt: skip


class BuiltInModel:
    """Flies a definition in JSBSim's XML, by JSBSim's property names; a ``FlightModel``.

    It supports what the derived models have (``model_file.py``): SI units, principal axes, all
    forces at the centre of gravity, the motor along the body's axis. ``FlightUnavailableError``
    names anything else in the definition.
    """

    def __init__(self, path: Path, step_s: float) -> None:
        self._step_s = step_s
        root = _read(path)
        area_m2, self._span_m, self._chord_m = (
            _measure(path, root, f"metrics/{name}", unit)
            for name, unit in (("wingarea", "M2"), ("wingspan", "M"), ("chord", "M"))
        )
        self._mass_kg = _measure(path, root, "mass_balance/emptywt", "KG")
        self._inertia_kg_m2 = tuple(
            _measure(path, root, f"mass_balance/{name}", "KG*M2") for name in ("ixx", "iyy", "izz")
        )
        self._values = dict.fromkeys((*_INPUTS, *_AIR), 0.0)
        self._values |= {
            "metrics/Sw-sqft": area_m2 / FOOT_M**2,
            "metrics/bw-ft": self._span_m / FOOT_M,
            "metrics/cbarw-ft": self._chord_m / FOOT_M,
        }
        if root.find("external_reactions/force") is not None:
            self._values[MOTOR] = 0.0
        self._functions = [_function(path, root, axis, self._values) for axis in _AXES]
        self._rates = self._rates_dot = self._velocity = self._velocity_dot = (0.0, 0.0, 0.0)
        self._attitude = (1.0, 0.0, 0.0, 0.0)
        self._position = (0.0, 0.0, 0.0)
        self._wind = (0.0, 0.0)
        self._turbulence: DrydenTurbulence | None = None
        self.run_ic()

    def __getitem__(self, name: str) -> float:
        return self._values[name]

    def __setitem__(self, name: str, value: float) -> None:
        self.writer(name)(value)

    def __contains__(self, name: str) -> bool:
        return name in self._values

    def reader(self, name: str) -> Callable[[], float]:
        return partial(self._values.__getitem__, name)

    def writer(self, name: str) -> Callable[[float], None]:
        if name not in self:
            raise FlightUnavailableError(f"the built-in flight model has no property {name}")
        return partial(self._values.__setitem__, name)

    def run_ic(self) -> None:
        value = self._values
        angles = (math.radians(value[f"ic/{name}-deg"]) for name in ("phi", "theta", "psi-true"))
        self._attitude = _attitude_of(*angles)
        u, v, w = (value[f"ic/{axis}-fps"] * FOOT_M for axis in "uvw")
        x, y, z = _axes_of(self._attitude)
        north, east, down = (u * a + v * b + w * c for a, b, c in zip(x, y, z, strict=True))
        self._velocity = north, east, down
        p, q, r = (value[f"ic/{axis}-rad_sec"] for axis in "pqr")
        self._rates = p, q, r
        to = math.radians(value["ic/vw-dir-deg"])
        wind_m_s = value["ic/vw-mag-fps"] * FOOT_M
        self._wind = wind_m_s * math.cos(to), wind_m_s * math.sin(to)
        self._position = (
            value["ic/lat-geod-deg"], value["ic/long-gc-deg"], value["ic/h-sl-ft"] * FOOT_M
        )  # fmt: skip
        value["aero/alphadot-rad_sec"] = 0.0
        seed = int(value["simulation/randomseed"])
        self._turbulence = DrydenTurbulence(self._span_m / FOOT_M, self._step_s, seed)
        self._update()

    def run(self) -> bool:
        """Integrate by semi-implicit Euler: first the velocities, then with them the places."""
        step_s = self._step_s
        p, q, r = self._rates = _moved(self._rates, self._rates_dot, step_s)
        a, b, c, d = self._attitude
        half = step_s / 2
        a, b, c, d = (
            a - half * (b * p + c * q + d * r),
            b + half * (a * p + c * r - d * q),
            c + half * (a * q + d * p - b * r),
            d + half * (a * r + b * q - c * p),
        )
        length = math.sqrt(a * a + b * b + c * c + d * d)
        self._attitude = a / length, b / length, c / length, d / length
        north, east, down = self._velocity = _moved(self._velocity, self._velocity_dot, step_s)
        latitude, longitude, altitude_m = self._position
        self._position = (
            latitude + math.degrees(north * step_s / MERIDIAN_M),
            longitude + math.degrees(east * step_s / PARALLEL_M),
            altitude_m - down * step_s,
        )
        self._update()
        return True

    def _update(self) -> None:
        """Set every property and the accelerations at the present state."""
        value = self._values
        axes = _axes_of(self._attitude)
        self._publish_state(axes)
        ahead, right, below = self._relative_air(axes)
        lift, drag, side, roll, pitch, yaw = [function() for function in self._functions]
        flat = math.hypot(ahead, below)
        speed = math.hypot(flat, right)
        cos_a, sin_a = (ahead / flat, below / flat) if flat else (1.0, 0.0)
        cos_b, sin_b = (flat / speed, right / speed) if speed else (1.0, 0.0)
        backward = drag * cos_b + side * sin_b
        scale = _POUND_N / self._mass_kg
        x = (lift * sin_a - backward * cos_a + value.get(MOTOR, 0.0)) * scale
        y = (side * cos_b - drag * sin_b) * scale
        z = (-lift * cos_a - backward * sin_a) * scale
        self._accelerate(axes, (x, y, z), (roll, pitch, yaw), (ahead, below))

    def _publish_state(self, axes: _Axes) -> None:
        value = self._values
        (x_n, x_e, x_d), (_, _, y_d), (_, _, z_d) = axes
        value["attitude/phi-rad"] = math.atan2(y_d, z_d)
        value["attitude/theta-rad"] = -math.asin(max(-1.0, min(1.0, x_d)))
        value["attitude/psi-rad"] = math.atan2(x_e, x_n)
        p, q, r = self._rates
        value["velocities/p-rad_sec"] = p
        value["velocities/q-rad_sec"] = q
        value["velocities/r-rad_sec"] = r
        north, east, down = self._velocity
        value["velocities/v-north-fps"] = north / FOOT_M
        value["velocities/v-east-fps"] = east / FOOT_M
        value["velocities/v-down-fps"] = down / FOOT_M
        latitude, longitude, altitude_m = self._position
        value["position/lat-geod-deg"], value["position/long-gc-deg"] = latitude, longitude
        value["position/h-sl-ft"] = altitude_m / FOOT_M
        value["position/h-agl-ft"] = altitude_m / FOOT_M - value["ic/terrain-elevation-ft"]

    def _relative_air(self, axes: _Axes) -> tuple[float, float, float]:
        """Set the properties of the air; return the velocity through it, body axes, m/s."""
        value = self._values
        (to_north, to_east, to_down), (roll, pitch, yaw) = self._air_motion()
        value["atmosphere/total-wind-north-fps"] = to_north / FOOT_M
        value["atmosphere/total-wind-east-fps"] = to_east / FOOT_M
        value["atmosphere/total-wind-down-fps"] = to_down / FOOT_M
        p, q, r = self._rates
        value["velocities/p-aero-rad_sec"] = p - roll
        value["velocities/q-aero-rad_sec"] = q - pitch
        value["velocities/r-aero-rad_sec"] = r - yaw
        north, east, down = self._velocity
        ahead, right, below = _in_body(axes, (north - to_north, east - to_east, down - to_down))
        flat = math.hypot(ahead, below)
        speed = math.hypot(flat, right)
        alpha, beta = math.atan2(below, ahead), math.atan2(right, flat)
        value["aero/alpha-rad"], value["aero/alpha-deg"] = alpha, math.degrees(alpha)
        value["aero/beta-rad"], value["aero/beta-deg"] = beta, math.degrees(beta)
        value["velocities/vt-fps"] = speed / FOOT_M
        value["aero/bi2vel"] = self._span_m / (2 * speed) if speed else 0.0
        value["aero/ci2vel"] = self._chord_m / (2 * speed) if speed else 0.0
        kelvin = max(_MINIMUM_K, _SEA_K - _LAPSE_K_M * self._position[2])
        density = _SEA_KG_M3 * (kelvin / _SEA_K) ** _DENSITY_EXPONENT
        value["aero/qbar-psf"] = 0.5 * density * speed * speed / _PSF_PA
        return ahead, right, below

    def _air_motion(self) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
        """Return the velocity of the air, north, east, down (m/s), and its rates (rad/s)."""
        value = self._values
        north, east = self._wind
        north += value["atmosphere/gust-north-fps"] * FOOT_M
        east += value["atmosphere/gust-east-fps"] * FOOT_M
        gust_down = value["atmosphere/gust-down-fps"] * FOOT_M
        if not value["atmosphere/turb-type"] or self._turbulence is None:
            return (north, east, gust_down), (0.0, 0.0, 0.0)
        along, across, down, roll, pitch, yaw = self._turbulence.step(
            value["velocities/vt-fps"],
            value["position/h-agl-ft"],
            value["atmosphere/turbulence/milspec/windspeed_at_20ft_AGL-fps"],
        )
        to = math.radians(value["ic/vw-dir-deg"])
        north += (along * math.cos(to) - across * math.sin(to)) * FOOT_M
        east += (along * math.sin(to) + across * math.cos(to)) * FOOT_M
        return (north, east, gust_down + down * FOOT_M), (roll, pitch, yaw)

    def _accelerate(
        self, axes: _Axes, force: _Vector, moments_ft_lb: _Vector, air: tuple[float, float]
    ) -> None:
        """Set the accelerations by specific force (m/s2) and moments, body axes."""
        value = self._values
        x, y, z = force
        p, q, r = self._rates
        roll, pitch, yaw = moments_ft_lb
        i_x, i_y, i_z = self._inertia_kg_m2
        self._rates_dot = p_dot, q_dot, r_dot = (
            (roll * _FOOT_POUND_NM - (i_z - i_y) * q * r) / i_x,
            (pitch * _FOOT_POUND_NM - (i_x - i_z) * p * r) / i_y,
            (yaw * _FOOT_POUND_NM - (i_y - i_x) * p * q) / i_z,
        )
        (x_n, x_e, x_d), (y_n, y_e, y_d), (z_n, z_e, z_d) = axes
        self._velocity_dot = (
            x * x_n + y * y_n + z * z_n,
            x * x_e + y * y_e + z * z_e,
            x * x_d + y * y_d + z * z_d + _GRAVITY_M_S2,
        )
        # The derivative of alpha is that of the velocity over the ground, as in JSBSim.
        u, v, w = _in_body(axes, self._velocity)
        u_dot = x + x_d * _GRAVITY_M_S2 - q * w + r * v
        w_dot = z + z_d * _GRAVITY_M_S2 - p * v + q * u
        ahead, below = air
        square = ahead * ahead + below * below
        value["aero/alphadot-rad_sec"] = (ahead * w_dot - below * u_dot) / square if square else 0.0
        value["accelerations/pdot-rad_sec2"] = p_dot
        value["accelerations/qdot-rad_sec2"] = q_dot
        value["accelerations/rdot-rad_sec2"] = r_dot
        value["accelerations/a-pilot-x-ft_sec2"] = x / FOOT_M
        value["accelerations/a-pilot-y-ft_sec2"] = y / FOOT_M
        value["accelerations/a-pilot-z-ft_sec2"] = z / FOOT_M
        value["accelerations/Nz"] = -z / _STANDARD_GRAVITY_M_S2


_Vector = tuple[float, float, float]
_Axes = tuple[_Vector, _Vector, _Vector]
"""The body's axes x, y, z, each north, east, down."""


def _attitude_of(roll: float, pitch: float, yaw: float) -> tuple[float, float, float, float]:
    (sr, cr), (sp, cp), (sy, cy) = (
        (math.sin(each / 2), math.cos(each / 2)) for each in (roll, pitch, yaw)
    )
    return (
        cr * cp * cy + sr * sp * sy,
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
    )


def _axes_of(attitude: tuple[float, float, float, float]) -> _Axes:
    a, b, c, d = attitude
    return (
        (1 - 2 * (c * c + d * d), 2 * (b * c + a * d), 2 * (b * d - a * c)),
        (2 * (b * c - a * d), 1 - 2 * (b * b + d * d), 2 * (c * d + a * b)),
        (2 * (b * d + a * c), 2 * (c * d - a * b), 1 - 2 * (b * b + c * c)),
    )


def _in_body(axes: _Axes, vector: _Vector) -> _Vector:
    (x_n, x_e, x_d), (y_n, y_e, y_d), (z_n, z_e, z_d) = axes
    north, east, down = vector
    return (
        x_n * north + x_e * east + x_d * down,
        y_n * north + y_e * east + y_d * down,
        z_n * north + z_e * east + z_d * down,
    )


def _moved(value: _Vector, dot: _Vector, step_s: float) -> _Vector:
    x, y, z = value
    x_dot, y_dot, z_dot = dot
    return x + step_s * x_dot, y + step_s * y_dot, z + step_s * z_dot


def _read(path: Path) -> Element:
    """Return the definition; raises ``FlightUnavailableError`` for an unsupported one."""
    try:
        root = ElementTree.parse(path).getroot()
    except (OSError, ElementTree.ParseError) as error:
        raise FlightUnavailableError(f"{path}: {error}") from error
    for part, known in _PARTS.items():
        for element in root.findall(f"{part}/*"):
            if element.tag not in known:
                raise _unsupported(path, f"<{element.tag}> in <{part.replace('.', root.tag)}>")
    points = {
        tuple(_number(path, each) for each in location)
        for location in root.iter("location")
        if location.get("name") != "VRP"
    }
    if len(points) != 1:
        raise _unsupported(path, "a <location> that is not the centre of gravity")
    for force in root.findall("external_reactions/force"):
        direction = [_number(path, each) for each in force.findall("direction/*")]
        named = force.get("name"), force.get("frame")
        if named != ("motor", "BODY") or direction != [1.0, 0.0, 0.0]:
            raise _unsupported(path, f"the force {named[0]}")
    return root


def _measure(path: Path, root: Element, name: str, unit: str) -> float:
    found = root.find(name)
    if found is None or found.get("unit") != unit:
        raise _unsupported(path, f"{name} without unit {unit}")
    if (value := _number(path, found)) <= 0.0:
        raise _unsupported(path, f"{name} of {value:g}")
    return value


def _number(path: Path, element: Element) -> float:
    try:
        return number(element.text or "0")
    except FunctionError as error:
        raise _unsupported(path, f"{error} of <{element.tag}>") from None


def _function(
    path: Path, root: Element, axis: str, values: dict[str, float]
) -> Callable[[], float]:
    """Return the sum of an axis, lb or ft lb."""
    found = root.findall(f"aerodynamics/axis[@name='{axis}']/function/*")
    try:
        return compile_sum(found, values)
    except FunctionError as error:
        raise _unsupported(path, f"{error} in the axis {axis}") from None


def _unsupported(path: Path, what: str) -> FlightUnavailableError:
    return FlightUnavailableError(f"{path}: only JSBSim supports {what}")
