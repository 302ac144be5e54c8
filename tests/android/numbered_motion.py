"""A motion whose every attitude has a number, by which a receiver can check it."""

from __future__ import annotations

import math

from tests.android.rotation import SWAP, body_to_world

NAMES = ("roll", "pitch", "yaw", "roll_rate", "pitch_rate", "yaw_rate")
YAW_RATE_STEP = 0.125
MOST = 31_000
NEAR_DEG = 0.06
"""Packed telemetry has steps of 0.1 deg."""


def attitude(number):
    """Return roll, pitch, yaw in degrees and their rates in degrees per second."""
    return (
        number * 37 % 341 / 2 - 85,
        number * 53 % 281 / 2 - 70,
        number * 91 % 719 / 2,
        float(number * 7 % 801 - 400),
        float(number * 11 % 601 - 300),
        number * YAW_RATE_STEP,
    )


def sensors(number):
    """Return the sensor readings of a phone that lies flat, its top edge ahead."""
    roll, pitch, yaw, *rates = attitude(number)
    rotation = body_to_world(roll, pitch, yaw).times(SWAP.conjugate())
    return {
        "rotation": list(rotation),
        "rate": list(SWAP.turn(*map(math.radians, rates))),
    }


def number_of(values):
    """Return the number of an attitude (roll to yaw rate); fails for a foreign attitude."""
    number = round(values[5] / YAW_RATE_STEP)
    wanted = attitude(number)
    off = [abs((got - want + 180) % 360 - 180) for got, want in zip(values, wanted, strict=True)]
    assert 0 <= number < MOST and max(off) < NEAR_DEG, f"{values} is not {wanted} ({number})"
    return number


def numbers_of(messages):
    """Return the numbers of orientations in a flight log, in the order in which they came."""
    return [number_of([data[name] for name in NAMES]) for _, data in messages]
