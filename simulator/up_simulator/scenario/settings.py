"""The settings of a scenario's board: the airframe's values, and the scenario's changes."""

from __future__ import annotations

import random
from collections.abc import Mapping
from typing import Any

from up_simulator.scenario.scenario import Scenario

SPOILT_EVERY = 7


def profile_of(scenario: Scenario, profile: Mapping[str, Any]) -> dict[str, Any]:
    """Return the profile (as airframe.yml) that the board flies by."""
    merged = merge(profile, scenario.profile)
    return merge(merged, {"switch": scenario.switch.positions()})


def gains_of(scenario: Scenario, gains: Mapping[str, Any]) -> dict[str, Any]:
    """Return the gains (as pids.yml) that the board flies by."""
    return merge(gains, scenario.gains)


def merge(base: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """Return a copy of nested maps with others laid over it."""
    merged: dict[str, Any] = {
        key: merge(value, {}) if isinstance(value, Mapping) else value
        for key, value in base.items()
    }
    for key, value in changes.items():
        below = merged.get(key)
        if isinstance(value, Mapping):
            merged[key] = merge(below if isinstance(below, Mapping) else {}, value)
        else:
            merged[key] = value
    return merged


def spoilt(eeprom: bytes, seed: int) -> bytes:
    """Return an EEPROM's contents with a wrong bit in every seventh byte."""
    noise = random.Random(f"eeprom {seed}")
    return bytes(
        byte ^ (1 << noise.randrange(8)) if at % SPOILT_EVERY == 0 else byte
        for at, byte in enumerate(eeprom)
    )
