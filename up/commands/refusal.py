"""Reasons why a Command is not carried out; the board's own are in schema/status.yml."""

from enum import Enum


class Code(Enum):
    """The codes of ``up.nack`` (protocols page, section 4)."""

    # schema begin
    MALFORMED = "malformed"
    UNKNOWN = "unknown"
    INVALID = "invalid"
    FORBIDDEN = "forbidden"
    UNPROTECTED = "unprotected"
    STALE = "stale"
    NO_BEACON = "no_beacon"
    UNKNOWN_BEACON = "unknown_beacon"
    NOT_SUPPORTED = "not_supported"
    REFUSED = "refused"
    UNAVAILABLE = "unavailable"
    TAKEN = "taken"
    OVERLOADED = "overloaded"
    TIMEOUT = "timeout"
    FAILED = "failed"
    # schema end


NO_NAVIGATION = "no module of this application flies to a heading or an altitude"


class CommandRefusedError(Exception):
    """Raised by a handler that rejects a valid Command; ``detail`` is the handler's own code."""

    def __init__(self, reason: str, code: Code = Code.REFUSED, *, detail: str = "") -> None:
        super().__init__(reason)
        self.reason = reason
        self.code = code
        self.detail = detail


class UnhandledCommandError(LookupError):
    """The Command whose outcome was requested has no subscriber."""
