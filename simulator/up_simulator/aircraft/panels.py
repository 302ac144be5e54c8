"""The surfaces of a geometry as panels of the lattice."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from up_simulator.aircraft.geometry import Geometry, Surface
from up_simulator.aircraft.lattice import Array, Lattice, Panel

WING_PANELS, TAIL_PANELS, FIN_PANELS = 24, 10, 8


def lattice_of(geometry: Geometry) -> Lattice:
    """Return the lattice of the whole aircraft about its centre of gravity."""
    area_m2, span_m, chord_m = references(geometry.wing)
    centre = np.array([geometry.masses.centre_x_m, 0.0, geometry.masses.centre_z_m])
    return Lattice(list(_panels(geometry)), area_m2, span_m, chord_m, centre)


def references(wing: Surface) -> tuple[float, float, float]:
    """Return area (m2), span (m) and mean aerodynamic chord (m) of a wing."""
    span_m = 2 * wing.half_span_m
    taper = wing.tip_chord_m / wing.root_chord_m
    chord_m = 2 / 3 * wing.root_chord_m * (1 + taper + taper**2) / (1 + taper)
    return area_of(wing), span_m, chord_m


def area_of(surface: Surface) -> float:
    """Return the area of both halves (of a fin: of the one), m2."""
    width_m = math.hypot(2 * surface.half_span_m, surface.height_m)
    return width_m * (surface.root_chord_m + surface.tip_chord_m) / 2


def _panels(geometry: Geometry) -> Iterator[Panel]:
    wing = {"ailerons": 1.0, "elevator": 1.0} if geometry.elevons else {"ailerons": 1.0}
    other = {**wing, "ailerons": -1.0}
    # Trailing edge down is positive; left down and right up rolls to the right.
    yield from _both_sides(geometry.wing, WING_PANELS, right=other, left=wing)
    if geometry.tail.half_span_m:
        elevator = {"elevator": 1.0}
        yield from _both_sides(geometry.tail, TAIL_PANELS, right=elevator, left=elevator)
    if geometry.fin.height_m:
        # A fin's strips run upwards, so that its trailing edge to the right is positive.
        for strip, at in _strips(geometry.fin, FIN_PANELS):
            yield _with_flaps(strip, geometry.fin, at, {"rudder": -1.0})
            if geometry.tip_fins:
                right = _with_flaps(strip, geometry.fin, at, {"rudder": -1.0})
                left = {name: -each for name, each in right.flaps.items()}
                yield right.mirrored(left, {})


def _both_sides(
    surface: Surface, count: int, right: dict[str, float], left: dict[str, float]
) -> Iterator[Panel]:
    for strip, at in _strips(surface, count):
        yield _with_flaps(strip, surface, at, right)
        mirror = _with_flaps(strip, surface, at, left)
        yield strip.mirrored(mirror.flaps, mirror.flap_moments)


def _strips(surface: Surface, count: int) -> Iterator[tuple[Panel, float]]:
    """Yield the strips from root to tip, narrow at the tip, and where their middles are."""
    edges = [math.sin(math.pi / 2 * index / count) for index in range(count + 1)]
    for inner, outer in itertools.pairwise(edges):
        at = (inner + outer) / 2
        chord_m = surface.root_chord_m + at * (surface.tip_chord_m - surface.root_chord_m)
        left, right = _quarter_chord(surface, inner), _quarter_chord(surface, outer)
        across = np.cross([1.0, 0.0, 0.0], right - left)
        angle_deg = surface.incidence_deg - at * surface.washout_deg - surface.zero_lift_deg
        yield (
            Panel(
                left=left,
                right=right,
                chord_m=chord_m,
                up=across / np.linalg.norm(across),
                angle_rad=math.radians(angle_deg),
                slope_share=surface.slope_share,
                moment=surface.moment,
            ),
            at,
        )


def _quarter_chord(surface: Surface, at: float) -> Array:
    chord_m = surface.root_chord_m + at * (surface.tip_chord_m - surface.root_chord_m)
    rise_m = math.tan(math.radians(surface.dihedral_deg)) * surface.half_span_m
    return np.array(
        [
            surface.root_x_m + at * surface.sweep_m + chord_m / 4,
            surface.root_y_m + at * surface.half_span_m,
            surface.root_z_m + at * (rise_m + surface.height_m),
        ]
    )


def _with_flaps(strip: Panel, surface: Surface, at: float, controls: dict[str, float]) -> Panel:
    """Return the strip with its response to a radian of each control.

    Thin-aerofoil theory of a plain flap (Katz and Plotkin, 5.4).
    """
    flap = surface.flap
    if not flap.chord_share or not flap.from_share <= at <= flap.to_share:
        return strip
    hinge = math.acos(2 * flap.chord_share - 1)
    share = flap.effectiveness * (1 - (hinge - math.sin(hinge)) / math.pi)
    moment = -flap.effectiveness * math.sin(hinge) * (1 - math.cos(hinge)) / 2
    return replace(
        strip,
        flaps={name: sign * share for name, sign in controls.items()},
        flap_moments={name: sign * moment for name, sign in controls.items()},
    )
