"""The status message of the board (protocols 2.7)."""

from __future__ import annotations

import struct

from up_simulator.authority import Authority

VERSION = 1
POWER_ON = 1
SWITCH_NOT_KNOWN = 255
MOST = 65535


class StatusMeter:
    """Measures the loop over the last whole second: mean period and greatest lateness, us."""

    def __init__(self, now_s: float) -> None:
        self.reset_s = now_s
        self.period_us = 0
        self.late_us = 0
        self._second_s = now_s
        self._newest_s = now_s
        self._longest_s = 0.0
        self._ticks = 0

    def tick(self, now_s: float) -> None:
        """Count one pass of the loop."""
        self._ticks += 1
        self._longest_s = max(self._longest_s, now_s - self._newest_s)
        self._newest_s = now_s
        passed_s = now_s - self._second_s
        if passed_s >= 1.0:
            mean_s = passed_s / self._ticks
            self.period_us = _u16(mean_s * 1e6)
            self.late_us = _u16((self._longest_s - mean_s) * 1e6)
            self._second_s, self._ticks, self._longest_s = now_s, 0, 0.0


def status_payload(
    authority: Authority,
    meter: StatusMeter,
    link: tuple[int, int],
    has_heard: bool,
    now_s: float,
) -> bytes:
    """Return the 20 bytes of ``x``; ``link`` is dropped frames and frames missing."""
    flags = (
        authority.is_armed
        | authority.is_auto << 1
        | authority.has_receiver(now_s) << 2
        | 1 << 3
        | authority.is_failsafe(now_s) << 4
        | has_heard << 7
    )
    dropped, missing = link
    receiver_age_ms = min(authority.age_s(now_s) * 1e3, MOST)
    return struct.pack(
        ">BcBBBBHHHHHHH",
        VERSION,
        authority.mode(now_s).encode("ascii"),
        SWITCH_NOT_KNOWN if authority.switch is None else authority.switch,
        flags,
        authority.vetoes(now_s),
        POWER_ON,
        meter.period_us,
        meter.late_us,
        _u16(dropped),
        _u16(missing),
        _u16(now_s - meter.reset_s),
        _u16(receiver_age_ms),
        0,
    )


def _u16(value: float) -> int:
    return max(0, min(MOST, int(value)))
