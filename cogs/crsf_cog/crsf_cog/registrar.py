"""Registers the cog with an application (thesis 4.3.2)."""

from crsf_cog.config import CRSF
from up.cogs.up_registrant import UpRegistrant


class Registrant(UpRegistrant):
    """Writes the cog's modules and its configuration template."""

    CONFIG_FILES = (CRSF,)
