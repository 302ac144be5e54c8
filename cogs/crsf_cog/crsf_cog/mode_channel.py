"""The channel on which the pilot selects flight modes."""

from collections.abc import Sequence

STEADY_S = 0.3
"""A new position counts after this time: longer than between two reports of the link quality."""
MAX_GAP_S = 0.5
LOW_US, HIGH_US = 988, 2012


class ModeChannel:
    """Selects a mode when the pilot moves the channel to another position.

    The position at the first signal, and at the first after a loss, selects nothing: neither a
    restart of the program nor the return of a signal changes the flight mode.
    """

    def __init__(self, modes: Sequence[str]) -> None:
        self._modes = modes
        self._position: int | None = None
        self._moving: tuple[int, float] | None = None
        self._newest_s = 0.0

    def update(self, pulse_us: int | None, now_s: float) -> str:
        """Take a pulse, or None for one without a valid signal; return the mode to select or ''."""
        is_interrupted = pulse_us is None or now_s - self._newest_s > MAX_GAP_S
        self._newest_s = now_s
        if is_interrupted:
            self._position = self._moving = None
        if pulse_us is None:
            return ""
        position = self._position_of(pulse_us)
        if position == self._position:
            self._moving = None
            return ""
        if self._moving is None or self._moving[0] != position:
            self._moving = position, now_s
            return ""
        if now_s - self._moving[1] < STEADY_S:
            return ""
        is_first = self._position is None
        self._position, self._moving = position, None
        return "" if is_first else self._modes[position]

    def _position_of(self, pulse_us: int) -> int:
        count = len(self._modes)
        position = (pulse_us - LOW_US) * count // (HIGH_US - LOW_US)
        return max(0, min(count - 1, position))
