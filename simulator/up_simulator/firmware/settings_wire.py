"""Settings of an airframe, named as in airframe.yml and pids.yml, as the bytes of the wire."""

from __future__ import annotations

import math
import struct
from collections.abc import Mapping, Sequence
from typing import Any

from up.commands.board_schema import SWITCH_MODES

MAX_GAIN = 50.0
PROFILE = struct.Struct(">" + "BhHH" * 4 + "BB" + "3s" + "hhh" + "hh" + "HH" + "HHH" + "B")
"""The fields of a profile (protocols 2.6)."""
MODES = {name: letter for letter, name in SWITCH_MODES.items()}
MIXES = ("none", "elevon", "V-tail")
_SERVOS = ("ailerons", "elevator", "throttle", "rudder")
_OF_A_SERVO = ("reversed", "trim_us", "lowest_us", "highest_us")
_CENTI = 100
_PLACES = {
    **{
        f"{servo}.{name}": 4 * at + offset
        for at, servo in enumerate(_SERVOS)
        for offset, name in enumerate(_OF_A_SERVO)
    },
    "mix": 16,
    "motor": 17,
    "fly_by_wire.roll_deg": 19,
    "fly_by_wire.pitch_up_deg": 20,
    "fly_by_wire.pitch_down_deg": 21,
    "receiver_lost.glide_pitch_deg": 22,
    "receiver_lost.circle_bank_deg": 23,
    "receiver_lost.throttle_us": 24,
    "receiver_lost.below_us": 25,
    "receiver_lost.ailerons_us": 26,
    "receiver_lost.elevator_us": 27,
    "receiver_lost.rudder_us": 28,
}
"""The position of each key among the fields of a profile (protocols 2.6)."""
_FLAGS = 29
_BITS = {"receiver_lost.return_with_motor": 1, "receiver_lost.pi_may_fly": 2}
_SLEW, _SLEW_UNIT, _SLEW_STEP = "throttle_slew_percent_s", 4, 5
_SWITCH, _ANGLES = 18, range(19, 24)
_POSITIONS = ("switch.low", "switch.middle", "switch.high")
_LOOPS, _AXES, _TERMS = ("rate", "stabilize"), ("ailerons", "elevator", "rudder"), "pid"
_GAINS = struct.Struct(">18f")


class SettingsError(ValueError):
    """A setting cannot be put on the wire: the message is one sentence that names it.

    ``code`` is the kind of mistake and ``key`` the setting, empty if it is not known.
    """

    # The defaults let a process pool copy the error.
    def __init__(self, message: str, *, code: str = "invalid_settings", key: str = "") -> None:
        super().__init__(message)
        self.code = code
        self.key = key


def profile_bytes(settings: Mapping[str, Any], held: bytes) -> bytes:
    """Return the 54 bytes of ``C``: what a board holds, with the settings that are not null.

    Raises ``SettingsError``.
    """
    fields = list(PROFILE.unpack(held))
    letters = list(fields[_SWITCH].decode("latin-1"))
    for key, value in _flat(settings):
        if key in _POSITIONS:
            letters[_POSITIONS.index(key)] = _choice(key, value, MODES)
        elif key == "mix":
            fields[_PLACES[key]] = _choice(key, value, {name: at for at, name in enumerate(MIXES)})
        elif key in _BITS:
            without = fields[_FLAGS] & ~_BITS[key]
            fields[_FLAGS] = without | _BITS[key] * round(_number(key, value))
        elif key == _SLEW:
            bits = fields[_FLAGS] % _SLEW_UNIT
            fields[_FLAGS] = bits + _SLEW_UNIT * math.ceil(_number(key, value) / _SLEW_STEP)
        elif key not in _PLACES:
            raise SettingsError(
                f"unknown key of a profile: {key}", code="unknown_profile_key", key=key
            )
        elif _PLACES[key] in _ANGLES:
            fields[_PLACES[key]] = round(_number(key, value) * _CENTI)
        else:
            fields[_PLACES[key]] = round(_number(key, value))
    fields[_SWITCH] = "".join(letters).encode("latin-1")
    try:
        wire = PROFILE.pack(*fields)
    except struct.error:
        wire = b""
    if not wire or not _is_in_range(fields):
        raise SettingsError("a value of the profile is out of range", code="profile_out_of_range")
    return wire


def gains_bytes(settings: Mapping[str, Any], held: bytes) -> bytes:
    """Return the 72 bytes of ``g``: what a board holds, with the gains that are given.

    Raises ``SettingsError``.
    """
    values = list(_GAINS.unpack(held))
    for key, value in _flat(settings):
        loop, _, rest = key.partition(".")
        axis, _, term = rest.partition(".")
        if key == "units":
            continue
        if loop not in _LOOPS or axis not in _AXES or term not in tuple(_TERMS):
            raise SettingsError(f"unknown gain {key}", code="unknown_gain", key=key)
        at = 9 * _LOOPS.index(loop) + 3 * _AXES.index(axis) + _TERMS.index(term)
        values[at] = _number(key, value)
    if not all(math.isfinite(each) and 0.0 <= each <= MAX_GAIN for each in values):
        raise SettingsError(f"a gain is not within 0 to {MAX_GAIN:g}", code="gain_out_of_range")
    return _GAINS.pack(*values)


def _is_in_range(fields: Sequence[Any]) -> bool:
    channels = [fields[at : at + 4] for at in (0, 4, 8, 12)]
    angles_cdeg, (failsafe_us, lost_us, *preset_us) = fields[19:24], fields[24:29]
    return (
        all(flags <= 1 and abs(trim_us) <= 200 for flags, trim_us, _, _ in channels)
        and all(800 <= lowest_us < highest_us <= 2200 for _, _, lowest_us, highest_us in channels)
        and all(0 <= each <= 9000 for each in angles_cdeg[:3])
        and all(abs(each) <= 9000 for each in angles_cdeg[3:])
        and all(800 <= each <= 2200 for each in (failsafe_us, *preset_us))
        and lost_us <= 2200
        and fields[17] <= 1
    )


def _flat(settings: Mapping[str, Any], above: str = "") -> list[tuple[str, Any]]:
    found: list[tuple[str, Any]] = []
    for name, value in settings.items():
        if isinstance(value, Mapping):
            found += _flat(value, f"{above}{name}.")
        elif value is not None:
            found.append((f"{above}{name}", value))
    return found


def _choice(key: str, value: Any, known: Mapping[str, Any]) -> Any:
    if value not in known:
        text = f"{key} is one of {', '.join(known)}, not {value}"
        raise SettingsError(text, code="unknown_choice", key=key)
    return known[value]


def _number(key: str, value: Any) -> float:
    if not isinstance(value, int | float):
        raise SettingsError(f"{key} is a number, not {value!r}", code="not_a_number", key=key)
    return float(value)
