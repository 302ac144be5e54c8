"""A keyboard as a radio: arrows are the right stick, letters the left one."""

from __future__ import annotations

from dataclasses import replace

from up_simulator.radio.sticks import CENTRE_US, HIGHEST_US, LOWEST_US, SWITCH_US, Sticks

STEP_US = 60
THROTTLE_STEP_US = 50
HOLD_S = 0.6
"""A held key repeats after up to half a second; its stick stays for that time."""
RETURN_US_S = 1500
_STICK_KEYS = {
    "left": ("ailerons", -1),
    "right": ("ailerons", 1),
    "up": ("elevator", -1),
    "down": ("elevator", 1),
    "a": ("rudder", -1),
    "d": ("rudder", 1),
}
_THROTTLE_KEYS = {"w": THROTTLE_STEP_US, "s": -THROTTLE_STEP_US}
_MODE_KEYS = {"1": "ACRO", "2": "FBW", "3": "AUTO"}
HELP = """\
arrows   ailerons and elevator: left, right bank; up pushes (nose down), down pulls (nose up); \
these sticks spring back to the middle when no key is held, throttle and switches stay
w s      throttle up, down                 a d  rudder left, right
1 2 3    mode switch: ACRO, FBW, AUTO      x    sticks to the middle
space    arming switch (the motor arms with the throttle low)
?        this help                         q    leave"""


_ARROWS = {ord("A"): "up", ord("B"): "down", ord("C"): "right", ord("D"): "left"}
_ESCAPE = 0x1B
_MAX_SEQUENCE = 16


class KeyReader:
    """Names arrows ``up``, ``down``, ``left``, ``right``; other keys are their letter.

    Other escape sequences, control characters and letters beyond ASCII are dropped. A sequence
    may arrive in pieces; at most 16 bytes of one are kept.
    """

    def __init__(self) -> None:
        self._sequence = bytearray()

    def feed(self, data: bytes) -> list[str]:
        keys: list[str] = []
        for byte in data:
            key = self._take(byte)
            if key:
                keys.append(key)
        return keys

    def _take(self, byte: int) -> str:
        if byte == _ESCAPE:
            self._sequence = bytearray([byte])
            return ""
        if not self._sequence:
            return chr(byte) if 0x20 <= byte < 0x7F else ""
        if len(self._sequence) == 1 and byte not in b"[O":
            # The escape key itself, and then another key.
            self._sequence.clear()
            return self._take(byte)
        self._sequence.append(byte)
        is_final = len(self._sequence) > 2 and 0x40 <= byte <= 0x7E
        if not is_final and len(self._sequence) < _MAX_SEQUENCE:
            return ""
        # With a modifier it is ESC [ 1 ; 2 A: the arrow nevertheless.
        self._sequence.clear()
        return _ARROWS.get(byte, "") if is_final else ""


class KeyboardSticks:
    """Sticks that keys move: each press one step, back to the middle when no key is held.

    Throttle and switches stay where they were put. Times are seconds that only rise.
    """

    def __init__(self, start: Sticks | None = None) -> None:
        self._sticks = start or Sticks(aux1=SWITCH_US["FBW"])
        self._pressed_s = dict.fromkeys(("ailerons", "elevator", "rudder"), float("-inf"))
        self._now_s = float("-inf")

    def press(self, key: str, time_s: float) -> bool:
        """Move the stick of a key; return False for a key without one."""
        self._centre(time_s)
        sticks = self._sticks
        if key in _STICK_KEYS:
            channel, sign = _STICK_KEYS[key]
            self._sticks = sticks.moved(channel, _within(getattr(sticks, channel) + sign * STEP_US))
            self._pressed_s[channel] = time_s
        elif key in _THROTTLE_KEYS:
            self._sticks = sticks.moved("throttle", _within(sticks.throttle + _THROTTLE_KEYS[key]))
        elif key in _MODE_KEYS:
            self._sticks = sticks.moved("aux1", SWITCH_US[_MODE_KEYS[key]])
        elif key == " ":
            self._sticks = sticks.moved("aux2", LOWEST_US if sticks.is_armed else HIGHEST_US)
        elif key == "x":
            self._sticks = replace(sticks, ailerons=CENTRE_US, elevator=CENTRE_US, rudder=CENTRE_US)
        else:
            return False
        return True

    def sticks(self, time_s: float) -> Sticks:
        self._centre(time_s)
        return self._sticks

    def _centre(self, time_s: float) -> None:
        for channel, pressed_s in self._pressed_s.items():
            released_s = max(pressed_s + HOLD_S, self._now_s)
            if time_s <= released_s:
                continue
            away_us = getattr(self._sticks, channel) - CENTRE_US
            way_us = round(min(abs(away_us), (time_s - released_s) * RETURN_US_S))
            if way_us:
                to_us = CENTRE_US + away_us + (way_us if away_us < 0 else -way_us)
                self._sticks = self._sticks.moved(channel, to_us)
        self._now_s = max(self._now_s, time_s)


def _within(pulse_us: int) -> int:
    return max(LOWEST_US, min(HIGHEST_US, pulse_us))
