"""The registration of the cog."""

from __future__ import annotations

from arduino_cog.config import FLIGHT_BATTERY
from arduino_cog.profile import AIRFRAME
from up.cogs.up_registrant import UpRegistrant
from up.flight_controller.pids_file import PIDS


class Registrant(UpRegistrant):
    """Registers the Arduino cog."""

    CONFIG_FILES = (PIDS, AIRFRAME, FLIGHT_BATTERY)
