"""Rotations from an aircraft's axes to the world and to a phone, by quaternions."""

from __future__ import annotations

import math
from typing import NamedTuple

_HALF = math.sqrt(0.5)


class Quaternion(NamedTuple):
    """A rotation w + xi + yj + zk of length one (Hamilton)."""

    w: float
    x: float
    y: float
    z: float

    def times(self, that: Quaternion) -> Quaternion:
        """Return the rotation of ``that`` followed by this."""
        return Quaternion(
            self.w * that.w - self.x * that.x - self.y * that.y - self.z * that.z,
            self.w * that.x + self.x * that.w + self.y * that.z - self.z * that.y,
            self.w * that.y - self.x * that.z + self.y * that.w + self.z * that.x,
            self.w * that.z + self.x * that.y - self.y * that.x + self.z * that.w,
        )

    def conjugate(self) -> Quaternion:
        return Quaternion(self.w, -self.x, -self.y, -self.z)

    def turn(self, x: float, y: float, z: float) -> tuple[float, float, float]:
        turned = self.times(Quaternion(0.0, x, y, z)).times(self.conjugate())
        return turned.x, turned.y, turned.z


def about(axis: int, angle_deg: float) -> Quaternion:
    """Return the right-handed rotation about an axis: 0, 1 or 2 for x, y or z."""
    half_rad = math.radians(angle_deg) / 2
    parts = [math.cos(half_rad), 0.0, 0.0, 0.0]
    parts[1 + axis] = math.sin(half_rad)
    return Quaternion(*parts)


SWAP = Quaternion(0.0, _HALF, _HALF, 0.0)
"""Changes the first two axes for each other and turns the third over: north, east, down to east,
north, up; nose, right wing, down to the axes of a flat phone with its top edge ahead."""


def body_to_world(roll_deg: float, pitch_deg: float, yaw_deg: float) -> Quaternion:
    """Return the rotation from the aircraft's axes to east, north, up."""
    to_ned = about(2, yaw_deg).times(about(1, pitch_deg)).times(about(0, roll_deg))
    return SWAP.times(to_ned)
