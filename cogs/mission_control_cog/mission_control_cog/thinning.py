"""Telemetry as the uplink sends it: no digit and no change that a ground could not use."""

import math
from collections.abc import Mapping
from typing import Any

from up.commands.telemetry_schema import FIELDS, READINGS, RULES

SLOW_S = 1.0
"""Counters and load values change at most this often."""
_AGE_STEPS = 6
"""Steps of an age until its reading is stale; ten times coarser beyond twice that."""

Tree = dict[str, Any]
"""Keys of telemetry by name; a key without a subtree names a whole value."""


def tree_of(leaves: Mapping[str, Any]) -> Tree:
    """Return the tree of leaves by key path."""
    root: Tree = {}
    for path, leaf in leaves.items():
        *groups, name = path.split(".")
        branch = root
        for group in groups:
            branch = branch.setdefault(group, {})
        branch[name] = leaf
    return root


_PULSE_US = 4
"""Resolution of the pulses of receiver and servos."""
_DECIMALS = tree_of({each.path: each.decimals for each in FIELDS if each.type == "number"})
_SLOW_PATHS = (
    "counters", "load.cpu", "load.ram", "black_box.megabytes", "uplink.mb_per_hour", "uplink.mb",
    "uplink.mb_in_an_hour", "arduino.loop_us", "arduino.late_us", "arduino.flight_battery_v",
    "system.uptime_s", "navigation.sd", "navigation.wind", "home.time_s",
)  # fmt: skip
_SLOW = tree_of(dict.fromkeys(_SLOW_PATHS))
_COUNTED = ("age_ms", "counters", "system.clock_ms", "uplink.left_out", *_SLOW_PATHS)
"""Values that carry no age, and differ in each frame or each second."""
_EVENTS = sorted({
    tuple(path.split(".")[:2])
    for path in (
        *(rule.path for rule in RULES if rule.path),
        *(each.path for each in FIELDS if not each.reading or (each.reading == "flight"
          and each.type != "number")),
    )
    if path not in _COUNTED and path.split(".")[0] not in _COUNTED
})  # fmt: skip
"""Alarms, events, the board's flags and texts, and all that would be shown as new though old."""
_LIVE = tree_of(dict.fromkeys((
    *map(".".join, _EVENTS), "orientation", "system.clock_ms", "uplink.left_out",
    "age_ms.orientation", "age_ms.flight",
)))  # fmt: skip
"""Always new, however small the budget."""


def events_of(content: Mapping[str, Any]) -> list[Any]:
    """Return the values of which an attitude frame may tell no change."""
    found = []
    for group, *names in _EVENTS:
        value = content.get(group)
        found.append(value.get(names[0]) if names and isinstance(value, dict) else value)
    return found


class Thinning:
    """Rounds to the resolution of the sensors, and keeps what need not change."""

    def __init__(self) -> None:
        self._full: Mapping[str, Any] = {}
        self._slow: Mapping[str, Any] = {}
        self._full_s = self._slow_s = -math.inf

    def apply(self, content: Mapping[str, Any], now_s: float, hold_s: float = 0.0) -> Tree:
        """Return the content of a frame that leaves now.

        Everything but attitude, alarms and events changes only every `hold_s`; the ages stay true.
        """
        if now_s - self._slow_s >= SLOW_S:
            self._slow, self._slow_s = content, now_s
        thin = _merged(content, self._slow, _SLOW)
        held_s = now_s - self._full_s
        if held_s >= hold_s:
            self._full, self._full_s = thin, now_s
        else:
            full = _with_ages(self._full, 1000 * held_s)
            thin = _merged(full, thin, _LIVE)
        thin = _rounded(thin, _DECIMALS)
        if isinstance(thin.get("age_ms"), Mapping):
            thin["age_ms"] = {name: _step(name, age) for name, age in thin["age_ms"].items()}
        for pulses in ("rx", "servo"):
            if isinstance(thin.get(pulses), Mapping):
                thin[pulses] = {name: _pulse(value) for name, value in thin[pulses].items()}
        if isinstance(thin.get("counters"), Mapping):
            thin["counters"] = _without_zeros(thin["counters"])
        return thin


def _merged(base: Mapping[str, Any], news: Mapping[str, Any], tree: Tree) -> Tree:
    """Return `base` with the values of `news` at the leaves of the tree."""
    result = dict(base)
    for key, below in tree.items():
        old, new = base.get(key), news.get(key)
        if not below:
            result[key] = new
            if key not in news:
                del result[key]
        elif isinstance(old, Mapping) or isinstance(new, Mapping):
            old, new = (each if isinstance(each, Mapping) else {} for each in (old, new))
            result[key] = _merged(old, new, below)
    return result


def _with_ages(content: Mapping[str, Any], more_ms: float) -> Mapping[str, Any]:
    ages = content.get("age_ms")
    if not isinstance(ages, Mapping):
        return content
    older = {name: age + more_ms if _is_number(age) else age for name, age in ages.items()}
    return {**content, "age_ms": older}


def _is_number(value: Any) -> bool:
    return type(value) in (int, float)


def _step(reading: str, age_ms: Any) -> Any:
    if reading not in READINGS or not _is_number(age_ms):
        return age_ms
    step_ms = 1000 * READINGS[reading].stale_s / _AGE_STEPS
    if age_ms > 2 * _AGE_STEPS * step_ms:
        step_ms *= 10
    return round(round(age_ms / step_ms) * step_ms)


def _rounded(content: Mapping[str, Any], tree: Tree) -> Tree:
    result = dict(content)
    for key, below in tree.items():
        value = result.get(key)
        if type(value) is float and type(below) is int:
            result[key] = round(value, below or None)
        elif type(value) is dict and type(below) is dict:
            result[key] = _rounded(value, below)
    return result


def _pulse(value: Any) -> Any:
    return round(value / _PULSE_US) * _PULSE_US if type(value) is int else value


def _without_zeros(counters: Mapping[str, Any]) -> Tree:
    parts = {
        part: {name: count for name, count in counts.items() if count}
        for part, counts in counters.items()
        if isinstance(counts, Mapping)
    }
    return {part: counts for part, counts in parts.items() if counts}
