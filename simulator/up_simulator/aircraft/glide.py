"""Flight performance from coefficients: trim, stall and best glide."""

from __future__ import annotations

import math
from dataclasses import dataclass

from up_simulator.aircraft.derivation import Derivation

_AIR_KG_M3 = 1.18
"""At 370 m above the sea, where flights begin."""
_GRAVITY = 9.81
_LOWEST_DEG, _HIGHEST_DEG = -10.0, 15.0


@dataclass(frozen=True, slots=True)
class Glide:
    """A steady glide with the motor off. ``margin`` is the static margin, of the mean chord."""

    alpha_deg: float
    pitch_deg: float
    airspeed_m_s: float
    ratio: float
    margin: float


def trimmed_glide(derivation: Derivation) -> Glide | None:
    """Return the glide with neutral surfaces; None where the aircraft does not hold itself."""
    low, high = _LOWEST_DEG, _HIGHEST_DEG
    if not derivation.pitch(low) > 0.0 > derivation.pitch(high):
        return None
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if derivation.pitch(middle) > 0.0 else (low, middle)
    if derivation.lift(low) < 0.02 or derivation.attached(low) < 0.9:
        return None
    found = glide_at(derivation, low)
    return found if found.margin > 0.0 else None


def glide_at(derivation: Derivation, alpha_deg: float) -> Glide:
    """Return the glide at an angle of attack that lifts."""
    lift, drag = derivation.lift(alpha_deg), derivation.drag(alpha_deg)
    slopes = (
        each(alpha_deg + 1.0) - each(alpha_deg - 1.0)
        for each in (derivation.pitch, derivation.lift)
    )
    by_pitch, by_lift = slopes
    return Glide(
        alpha_deg=alpha_deg,
        pitch_deg=alpha_deg - math.degrees(math.atan2(drag, lift)),
        airspeed_m_s=_speed_m_s(derivation, math.hypot(lift, drag)),
        ratio=lift / drag,
        margin=-by_pitch / by_lift,
    )


def best_glide(derivation: Derivation) -> Glide:
    """Return the flattest glide, whatever the elevator has to do for it."""
    angles = [_LOWEST_DEG + each / 4 for each in range(100)]
    best = max(angles, key=lambda at: derivation.lift(at) / derivation.drag(at))
    return glide_at(derivation, best)


def stall_speed_m_s(derivation: Derivation) -> float:
    """Return the slowest speed at which the wing carries the aircraft."""
    return _speed_m_s(derivation, max(derivation.lift(each / 4) for each in range(120)))


def describe(derivation: Derivation) -> str:
    """Return one line for the designer, with the values for airframe.yml."""
    best = best_glide(derivation)
    text = (
        f"stalls at {stall_speed_m_s(derivation):.1f} m/s, glides best {best.ratio:.1f} to 1 at "
        f"{best.airspeed_m_s:.1f} m/s"
    )
    trimmed = trimmed_glide(derivation)
    if trimmed is None:
        return f"{text}; does NOT hold itself with neutral surfaces: centre of gravity, incidences"
    return (
        f"{text}; neutral: airspeed_m_s: {trimmed.airspeed_m_s:.1f}, pitch_deg: "
        f"{trimmed.pitch_deg:.1f}, alpha_deg: {trimmed.alpha_deg:.1f}, static margin "
        f"{100 * trimmed.margin:.0f} %"
    )


def _speed_m_s(derivation: Derivation, coefficient: float) -> float:
    weight_n = derivation.geometry.masses.mass_kg * _GRAVITY
    return math.sqrt(2 * weight_n / (_AIR_KG_M3 * derivation.area_m2 * coefficient))
