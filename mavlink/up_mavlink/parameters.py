"""Parameters: gains and keys of configuration files, and what else is read as a number."""

from __future__ import annotations

import math
import re
import struct
from collections.abc import Iterable, Mapping
from typing import Any

from up.commands.command import BaseCommand, InvalidCommandError
from up.commands.gains import AXES, gain_set_from_data
from up.commands.parameter_commands import ParameterSetCommand, ParameterValuesCommand
from up.commands.pid_tunings_commands import PIDTuningsCommand
from up.commands.telemetry_commands import TelemetryFrequencyCommand
from up.fields import number_text
from up.telemetry_frame import Frame

REAL32 = 9
"""MAV_PARAM_TYPE_REAL32, the type of every parameter."""
PERIOD = "TELEM_PERIOD_MS"
MAX_NAME = 16
"""Characters of a parameter's name."""
_LOOPS = {"RATE": "ratePIDs", "STAB": "stabPIDs"}
_AXIS_NAMES = dict(zip(AXES, ("RLL", "PIT", "YAW"), strict=True))
_GAINS = {
    f"{loop}_{axis}_{term.upper()}": (key, place, term)
    for loop, key in _LOOPS.items()
    for place, axis in _AXIS_NAMES.items()
    for term in "pid"
}
_READ_ONLY = {
    "FENCE_RADIUS": ("fence", "radius"),
    "FENCE_ALT_MAX": ("fence", "ceiling"),
    "FENCE_ALT_MIN": ("fence", "floor"),
}


DOES_NOT_EXIST, OUT_OF_RANGE, NOT_PERMITTED, READ_ONLY = 1, 2, 3, 5
"""Codes of PARAM_ERROR."""


class ParameterRefusedError(Exception):
    """A value that is not set; the text is the reason, ``code`` that of PARAM_ERROR."""

    def __init__(self, reason: str, code: int) -> None:
        super().__init__(reason)
        self.code = code


class Parameters:
    """The parameters that the aircraft has now, by name, in a constant order."""

    def __init__(self, system_id: int) -> None:
        self._system_id = system_id
        self._gains: Mapping[str, Any] | None = None
        self._files: dict[str, dict[str, Any]] = {}
        self._keys: dict[str, tuple[str, str]] = {}

    @property
    def is_known(self) -> bool:
        return self._gains is not None and bool(self._files)

    def on_gains(self, data: Mapping[str, Any]) -> None:
        """Take a message of gains; an invalid one changes nothing."""
        try:
            gain_set_from_data(data)
        except ValueError:
            return
        self._gains = data

    def on_values(self, data: Mapping[str, Any]) -> None:
        """Take a message of a file's keys; an invalid one changes nothing."""
        try:
            message = ParameterValuesCommand.from_data(data)
        except InvalidCommandError:
            return
        self._files[message.file] = {**message.values, **message.next_start}
        keys = [(file, key) for file, values in self._files.items() for key in values]
        self._keys = _names_of(keys)

    def on_set(self, name: str, value: float) -> None:
        """Take a value that the aircraft has written into a file."""
        file, key = self._keys[name]
        kind = type(self._files[file][key])
        self._files[file][key] = kind(_decimal(value))

    def values(self, frame: Frame) -> dict[str, float]:
        found = {"SYSID_THISMAV": float(self._system_id)}
        known = {PERIOD: ("system", "period_ms"), **_READ_ONLY}
        for name, path in known.items():
            number = frame.number(*path)
            if number is not None:
                found[name] = number
        for name, (loop, axis, term) in _GAINS.items():
            gains = (self._gains or {}).get(loop, {}).get(axis)
            if gains is not None:
                found[name] = float(gains[term])
        for name, (file, key) in self._keys.items():
            value = self._files[file].get(key)
            if isinstance(value, int | float) and math.isfinite(value):
                found.setdefault(name, float(value))
        return dict(sorted(found.items()))

    def set(self, name: str, value: float, type_: int, frame: Frame) -> BaseCommand | None:
        """Return the Command that sets a parameter, None for one that has the value.

        Raises ParameterRefusedError; InvalidCommandError for a value that is out of range.
        """
        present = self.values(frame).get(name)
        if present is None:
            raise ParameterRefusedError(f"unknown parameter {name}", DOES_NOT_EXIST)
        if type_ != REAL32:
            text = f"{name} is of the type REAL32, not {type_}"
            raise ParameterRefusedError(text, OUT_OF_RANGE)
        if not math.isfinite(value):
            raise ParameterRefusedError(f"{name} must be a finite number", OUT_OF_RANGE)
        if single(value) == single(present):
            return None
        if name == PERIOD:
            return TelemetryFrequencyCommand.from_data({"frequency": value})
        if name in self._keys:
            return self._setting(name, value)
        if name not in _GAINS:
            raise ParameterRefusedError(f"{name} can only be read", READ_ONLY)
        loop, axis, term = _GAINS[name]
        pids = {
            key: {each: dict(gains) for each, gains in axes.items()}
            for key, axes in (self._gains or {}).items()
        }
        pids[loop][axis][term] = _decimal(value)
        return PIDTuningsCommand.from_data({"pids": pids})

    def _setting(self, name: str, value: float) -> ParameterSetCommand:
        file, key = self._keys[name]
        setting = number_text(_decimal(value))
        if isinstance(self._files[file][key], bool):
            setting = {"0": "false", "1": "true"}.get(setting, setting)
        return ParameterSetCommand(file, key, setting)


def _names_of(keys: Iterable[tuple[str, str]]) -> dict[str, tuple[str, str]]:
    """Return file and key by a name: their words, the longest ones cut until it fits.

    A name depends on its key alone, unless another key has the same one: then the later one, in the
    order of the alphabet, ends with a number.
    """
    found: dict[str, tuple[str, str]] = {}
    for file, key in sorted(keys):
        words = re.split(r"[^A-Za-z0-9]+", f"{file.removesuffix('.yml')} {key}".upper())
        while len("_".join(words)) > MAX_NAME and max(map(len, words)) > 1:
            place = max(range(len(words)), key=lambda each: len(words[each]))
            words[place] = words[place][:-1]
        first = name = "_".join(words)[:MAX_NAME]
        number = 1
        while name in found:
            number += 1
            name = f"{first[: MAX_NAME - len(str(number))]}{number}"
        found[name] = (file, key)
    return found


def single(value: float) -> float:
    """Return a number in the precision of the wire."""
    unpacked: float = struct.unpack("<f", struct.pack("<f", value))[0]
    return unpacked


def _decimal(value: float) -> float:
    """Return the shortest decimal number that is the same on the wire."""
    for digits in range(6, 10):
        shown = float(f"{value:.{digits}g}")
        if single(shown) == single(value):
            return shown
    return value
