"""The flight dynamics model: a shipped aircraft of JSBSim in wind and turbulence."""

from __future__ import annotations

import importlib
import math
import os
import platform
import tempfile
from collections.abc import Callable
from typing import Any

from up_simulator.airframe import Airframe
from up_simulator.flight import FlightState, FlightUnavailableError, Servos
from up_simulator.servo import ServoRack

STEP_S = 1 / 200
FOOT_M = 0.3048
KNOT_M_S = 0.514444
GROUND_M = 250.0
START_HEIGHT_M = 400.0
START_LATITUDE_DEG = 50.0
START_LONGITUDE_DEG = 14.5
CRASH_HEIGHT_M = 1.5
LIFT_FADE_M = 50.0
MILSPEC = 4


class FlightModel:
    """JSBSim behind the ``Flight`` protocol: launched in the air, stepped at 200 Hz.

    Wind blows towards north. A crash, and a state that is no number any more, launch the
    aircraft again and say so. Two models with the same arguments and the same pulses at the same
    steps fly the same flight. Raises ``FlightUnavailableError`` where JSBSim cannot be loaded.
    """

    def __init__(
        self,
        airframe: Airframe,
        *,
        wind_m_s: float = 3.0,
        turbulence: int = 3,
        seed: int = 1,
        say: Callable[[str], None] = lambda _text: None,
    ) -> None:
        self._airframe = airframe
        self._wind_m_s = wind_m_s
        self._turbulence = turbulence
        self._seed = seed
        self._say = say
        self._fdm: Any = _load(airframe.model)
        self._servos = ServoRack()
        self._owed_s = 0.0
        self._steps = 0
        self.launches = 0
        self._launch()
        self._state = self._read()

    @property
    def state(self) -> FlightState:
        """Return the state after the newest step."""
        return self._state

    @property
    def servos(self) -> Servos:
        """Return where the servos stand, us."""
        return self._servos.rounded_us

    def set_servos(self, pulses_us: Servos) -> None:
        """Ask the servos to go to these pulses; they move with their slew rate."""
        self._servos.set(pulses_us)

    def advance(self, duration_s: float) -> None:
        """Step as often as 5 ms fit; what is left is owed to the next call."""
        self._owed_s += duration_s
        moved = False
        while self._owed_s >= STEP_S - 1e-9:
            self._owed_s -= STEP_S
            self._step()
            moved = True
        if moved:
            self._state = self._read()

    def _step(self) -> None:
        fdm, airframe = self._fdm, self._airframe
        self._servos.step(STEP_S)
        ailerons_us, elevator_us, throttle_us, rudder_us = self._servos.exact_us
        # The model's elevator is positive nose down, its rudder positive nose left.
        fdm["fcs/aileron-cmd-norm"] = airframe.aileron_trim + _deflection(ailerons_us, airframe)
        fdm["fcs/elevator-cmd-norm"] = airframe.elevator_trim - _deflection(elevator_us, airframe)
        fdm["fcs/rudder-cmd-norm"] = -_deflection(rudder_us, airframe)
        if airframe.has_motor:
            fdm["fcs/throttle-cmd-norm"] = max(0.0, min(1.0, (throttle_us - 1000) / 1000))
        if airframe.slope_lift_m_s:
            fdm["atmosphere/wind-down-fps"] = -self._lift_m_s() / FOOT_M
        self._steps += 1
        if not fdm.run() or self._has_crashed():
            self._say(f"crashed after {self._steps * STEP_S:.1f} s: launched again in the air")
            # A state that is no number survives new initial conditions: build the model anew.
            self._fdm = _load(airframe.model)
            self._launch()

    def _lift_m_s(self) -> float:
        """Return the rising air here: full below, none above, half at the launch height."""
        above_m: float = self._fdm["position/h-agl-ft"] * FOOT_M - START_HEIGHT_M
        share = 0.5 - above_m / LIFT_FADE_M
        return self._airframe.slope_lift_m_s * max(0.0, min(1.0, share))

    def _has_crashed(self) -> bool:
        height_m = self._fdm["position/h-agl-ft"] * FOOT_M
        return not math.isfinite(height_m + self._fdm["attitude/phi-rad"]) or (
            height_m < CRASH_HEIGHT_M
        )

    def _launch(self) -> None:
        fdm, airframe = self._fdm, self._airframe
        fdm["ic/terrain-elevation-ft"] = GROUND_M / FOOT_M
        fdm["ic/h-sl-ft"] = (GROUND_M + START_HEIGHT_M) / FOOT_M
        fdm["ic/lat-geod-deg"] = START_LATITUDE_DEG
        fdm["ic/long-gc-deg"] = START_LONGITUDE_DEG
        fdm["ic/phi-deg"] = 0.0
        fdm["ic/psi-true-deg"] = 0.0
        # A wind set after the speed is taken out of the airspeed again: give it beforehand.
        fdm["ic/vw-mag-fps"] = 0.0
        fdm["ic/vc-kts"] = (airframe.airspeed_m_s + self._wind_m_s) / KNOT_M_S
        fdm["ic/gamma-deg"] = airframe.path_deg
        fdm["ic/vw-dir-deg"] = 180.0
        fdm["ic/vw-mag-fps"] = self._wind_m_s / FOOT_M
        fdm["simulation/randomseed"] = self._seed + self.launches
        fdm.run_ic()
        if airframe.has_motor:
            fdm["propulsion/set-running"] = -1
            fdm["fcs/mixture-cmd-norm"] = 0.85
        if self._turbulence:
            fdm["atmosphere/turb-type"] = MILSPEC
            near_ground_m_s = max(self._wind_m_s, 1.5 * self._turbulence)
            fdm["atmosphere/turbulence/milspec/windspeed_at_20ft_AGL-fps"] = (
                near_ground_m_s / FOOT_M
            )
            fdm["atmosphere/turbulence/milspec/severity"] = self._turbulence
        self.launches += 1

    def _read(self) -> FlightState:
        fdm = self._fdm
        north, east = fdm["velocities/v-north-fps"], fdm["velocities/v-east-fps"]
        return FlightState(
            time_s=self._steps * STEP_S,
            roll_deg=fdm["attitude/phi-deg"],
            pitch_deg=fdm["attitude/theta-deg"],
            yaw_deg=fdm["attitude/psi-deg"] % 360.0,
            roll_rate_deg_s=math.degrees(fdm["velocities/p-rad_sec"]),
            pitch_rate_deg_s=math.degrees(fdm["velocities/q-rad_sec"]),
            yaw_rate_deg_s=math.degrees(fdm["velocities/r-rad_sec"]),
            latitude_deg=fdm["position/lat-geod-deg"],
            longitude_deg=fdm["position/long-gc-deg"],
            altitude_m=fdm["position/h-sl-ft"] * FOOT_M,
            height_m=fdm["position/h-agl-ft"] * FOOT_M,
            speed_m_s=math.hypot(north, east) * FOOT_M,
            track_deg=math.degrees(math.atan2(east, north)) % 360.0,
            airspeed_m_s=fdm["velocities/vt-fps"] * FOOT_M,
        )


def _deflection(pulse_us: float, airframe: Airframe) -> float:
    return airframe.throw * max(-1.0, min(1.0, (pulse_us - 1500) / 500))


def _load(model: str) -> Any:
    """Return JSBSim with ``model`` loaded, or raise ``FlightUnavailableError``."""
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
    if not fdm.load_model(model):
        raise FlightUnavailableError(f"JSBSim has no aircraft {model}")
    fdm.disable_output()
    fdm.set_dt(STEP_S)
    return fdm
