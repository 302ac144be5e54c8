"""The registration of the cog."""

from up.cogs.up_registrant import UpRegistrant
from up.flight_controller.pids_file import PIDS
from up.flight_controller.profile_wire import AIRFRAME


class Registrant(UpRegistrant):
    """Registers the Arduino cog."""

    CONFIG_FILES = (PIDS, AIRFRAME)
