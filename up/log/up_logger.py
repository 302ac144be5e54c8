"""The logger that every part of an application gets."""

from __future__ import annotations

from twisted.logger import Logger


class UpLogger:
    """Gives out loggers by name."""

    @classmethod
    def get_logger(cls, name: str = "up") -> Logger:
        """Return a logger whose events say that they come from `name`."""
        return Logger(namespace=name)
