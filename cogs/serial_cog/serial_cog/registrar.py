"""The registration of the cog."""

from serial_cog.config import ARDUINO
from up.cogs.up_registrant import UpRegistrant


class Registrant(UpRegistrant):
    """Registers the serial cog."""

    CONFIG_FILES = (ARDUINO,)
