"""airframe.yml: what the Arduino shall know about the aeroplane; what is not said stays."""

from __future__ import annotations

from up.config import ConfigFile
from up.flight_controller.airframe_profile import AirframeProfile

AIRFRAME = ConfigFile("airframe.yml", AirframeProfile)
