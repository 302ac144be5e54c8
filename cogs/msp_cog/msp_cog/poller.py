"""Which requests are due, and how many answers are missing."""

from collections.abc import Sequence

from msp_cog import messages

EVERY_TICK = (messages.RC, messages.RAW_IMU, messages.ATTITUDE)
SELDOM = (messages.STATUS, messages.SERVO, messages.MOTOR, messages.RAW_GPS, messages.ANALOG)
"""One after the other, one a tick."""
SETTINGS = (messages.BOX_IDS, *messages.SETTINGS)
SETTINGS_TICKS = 50
"""A switch may select other rates in flight."""
MAX_WAITING_TICKS = 3


class Poller:
    """Gives the requests of each tick; none while a slow board still owes too many answers."""

    def __init__(self) -> None:
        self.skipped = 0
        self._answered = 0
        self.reset()

    def reset(self) -> None:
        """Begin again with the settings, as with a board that was just connected."""
        self._tick = 0
        self._owed = 0

    def on_answers(self, total: int) -> None:
        """Take the number of all answers until now."""
        self._owed = max(0, self._owed - (total - self._answered))
        self._answered = total

    def forget(self) -> None:
        """Expect no answer that is still missing."""
        self._owed = 0

    def due(self) -> Sequence[int]:
        if self._owed > MAX_WAITING_TICKS * (len(EVERY_TICK) + 1):
            self.skipped += 1
            return ()
        wanted = [*EVERY_TICK, SELDOM[self._tick % len(SELDOM)]]
        if self._tick % SETTINGS_TICKS == 0:
            wanted += SETTINGS
        self._tick += 1
        self._owed += len(wanted)
        return wanted
