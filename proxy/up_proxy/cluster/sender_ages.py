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
        self._offsets_s: dict[str, float] = {}

    def __len__(self) -> int:
        return len(self._senders)

    def is_older(self, limit_s: float, sender: str, sent_s: float, now_s: float) -> bool:
        """Return whether a message is older than a limit.

        A young one is judged by the last `age_s` alone: call that once a second for each sender.
        """
        offset_s = self._offsets_s.get(sender)
        if offset_s is not None and now_s - sent_s <= offset_s + limit_s:
            return False
        return self.age_s(sender, sent_s, now_s) > limit_s

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
        offset_s = self._offsets_s[sender] = min(known.least_s, known.before_s)
        return difference_s - offset_s

    def forget(self, now_s: float) -> None:
        """Remove senders that were silent for two windows."""
        for sender, known in list(self._senders.items()):
            if now_s - known.begin_s > 2 * WINDOW_S:
                del self._senders[sender]
                self._offsets_s.pop(sender, None)
