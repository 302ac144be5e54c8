"""The airframe profile that the board stores (docs/protocols.md 2.6), by keys of airframe.yml."""

from collections.abc import Callable, Iterator, Mapping
from functools import partial
from struct import Struct
from typing import Any, NamedTuple

from up.commands.board_schema import SWITCH_MODES
from up.config import ConfigFile
from up.flight_controller.airframe_profile import (
    MAX_SLEW_PERCENT_S,
    MIXES,
    SLEW_STEP_PERCENT_S,
    AirframeProfile,
)

AIRFRAME = ConfigFile("airframe.yml", AirframeProfile)
"""The required profile of the board; null values stay unchanged."""

Profile = dict[str, Any]
"""Every value by its dotted key, such as ``rudder.trim_us``."""

_SERVOS = ("ailerons", "elevator", "throttle", "rudder")
_MODES = {name: ord(letter) for letter, name in SWITCH_MODES.items()}
_MIXES = {name: number for number, name in enumerate(MIXES)}
_CENTI = 100


class _Field(NamedTuple):
    """A value and its form on the wire; ``encode`` and ``decode`` raise ValueError."""

    key: str
    format: str
    encode: Callable[[Any], int]
    decode: Callable[[int], Any]
    shift: int = 0
    """Place of its lowest bit in a byte that it shares with the fields before it."""


def _flag(key: str, decode: Callable[[int], bool] = lambda number: bool(number & 1)) -> _Field:
    return _Field(key, "B", bool, decode)


def _number(key: str, minimum: int, maximum: int) -> _Field:
    form = "h" if minimum < 0 else "H"
    return _Field(key, form, partial(_within, key, minimum, maximum), int)


def _angle(key: str, minimum: int) -> _Field:
    def encode(angle: float) -> int:
        within: float = _within(key, minimum, 90, angle)
        return round(within * _CENTI)

    return _Field(key, "h", encode, lambda number: number / _CENTI)


def _word(key: str, words: Mapping[str, int]) -> _Field:
    names = {number: name for name, number in words.items()}

    def look_up(table: Mapping[Any, Any], item: Any) -> Any:
        if item not in table:
            raise ValueError(f"{key}: {item} is unknown")
        return table[item]

    return _Field(key, "B", partial(look_up, words), partial(look_up, names))


def _within(key: str, minimum: float, maximum: float, value: Any) -> Any:
    if not minimum <= value <= maximum:
        raise ValueError(f"{key} must be {minimum} to {maximum}, not {value}")
    return value


def _fields() -> Iterator[_Field]:
    for servo in _SERVOS:
        yield _flag(f"{servo}.reversed")
        yield _number(f"{servo}.trim_us", -200, 200)
        yield _number(f"{servo}.lowest_us", 800, 2200)
        yield _number(f"{servo}.highest_us", 800, 2200)
    yield _word("mix", _MIXES)
    yield _flag("motor", bool)
    yield from (_word(f"switch.{position}", _MODES) for position in ("low", "middle", "high"))
    yield from (_angle(f"fly_by_wire.{of}_deg", 0) for of in ("roll", "pitch_up", "pitch_down"))
    yield from (_angle(f"receiver_lost.{of}_deg", -90) for of in ("glide_pitch", "circle_bank"))
    yield _number("receiver_lost.throttle_us", 800, 2200)
    yield _number("receiver_lost.below_us", 0, 2200)
    for servo in ("ailerons", "elevator", "rudder"):
        yield _number(f"receiver_lost.{servo}_us", 800, 2200)
    yield _flag("receiver_lost.return_with_motor")
    yield _flag("receiver_lost.pi_may_fly")._replace(format="", shift=1)
    yield _slew("throttle_slew_percent_s")


def _slew(key: str) -> _Field:
    def encode(percent_s: int) -> int:
        within: int = _within(key, 0, MAX_SLEW_PERCENT_S, percent_s)
        # Rounded up: 0 is no limit.
        return -(-within // SLEW_STEP_PERCENT_S)

    return _Field(key, "", encode, lambda steps: steps * SLEW_STEP_PERCENT_S, shift=2)


_FIELDS = tuple(_fields())
_PROFILE = Struct(">" + "".join(each.format for each in _FIELDS))
PROFILE_SIZE = _PROFILE.size


def pack_profile(profile: Profile) -> bytes:
    """Return the payload of `C`; raises ValueError naming the key of an invalid value."""
    for servo in _SERVOS:
        if not profile[f"{servo}.lowest_us"] < profile[f"{servo}.highest_us"]:
            raise ValueError(f"{servo}.highest_us must be above {servo}.lowest_us")
    numbers: list[int] = []
    for each in _FIELDS:
        number = each.encode(profile[each.key])
        if each.shift:
            numbers[-1] |= number << each.shift
        else:
            numbers.append(number)
    return _PROFILE.pack(*numbers)


def read_profile(payload: bytes) -> Profile:
    """Decode the payload of `C`; raises ValueError naming the key of an unknown mix or mode."""
    numbers = iter(_PROFILE.unpack(payload))
    profile: Profile = {}
    number = 0
    for each in _FIELDS:
        if not each.shift:
            number = next(numbers)
        profile[each.key] = each.decode(number >> each.shift)
    return profile


def nested(profile: Profile) -> dict[str, Any]:
    """Return a profile as nested keys, as in airframe.yml."""
    data: dict[str, Any] = {}
    for key, value in profile.items():
        section, _, name = key.rpartition(".")
        (data.setdefault(section, {}) if section else data)[name] = value
    return data


def flat(data: Mapping[str, Any], above: str = "") -> Iterator[tuple[str, Any]]:
    """Yield (dotted key, value) for every nested value that is not None."""
    for name, value in data.items():
        if isinstance(value, Mapping):
            yield from flat(value, f"{above}{name}.")
        elif value is not None:
            yield above + name, value


def differences(current: Profile, wanted: Profile) -> list[str]:
    """Return the differences, in words: ``rudder.trim_us 0, wanted 20``."""
    changed = (key for key in current if current[key] != wanted[key])
    return [f"{key} {_text(current[key])}, wanted {_text(wanted[key])}" for key in changed]


def _text(value: Any) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)
