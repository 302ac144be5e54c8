"""Logs changes of aircraft and seats at a limited rate."""

from up.log import Limited, UpLogger
from up.system.clock import Clock

INTERVAL_S = 10.0
"""Minimum time between two log lines of one kind about one aircraft."""
NEWS_MAX = 100
"""More kinds than this in one interval share one line."""
_log = UpLogger.get_logger("proxy")


class Journal:
    """Logs connections, disconnections and changes of control."""

    def __init__(self, clock: Clock) -> None:
        self._limited = Limited(clock, INTERVAL_S, NEWS_MAX)

    def on_online(self, aircraft: str, host: str) -> None:
        """Log that an aircraft connected."""
        text = "aircraft {aircraft} is online from {host}"
        self._limited.log(_log.info, text, key=(aircraft, "air"), aircraft=aircraft, host=host)

    def on_offline(self, aircraft: str) -> None:
        """Log that an aircraft disconnected or became silent."""
        text = "aircraft {aircraft} is offline"
        self._limited.log(_log.info, text, key=(aircraft, "air"), aircraft=aircraft)

    def on_holder(self, aircraft: str, number: int, host: str) -> None:
        """Log which ground has control."""
        self._limited.log(
            _log.info,
            "ground {number} from {host} commands {aircraft}",
            key=(aircraft, "seat"),
            aircraft=aircraft,
            number=number,
            host=host,
        )

    def on_no_holder(self, aircraft: str) -> None:
        """Log that no ground has control."""
        text = "nobody commands {aircraft}"
        self._limited.log(_log.info, text, key=(aircraft, "seat"), aircraft=aircraft)

    def stop(self) -> None:
        """Log the suppressed events."""
        self._limited.stop()
