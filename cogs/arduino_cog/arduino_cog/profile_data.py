"""A profile as nested keys and values, with the key names of airframe.yml."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from arduino_cog.profile import Channel, Profile

_SERVOS = ("ailerons", "elevator", "throttle", "rudder")
_CHANNEL = ("reversed", "trim_us", "lowest_us", "highest_us")
_POSITIONS = ("low", "middle", "high")
_PLACES = {
    "mix": ("mix",),
    "has_motor": ("motor",),
    "roll_limit_deg": ("fly_by_wire", "roll_deg"),
    "pitch_up_limit_deg": ("fly_by_wire", "pitch_up_deg"),
    "pitch_down_limit_deg": ("fly_by_wire", "pitch_down_deg"),
    "throttle_lost_us": ("receiver_lost", "below_us"),
    "throttle_failsafe_us": ("receiver_lost", "throttle_us"),
    "glide_pitch_deg": ("receiver_lost", "glide_pitch_deg"),
    "circle_bank_deg": ("receiver_lost", "circle_bank_deg"),
    "preset_ailerons_us": ("receiver_lost", "ailerons_us"),
    "preset_elevator_us": ("receiver_lost", "elevator_us"),
    "preset_rudder_us": ("receiver_lost", "rudder_us"),
    "may_return_with_motor": ("receiver_lost", "return_with_motor"),
}


def profile_to_data(profile: Profile) -> dict[str, Any]:
    """Return every value of a profile, nested."""
    data: dict[str, Any] = {
        servo: {name: getattr(getattr(profile, servo), name) for name in _CHANNEL}
        for servo in _SERVOS
    }
    data["switch"] = dict(zip(_POSITIONS, profile.switch, strict=True))
    for attribute, path in _PLACES.items():
        _put(data, path, getattr(profile, attribute))
    return data


def profile_from_data(data: Mapping[str, Any]) -> Profile:
    """Return the profile of complete data; raises KeyError for a missing value."""
    low, middle, high = (data["switch"][position] for position in _POSITIONS)
    values: dict[str, Any] = {
        servo: Channel(**{name: data[servo][name] for name in _CHANNEL}) for servo in _SERVOS
    }
    values.update((attribute, _at(data, path)) for attribute, path in _PLACES.items())
    return Profile(switch=(low, middle, high), **values)


def flat(data: Mapping[str, Any], above: str = "") -> Iterator[tuple[str, Any]]:
    """Yield (dotted key, value) for every value that is not None."""
    for name, value in data.items():
        if isinstance(value, Mapping):
            yield from flat(value, f"{above}{name}.")
        elif value is not None:
            yield above + name, value


def with_changes(profile: Profile, changes: Mapping[str, Any]) -> Profile:
    """Return a profile with some values, by dotted keys, changed."""
    data = profile_to_data(profile)
    for name, value in changes.items():
        _put(data, tuple(name.split(".")), value)
    return profile_from_data(data)


def differences(held: Profile, wanted: Profile) -> list[str]:
    """Return the differences, in words: ``rudder.trim_us 0, wanted 20``."""
    has = dict(flat(profile_to_data(held)))
    return [
        f"{name} {_text(has[name])}, wanted {_text(value)}"
        for name, value in flat(profile_to_data(wanted))
        if has[name] != value
    ]


def _text(value: Any) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


def _put(data: dict[str, Any], path: tuple[str, ...], value: Any) -> None:
    for name in path[:-1]:
        data = data.setdefault(name, {})
    data[path[-1]] = value


def _at(data: Mapping[str, Any], path: tuple[str, ...]) -> Any:
    found: Any = data
    for name in path:
        found = found[name]
    return found
