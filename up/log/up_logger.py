"""The logger that every part of an application gets."""

from __future__ import annotations

from twisted.logger import Logger


class UpLogger:
    """Creates loggers by name."""

    @classmethod
    def get_logger(cls, name: str = "up") -> Logger:
        """Return a logger whose events carry `name`."""
        return Logger(namespace=name)
