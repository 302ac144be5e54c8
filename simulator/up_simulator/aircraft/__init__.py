"""The aircraft that flies: airframes, their flight models, weather."""

from up_simulator.aircraft.airframe import (
    DEFAULT_AIRFRAME,
    Airframe,
    AirframeError,
    airframe_names,
    load_airframe,
)
from up_simulator.aircraft.dynamics import FlightDynamics
from up_simulator.aircraft.start import Start
from up_simulator.aircraft.weather import TURBULENCE, Gust, Turbulence, Weather

__all__ = [
    "DEFAULT_AIRFRAME",
    "TURBULENCE",
    "Airframe",
    "AirframeError",
    "FlightDynamics",
    "Gust",
    "Start",
    "Turbulence",
    "Weather",
    "airframe_names",
    "load_airframe",
]
