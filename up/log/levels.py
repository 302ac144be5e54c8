"""The severity of an event, in configuration files, messages and the journal."""

from constantly import NamedConstant
from twisted.logger import LogEvent, LogLevel

# The display name and the priority of syslog: 0 to 7, 7 the least severe.
_LEVELS = {
    LogLevel.debug: ("DEBUG", 7),
    LogLevel.info: ("INFO", 6),
    LogLevel.warn: ("WARNING", 4),
    LogLevel.error: ("ERROR", 3),
    LogLevel.critical: ("CRITICAL", 2),
}
_BY_NAME = {
    "debug": LogLevel.debug,
    "info": LogLevel.info,
    "warn": LogLevel.warn,
    "warning": LogLevel.warn,
    "error": LogLevel.error,
}
# "log_legacy" marks events of Twisted's old log module, which this project does not use.
_TWISTED = ("twisted.", "log_legacy")


def level_named(name: str) -> NamedConstant:
    """Return the level for debug, info, warn, warning or error in any case; raises ValueError."""
    try:
        return _BY_NAME[name.lower()]
    except KeyError:
        choices = ", ".join(_BY_NAME)
        raise ValueError(f'a log level must be one of {choices}, not "{name}"') from None


def level_of(event: LogEvent) -> NamedConstant:
    """Return the level of an event; Twisted's own events count as debug."""
    level = event.get("log_level", LogLevel.info)
    if level is LogLevel.info and str(event.get("log_namespace", "")).startswith(_TWISTED):
        return LogLevel.debug
    return level


def word_of(level: NamedConstant) -> str:
    """Return the display name."""
    return _LEVELS[level][0]


def priority_of(level: NamedConstant) -> int:
    """Return the syslog priority (0 to 7, 7 the least severe) that the journal understands."""
    return _LEVELS[level][1]
