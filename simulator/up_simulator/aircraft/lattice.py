"""A vortex lattice: lifting surfaces in an inviscid flow, one row of horseshoe vortices each.

Katz and Plotkin, Low-Speed Aerodynamics, 12.1. Geometry counts x aft, y right, z up.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
_CORE_M = 2e-3


@dataclass(frozen=True, slots=True)
class Panel:
    """A strip of a surface: its bound vortex from ``left`` to ``right``, chord and section.

    ``angle_rad`` is the section's incidence from its angle of no lift; ``flaps`` maps the name of
    a control to the incidence per radian of it, and ``flap_moments`` to its moment about the
    quarter chord.
    """

    left: Array
    right: Array
    chord_m: float
    up: Array
    angle_rad: float
    slope_share: float
    moment: float
    flaps: dict[str, float] = field(default_factory=dict)
    flap_moments: dict[str, float] = field(default_factory=dict)

    def mirrored(self, flaps: dict[str, float], flap_moments: dict[str, float]) -> Panel:
        """Return the strip on the other side with its own controls."""
        mirror = np.array([1.0, -1.0, 1.0])
        return replace(
            self,
            left=self.right * mirror,
            right=self.left * mirror,
            up=self.up * mirror,
            flaps=flaps,
            flap_moments=flap_moments,
        )


@dataclass(frozen=True, slots=True)
class Flow:
    """The flow: angles, rates by span or chord over twice the speed, controls (rad)."""

    alpha_rad: float = 0.0
    beta_rad: float = 0.0
    roll: float = 0.0
    pitch: float = 0.0
    yaw: float = 0.0
    controls: dict[str, float] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Loads:
    """Coefficients: lift and side force of the wind axes, moments of the body's.

    Roll right wing down, pitch nose up, yaw nose right positive.
    """

    lift: float
    side: float
    roll: float
    pitch: float
    yaw: float


class Lattice:
    """The flow about panels; area (m2), span and chord (m) are the references, centre the CG."""

    def __init__(
        self, panels: Sequence[Panel], area_m2: float, span_m: float, chord_m: float, centre: Array
    ) -> None:
        self._panels = panels
        self._area_m2, self._span_m, self._chord_m = area_m2, span_m, chord_m
        self._centre = centre
        self._left = np.array([each.left for each in panels])
        self._right = np.array([each.right for each in panels])
        self._middle = (self._left + self._right) / 2
        behind = np.array([each.chord_m * each.slope_share / 2 for each in panels])
        self._points = self._middle + behind[:, None] * np.array([1.0, 0.0, 0.0])
        self._at_points = _influences(self._points, self._left, self._right, bound=True)
        self._at_bounds = _influences(self._middle, self._left, self._right, bound=False)

    def loads(self, flow: Flow) -> Loads:
        normals = np.array([_normal(each, flow.controls) for each in self._panels])
        stream = self._stream(flow, self._points)
        matrix = np.einsum("ijk,ik->ij", self._at_points, normals)
        circulation = np.linalg.solve(matrix, -np.einsum("ik,ik->i", stream, normals))
        speed = self._stream(flow, self._middle)
        speed = speed + np.einsum("ijk,j->ik", self._at_bounds, circulation)
        forces = circulation[:, None] * np.cross(speed, self._right - self._left)
        moments = np.cross(self._middle - self._centre, forces)
        pitch_up = moments[:, 1].sum() + self._section_moments(flow.controls)
        total = forces.sum(axis=0)
        half_area = 0.5 * self._area_m2
        alpha, beta = flow.alpha_rad, flow.beta_rad
        along = -total[0] * math.cos(alpha) - total[2] * math.sin(alpha)
        return Loads(
            lift=(total[2] * math.cos(alpha) - total[0] * math.sin(alpha)) / half_area,
            side=(total[1] * math.cos(beta) - along * math.sin(beta)) / half_area,
            # Axes that point aft and up turn roll and yaw round.
            roll=-moments[:, 0].sum() / (half_area * self._span_m),
            pitch=pitch_up / (half_area * self._chord_m),
            yaw=-moments[:, 2].sum() / (half_area * self._span_m),
        )

    def _stream(self, flow: Flow, points: Array) -> Array:
        alpha, beta = flow.alpha_rad, flow.beta_rad
        wind = np.array(
            [math.cos(alpha) * math.cos(beta), -math.sin(beta), math.sin(alpha) * math.cos(beta)]
        )
        rates = np.array(
            [
                -flow.roll * 2 / self._span_m,
                flow.pitch * 2 / self._chord_m,
                -flow.yaw * 2 / self._span_m,
            ]
        )
        return wind - np.cross(rates, points - self._centre)

    def _section_moments(self, controls: dict[str, float]) -> float:
        total = 0.0
        for panel in self._panels:
            width_m = abs(panel.right[1] - panel.left[1])
            moment = panel.moment + sum(
                angle * panel.flap_moments.get(name, 0.0) for name, angle in controls.items()
            )
            total += 0.5 * moment * panel.chord_m**2 * width_m
        return total


def _normal(panel: Panel, controls: dict[str, float]) -> Array:
    angle = panel.angle_rad + sum(
        turned * panel.flaps.get(name, 0.0) for name, turned in controls.items()
    )
    return panel.up * math.cos(angle) + np.array([1.0, 0.0, 0.0]) * math.sin(angle)


def _influences(points: Array, left: Array, right: Array, *, bound: bool) -> Array:
    """Return the velocity at each point that each horseshoe of unit strength induces."""
    a = points[:, None, :] - left[None, :, :]
    b = points[:, None, :] - right[None, :, :]
    influence = _trail(b) - _trail(a)
    if bound:
        influence += _segment(a, b)
    return influence


def _segment(a: Array, b: Array) -> Array:
    length_a = np.linalg.norm(a, axis=2)
    length_b = np.linalg.norm(b, axis=2)
    cross = np.cross(a, b)
    below = length_a * length_b * (length_a * length_b + np.einsum("ijk,ijk->ij", a, b))
    factor = (length_a + length_b) / (4 * math.pi * (below + _CORE_M**4))
    return np.asarray(cross * factor[:, :, None])


def _trail(from_start: Array) -> Array:
    """Return the velocity of a semi-infinite vortex from a point aft."""
    y, z = from_start[:, :, 1], from_start[:, :, 2]
    distance = np.linalg.norm(from_start, axis=2)
    factor = (1 + from_start[:, :, 0] / (distance + 1e-12)) / (y**2 + z**2 + _CORE_M**2)
    out = np.zeros_like(from_start)
    out[:, :, 1] = -z * factor
    out[:, :, 2] = y * factor
    return np.asarray(out / (4 * math.pi))
