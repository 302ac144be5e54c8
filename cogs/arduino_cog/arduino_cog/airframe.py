"""airframe.yml: the required profile of the Arduino; null values stay unchanged."""

from __future__ import annotations

from up.config import ConfigFile
from up.flight_controller.airframe_profile import AirframeProfile

AIRFRAME = ConfigFile("airframe.yml", AirframeProfile)
