"""What the log tells of aircraft and seats, however often they change."""

from up.log import Limited, UpLogger
from up.system.clock import Clock

INTERVAL_S = 10.0
"""Of one aircraft, one kind of news is told at once and then at most so often."""
NEWS_MAX = 100
"""More kinds of news than this in one interval are told as one."""
_log = UpLogger.get_logger("proxy")


class Journal:
    """Tells who came, who went and who commands."""

    def __init__(self, clock: Clock) -> None:
        self._limited = Limited(clock, INTERVAL_S, NEWS_MAX)

    def on_online(self, aircraft: str, host: str) -> None:
        """Tell that an aircraft is here."""
        text = "aircraft {aircraft} is online from {host}"
        self._limited.log(_log.info, text, key=(aircraft, "air"), aircraft=aircraft, host=host)

    def on_offline(self, aircraft: str) -> None:
        """Tell that an aircraft has gone or fallen silent."""
        text = "aircraft {aircraft} is offline"
        self._limited.log(_log.info, text, key=(aircraft, "air"), aircraft=aircraft)

    def on_holder(self, aircraft: str, number: int, host: str) -> None:
        """Tell who commands."""
        self._limited.log(
            _log.info,
            "ground {number} from {host} commands {aircraft}",
            key=(aircraft, "seat"),
            aircraft=aircraft,
            number=number,
            host=host,
        )

    def on_no_holder(self, aircraft: str) -> None:
        """Tell that nobody commands."""
        text = "nobody commands {aircraft}"
        self._limited.log(_log.info, text, key=(aircraft, "seat"), aircraft=aircraft)

    def stop(self) -> None:
        """Tell what was held back."""
        self._limited.stop()
