"""Derives the flight coefficients from a geometry, for every angle of attack and sideslip.

Attached flow comes from a vortex lattice (``lattice.py``) and a drag build-up, separated flow from
a flat plate; between them the blend of Beard and McLain (Small Unmanned Aircraft, 4.2). Each
function states its assumptions.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cached_property

from up_simulator.aircraft.geometry import Geometry
from up_simulator.aircraft.lattice import Flow, Loads
from up_simulator.aircraft.panels import area_of, lattice_of, references

ALPHAS_DEG = (
    -180.0, -170.0, -150.0, -135.0, -120.0, -105.0, -90.0, -75.0, -60.0, -50.0, -40.0, -35.0,
    -30.0, -25.0, -22.0, -20.0, -18.0, -16.0, -15.0, -14.0, -13.0, -12.0, -11.0, -10.0, -9.0, -8.0,
    -7.0, -6.0, -4.0, -2.0, 0.0, 2.0, 4.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0, 15.0,
    16.0, 18.0, 20.0, 22.0, 25.0, 30.0, 35.0, 40.0, 50.0, 60.0, 75.0, 90.0, 105.0, 120.0, 135.0,
    150.0, 170.0, 180.0,
)  # fmt: skip
BETAS_DEG = tuple(
    sign * each
    for sign, row in (
        (-1, (90, 70, 50, 35, 25, 20, 17, 15, 12, 8, 4)),
        (1, (0, 4, 8, 12, 15, 17, 20, 25, 35, 50, 70, 90)),
    )
    for each in row
)
_STEP = 0.01
_PLATE_NORMAL = 1.25
_DRAG_OF_LIFT = 0.008
DRAG_OF_DEFLECTION = 0.15
"""Of a surface, by the square of the deflection, per square radian."""
_FIN_STALL_DEG = 16.0
_TAIL_STALL_DEG = 24.0
_CROSSFLOW_DRAG = 0.8


class Derivation:
    """The coefficients of one geometry. References: wing area, span, mean aerodynamic chord."""

    def __init__(self, geometry: Geometry) -> None:
        self.geometry = geometry
        self.area_m2, self.span_m, self.chord_m = references(geometry.wing)
        self.aspect = self.span_m**2 / self.area_m2
        self._lattice = lattice_of(geometry)
        self._loads: dict[float, Loads] = {}
        self._derivatives: dict[tuple[str, float], Loads] = {}

    def loads(self, alpha_deg: float) -> Loads:
        """Return the loads of attached flow without sideslip, rates and deflections."""
        if alpha_deg not in self._loads:
            flow = Flow(alpha_rad=math.radians(alpha_deg))
            self._loads[alpha_deg] = self._lattice.loads(flow)
        return self._loads[alpha_deg]

    def by(self, what: str, alpha_deg: float = 0.0) -> Loads:
        """Return the derivatives by ``alpha_rad``, ``beta_rad``, a rate or a control's name.

        They are per radian, or per unit of a rate made pure.
        """
        if (what, alpha_deg) not in self._derivatives:
            self._derivatives[what, alpha_deg] = self._differentiate(what, alpha_deg)
        return self._derivatives[what, alpha_deg]

    def _differentiate(self, what: str, alpha_deg: float) -> Loads:
        alpha = math.radians(alpha_deg)
        sides = []
        for step in (_STEP, -_STEP):
            if what in ("ailerons", "elevator", "rudder"):
                flow = Flow(alpha_rad=alpha, controls={what: step})
            elif what == "alpha_rad":
                flow = Flow(alpha_rad=alpha + step)
            else:
                flow = Flow(alpha_rad=alpha)
                flow = replace(flow, **{what: step})  # type: ignore[arg-type]
            sides.append(self._lattice.loads(flow))
        above, below = sides
        return Loads(
            *(
                float(getattr(above, name) - getattr(below, name)) / (2 * _STEP)
                for name in ("lift", "side", "roll", "pitch", "yaw")
            )
        )

    def attached(self, alpha_deg: float, widened_deg: float = 0.0) -> float:
        """Return the share of attached flow, 1 well below the stall and 0 well above."""
        stall = self.geometry.stall
        sharpness = stall.sharpness
        above = math.exp(
            _bounded(-sharpness * math.radians(alpha_deg - stall.positive_deg - widened_deg))
        )
        below = math.exp(
            _bounded(sharpness * math.radians(alpha_deg - stall.negative_deg + widened_deg))
        )
        return 1.0 - (1 + above + below) / ((1 + above) * (1 + below))

    def lift(self, alpha_deg: float) -> float:
        share = self.attached(alpha_deg)
        plate = plate_normal(alpha_deg) * math.cos(math.radians(alpha_deg))
        return share * self._attached_lift(alpha_deg) + (1 - share) * plate

    def drag(self, alpha_deg: float) -> float:
        share = self.attached(alpha_deg)
        lift = self._attached_lift(alpha_deg)
        attached = (
            self.parasite_drag
            + _DRAG_OF_LIFT * (lift - 0.3) ** 2
            + lift**2 / (math.pi * self.aspect * self.geometry.span_efficiency)
        )
        plate = plate_normal(alpha_deg) * math.sin(math.radians(alpha_deg))
        return share * attached + (1 - share) * (self.parasite_drag + plate)

    def pitch(self, alpha_deg: float) -> float:
        """Return the pitching moment: lattice and fuselage, and a plate that pitches down.

        A separated wing's centre of pressure moves from the quarter to the half chord.
        """
        share = self.attached(alpha_deg)
        alpha = math.radians(alpha_deg)
        attached = float(self.loads(_clipped(alpha_deg)).pitch)
        munk = self.munk_pitch * math.sin(2 * alpha) / 2
        separated = -plate_normal(alpha_deg) * (self._half_chord_arm_m / self.chord_m)
        return (
            share * attached + (1 - share) * separated + munk + self._plate_tail(alpha_deg, share)
        )

    def _plate_tail(self, alpha_deg: float, share: float) -> float:
        """Return the moment of the tail where the wing's wake does not reach it."""
        return -(1 - share) * self._tail_volume * plate_normal(alpha_deg) * 0.9

    @cached_property
    def parasite_drag(self) -> float:
        geometry = self.geometry
        fins = 2 if geometry.tip_fins else 1
        drag = geometry.wing.profile_drag * self.area_m2
        if geometry.tail.half_span_m:
            drag += geometry.tail.profile_drag * area_of(geometry.tail)
        drag += geometry.fin.profile_drag * area_of(geometry.fin) * fins
        fuselage = geometry.fuselage
        drag += fuselage.friction_drag * math.pi * fuselage.diameter_m * fuselage.length_m
        return drag / self.area_m2 + geometry.other_drag

    @cached_property
    def munk_pitch(self) -> float:
        """Return the fuselage's share of the slope of the pitching moment (slender body)."""
        fuselage = self.geometry.fuselage
        volume_m3 = math.pi / 4 * fuselage.diameter_m**2 * fuselage.length_m
        return 2 * 0.9 * volume_m3 / (self.area_m2 * self.chord_m)

    @cached_property
    def munk_yaw(self) -> float:
        """Return the fuselage's share of the slope of the yawing moment (slender body)."""
        fuselage = self.geometry.fuselage
        volume_m3 = math.pi / 4 * fuselage.side_height_m**2 * fuselage.length_m
        return -2 * 0.9 * volume_m3 / (self.area_m2 * self.span_m)

    @cached_property
    def downwash_lag(self) -> float:
        """Return the pitching moment by the rate of the angle of attack, per pure rate.

        The tail feels the downwash that left the wing a moment ago: the share of the pitch damping
        that the slope of the downwash, 2 CL_alpha / (pi A), is of 1.
        """
        if not self._tail_volume:
            return 0.0
        return self.by("pitch").pitch * 2 * self.by("alpha_rad").lift / (math.pi * self.aspect)

    def side(self, beta_deg: float) -> float:
        """Return the side force coefficient of a sideslip; the fuselage contributes as a body."""
        slope = self.by("beta_rad").side
        fuselage = self.geometry.fuselage
        body = _CROSSFLOW_DRAG * fuselage.length_m * fuselage.side_height_m / self.area_m2
        sine = math.sin(math.radians(beta_deg))
        return slope * self._fin_share(beta_deg) - body * sine * abs(sine)

    def yaw(self, beta_deg: float) -> float:
        """Return the yawing moment of a sideslip: fin and fuselage, both past the fin's stall."""
        beta = math.radians(beta_deg)
        return (
            self.by("beta_rad").yaw * self._fin_share(beta_deg)
            + self.munk_yaw * math.sin(2 * beta) / 2
        )

    def _fin_share(self, beta_deg: float) -> float:
        """Return the fin's effective sideslip for attached flow, rad."""
        beta = math.radians(beta_deg)
        steepness = 40.0
        inside = 1 / (
            1 + math.exp(_bounded(steepness * (abs(beta) - math.radians(_FIN_STALL_DEG))))
        )
        plate = plate_normal(beta_deg) / 3.2
        return inside * beta + (1 - inside) * plate

    def lateral(self, what: str, alpha_deg: float) -> tuple[float, float]:
        """Return rolling and yawing moment by a rate, a deflection or the sideslip at an angle.

        Past the stall a part of them is left, less at a greater angle; the roll damping follows
        the slope of the lift, so that a stalled wing may autorotate (strip theory).
        """
        share = self.attached(alpha_deg)
        found = self.by(what, _clipped(alpha_deg))
        turned = abs(math.cos(math.radians(alpha_deg)))
        left = share + (1 - share) * 0.3 * turned
        if what == "roll":
            slope = self._lift_slope(alpha_deg) / self.by("alpha_rad").lift
            damping = found.roll * max(-0.1, slope) - self.drag(alpha_deg) / 8
            return damping, found.yaw * left
        return found.roll * left, found.yaw * left

    def elevator(self, alpha_deg: float) -> tuple[float, float]:
        """Return lift and pitching moment by the elevator, trailing edge down."""
        widened = (
            0.0 if self.geometry.elevons else _TAIL_STALL_DEG - self.geometry.stall.positive_deg
        )
        share = self.attached(alpha_deg, widened)
        left = share + (1 - share) * 0.35 * abs(math.cos(math.radians(alpha_deg)))
        found = self.by("elevator")
        return found.lift * left, found.pitch * left

    @cached_property
    def crossflow_drag(self) -> float:
        """Return the drag in a flow from the side: fuselage and fins."""
        geometry = self.geometry
        sides = geometry.fuselage.length_m * geometry.fuselage.side_height_m
        fins = 2 if geometry.tip_fins else 1
        return _CROSSFLOW_DRAG * (sides + area_of(geometry.fin) * fins) / self.area_m2

    def _attached_lift(self, alpha_deg: float) -> float:
        return float(self.loads(_clipped(alpha_deg)).lift)

    def _lift_slope(self, alpha_deg: float) -> float:
        width = math.radians(2.0)
        return (self.lift(alpha_deg + 1.0) - self.lift(alpha_deg - 1.0)) / width

    @cached_property
    def _tail_volume(self) -> float:
        tail = self.geometry.tail
        if not tail.half_span_m:
            return 0.0
        arm_m = tail.root_x_m + tail.root_chord_m / 4 - self.geometry.masses.centre_x_m
        return area_of(tail) * arm_m / (self.area_m2 * self.chord_m)

    @cached_property
    def _half_chord_arm_m(self) -> float:
        wing = self.geometry.wing
        taper = wing.tip_chord_m / wing.root_chord_m
        at = (1 + 2 * taper) / (3 * (1 + taper))
        half_chord_m = wing.root_x_m + at * wing.sweep_m + self.chord_m / 2
        return half_chord_m - self.geometry.masses.centre_x_m


def plate_normal(alpha_deg: float) -> float:
    """Return the normal force of a flat plate across all angles (Hoerner, Fluid-Dynamic Lift)."""
    sine = math.sin(math.radians(alpha_deg))
    return _PLATE_NORMAL * sine / (0.56 + 0.44 * abs(sine))


def _clipped(alpha_deg: float) -> float:
    """Keep to where the lattice means something: its blend has ended beyond."""
    return max(-25.0, min(25.0, alpha_deg))


def _bounded(exponent: float) -> float:
    return max(-50.0, min(50.0, exponent))
