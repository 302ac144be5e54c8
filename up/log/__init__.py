"""Logging: one readable line per event for people and the journal, JSON lines for programs."""

from up.log.limits import Limited, Once
from up.log.setup import Logging, UpLogger, start_logging

__all__ = ["Limited", "Logging", "Once", "UpLogger", "start_logging"]
