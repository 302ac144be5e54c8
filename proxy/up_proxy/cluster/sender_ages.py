"""The age of messages from other machines, without a common clock."""

WINDOW_S = 60.0
"""The smallest difference of the clocks counts for one to two windows."""


class SenderAges:
    """Compares each sender's monotonic time with this machine's.

    The smallest difference seen is the offset of the clocks plus the fastest delivery; what exceeds
    it is the age of a message. The first message of a sender has the age 0.
    """

    def __init__(self) -> None:
        self._offsets_s: dict[str, tuple[float, float, float]] = {}
        """By sender: begin of the window, smallest difference in it, and in the one before."""

    def __len__(self) -> int:
        return len(self._offsets_s)

    def age_s(self, sender: str, sent_s: float, now_s: float) -> float:
        """Return the age of a message that was sent at the sender's time `sent_s`."""
        difference_s = now_s - sent_s
        begin_s, least_s, before_s = self._offsets_s.get(
            sender, (now_s, difference_s, difference_s)
        )
        if now_s - begin_s > WINDOW_S:
            begin_s, before_s, least_s = now_s, least_s, difference_s
        least_s = min(least_s, difference_s)
        self._offsets_s[sender] = begin_s, least_s, before_s
        return difference_s - min(least_s, before_s)

    def forget(self, now_s: float) -> None:
        """Remove senders that were silent for two windows."""
        for sender, (begin_s, _, _) in list(self._offsets_s.items()):
            if now_s - begin_s > 2 * WINDOW_S:
                del self._offsets_s[sender]
