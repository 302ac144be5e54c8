"""The age of messages from other machines, without a common clock."""

import math

from up.quick_dataclass import dataclass

WINDOW_S = 60.0
"""The smallest difference of the clocks counts for one to two windows."""
SETTLE_S = 0.5
"""Time after a sender's first message in which its others may show that it was late."""


@dataclass(slots=True)
class _Sender:
    """The first message, the start of the window, the smallest difference in it and before it."""

    first_s: float
    begin_s: float
    least_s: float
    before_s: float


class SenderAges:
    """Compares each sender's monotonic time with this machine's.

    The smallest difference seen is the offset of the clocks plus the fastest delivery; what exceeds
    it is the age of a message. That of a new sender's messages is infinite: after a partition the
    first ones are old.
    """

    def __init__(self) -> None:
        self._senders: dict[str, _Sender] = {}
        self.offsets_s: dict[str, float] = {}
        """What each sender's `sent_s` lacks to this clock, as of the last `age_s` after SETTLE_S.

        For those that judge young messages by it: call `age_s` once a second for each sender.
        """

    def __len__(self) -> int:
        return len(self._senders)

    def age_s(self, sender: str, sent_s: float, now_s: float) -> float:
        """Return the age of a message that was sent at the sender's time `sent_s`."""
        difference_s = now_s - sent_s
        known = self._senders.get(sender)
        if known is None:
            known = _Sender(now_s, now_s, difference_s, difference_s)
            self._senders[sender] = known
        if now_s - known.begin_s > WINDOW_S:
            known.begin_s, known.before_s, known.least_s = now_s, known.least_s, difference_s
        known.least_s = min(known.least_s, difference_s)
        if now_s - known.first_s < SETTLE_S:
            return math.inf
        offset_s = self.offsets_s[sender] = min(known.least_s, known.before_s)
        return difference_s - offset_s

    def forget(self, now_s: float) -> None:
        """Remove senders that were silent for two windows."""
        for sender, known in list(self._senders.items()):
            if now_s - known.begin_s > 2 * WINDOW_S:
                del self._senders[sender]
                self.offsets_s.pop(sender, None)
