"""Attitude frames: a frame of telemetry as its key, with a new attitude (docs/protocols.md 6).

Their data begin with the type of block that deflate reserves, so they are never taken for deflate
data. A reader makes a whole frame of them, in which every other value has its true age.
"""

import json
import struct
from typing import Any

from up.protocols.binary_line import PACKED
from up.protocols.general_message import GeneralMessage, decode, encode

_HEAD_BYTES = 4
_MARK = 0x07
_FORM = struct.Struct(">BBBBHhhhb")
_AGE_STEP_MS, _OLDEST, _NO_AGE = 150, 14, 15
_ANGLES, _ANGLE_STEPS = ("roll", "pitch", "yaw"), 10
_CLOCK, _LEFT_OUT = ("system", "clock_ms"), ("uplink", "left_out")
_VOLTAGE, _VOLT_STEPS = ("arduino", "flight_battery_v"), 20
_UNKNOWN = (
    *(("rates", name) for name in _ANGLES),
    *(("arduino", name) for name in ("loop_us", "late_us", "frame_errors")),
)
"""What an attitude frame lacks of the readings whose age it has."""

Content = dict[str, Any]


def is_attitude(body: bytes) -> bool:
    """Return whether a body is an attitude frame."""
    return len(body) > _HEAD_BYTES and body[0] == PACKED and body[_HEAD_BYTES] & _MARK == _MARK


def shorten(key: bytes, frame: bytes) -> tuple[bytes, Content, Content] | None:
    """Return a frame's data, the content that a reader makes of them, and the frame's own.

    None: a value has no place in them. Key and frame are this program's own telemetry.
    """
    old, new = json.loads(key), json.loads(frame)
    before, after = old["data"], new["data"]
    more = [_get(after, path, 0) - _get(before, path, 0) for path in (_CLOCK, _LEFT_OUT)]
    volts = [_get(content, _VOLTAGE, None) for content in (before, after)]
    if (volts[0] is None) is not (volts[1] is None):
        return None
    try:
        ages = [_age_steps(after, reading) for reading in ("orientation", "flight")]
        steps = [new["beacon"] - old["beacon"], more[1], more[0]]
        angles = [round(after["orientation"][name] * _ANGLE_STEPS) for name in _ANGLES]
        charge = [round((each or 0) * _VOLT_STEPS) for each in volts]
        data = _FORM.pack(
            _MARK, ages[0] << 4 | ages[1], *steps, *angles, charge[1] - charge[0]
        )  # fmt: skip
    except (struct.error, KeyError, TypeError, ValueError):
        return None
    return data, _applied(before, data), after


class Expander:
    """Makes whole frames of the attitude frames of one key."""

    def __init__(self, key: bytes) -> None:
        self.key = key
        self._message: GeneralMessage | None = None

    def expand(self, data: bytes) -> bytes:
        """Return the frame of an attitude frame's data; raises ValueError."""
        if len(data) != _FORM.size or data[0] != _MARK:
            raise ValueError("not an attitude frame")
        key = self._message = self._message or decode(self.key)
        if key.beacon is None:
            raise ValueError("an attitude frame of a key without a beacon")
        return encode(key.name, _applied(key.data, data), key.id, key.beacon + data[2])[:-1]


def _applied(key: Content, data: bytes) -> Content:
    """Return the content of an attitude frame: its key's, with its own values."""
    content = {name: {**each} if type(each) is dict else each for name, each in key.items()}
    _, ages, _, left_out, clock_ms, *angles, charge = _FORM.unpack(data)
    _set(content, _LEFT_OUT, lambda value: value + left_out)
    _set(content, _CLOCK, lambda value: value + clock_ms)
    ages_ms = content.get("age_ms")
    if isinstance(ages_ms, dict):
        for reading in ages_ms:
            _set(content, ("age_ms", reading), lambda value: value + clock_ms)
        for reading, steps in (("orientation", ages >> 4), ("flight", ages & _NO_AGE)):
            ages_ms[reading] = None if steps == _NO_AGE else steps * _AGE_STEP_MS
    for path in _UNKNOWN:
        _set(content, path, lambda value: None)
    _set(content, _VOLTAGE, lambda value: (round(value * _VOLT_STEPS) + charge) / _VOLT_STEPS)
    tenths = zip(_ANGLES, angles, strict=True)
    content["orientation"] = {name: angle / _ANGLE_STEPS for name, angle in tenths}
    return content


def _get(content: Content, path: tuple[str, str], default: Any) -> Any:
    group = content.get(path[0])
    value = group.get(path[1]) if isinstance(group, dict) else None
    return value if type(value) in (int, float) else default


def _set(content: Content, path: tuple[str, str], change: Any) -> None:
    value = _get(content, path, None)
    if value is not None:
        content[path[0]][path[1]] = change(value)


def _age_steps(content: Content, reading: str) -> int:
    age_ms = _get(content, ("age_ms", reading), None)
    if age_ms is None:
        return _NO_AGE
    steps: int = round(age_ms / _AGE_STEP_MS)
    if not 0 <= steps <= _OLDEST:
        raise ValueError("an age beyond the form")
    return steps
