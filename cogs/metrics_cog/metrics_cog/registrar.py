"""Registers the cog with an application (thesis 4.3.2)."""

from metrics_cog.config import METRICS
from up.cogs.up_registrant import UpRegistrant


class Registrant(UpRegistrant):
    """Writes the cog's modules and its configuration template."""

    CONFIG_FILES = (METRICS,)
