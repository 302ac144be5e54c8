"""``up register`` and ``up unregister``."""

from __future__ import annotations

import argparse

from up.cli.locate import application_of
from up.cogs.cog import package_name
from up.cogs.registration import register, unregister


def run(values: argparse.Namespace) -> int:
    """Register or unregister one installed cog."""
    application = application_of(values)
    cog = package_name(values.name)
    if values.remove:
        return 0 if unregister(cog, application) else 1
    register(cog, application, "manual")
    return 0
