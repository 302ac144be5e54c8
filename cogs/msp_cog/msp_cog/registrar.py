"""The registration of the cog."""

from msp_cog.config import MSP
from msp_cog.osd_config import OSD
from up.cogs.up_registrant import UpRegistrant


class Registrant(UpRegistrant):
    """Registers the MSP cog."""

    CONFIG_FILES = (MSP, OSD)
