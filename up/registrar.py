"""The thesis's path of ``up.cogs.up_registrar.UpRegistrar``."""

from up.cogs.up_registrar import UpRegistrar

__all__ = ["UpRegistrar"]
