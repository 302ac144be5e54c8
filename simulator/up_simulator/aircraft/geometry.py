"""geometry.yml: the construction of an aircraft, from which its flight model is derived."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from up.config import ConfigFile, items, key, section
from up.fields import Constraint

_NOTE = Constraint(str, max_length=400)


class ModelError(Exception):
    """A geometry gives no flight model: the message is one sentence."""


def _metres(comment: str, default: float = 0.0, least: float = -5.0, most: float = 5.0) -> float:
    return key(default, comment, unit="m", minimum=least, maximum=most)


def _share(comment: str, default: float, most: float = 1.0) -> float:
    return key(default, comment, minimum=0.0, maximum=most)


@dataclass(frozen=True, slots=True)
class Flap:
    """A hinged part of a surface; a ``chord_share`` of 0 means none."""

    chord_share: float = _share("Of the chord.", 0.0, 0.9)
    from_share: float = _share("Inner end, of the half span.", 0.0)
    to_share: float = _share("Outer end, of the half span.", 1.0)
    effectiveness: float = _share("Against thin-aerofoil theory: gaps, thick hinges, foam.", 0.75)

    def problems(self) -> Iterator[tuple[str, str]]:
        if self.from_share >= self.to_share:
            yield "to_share", f"must be above from_share, which is {self.from_share:g}"


@dataclass(frozen=True, slots=True)
class Surface:
    """A lifting surface. Places count from the root's leading edge of the wing."""

    root_x_m: float = _metres("Leading edge at the root, aft positive.")
    root_y_m: float = _metres("The root, right positive; for fins at the tips.")
    root_z_m: float = _metres("The root, up positive.")
    half_span_m: float = _metres("From root to tip along y; 0: there is no such surface.", 0.0, 0.0)
    height_m: float = _metres("For fins: from root to tip along z.", 0.0, 0.0)
    root_chord_m: float = _metres("Chord at the root.", 0.2, 0.01)
    tip_chord_m: float = _metres("Chord at the tip.", 0.2, 0.01)
    sweep_m: float = _metres("How far aft the tip's leading edge lies of the root's.")
    dihedral_deg: float = key(0.0, "Up positive.", unit="deg", minimum=-45, maximum=60)
    incidence_deg: float = key(
        0.0,
        "Against the body's axis, leading edge up positive.",
        unit="deg",
        minimum=-15,
        maximum=15,
    )
    washout_deg: float = key(
        0.0, "How much less incidence the tip has.", unit="deg", minimum=-10, maximum=10
    )
    zero_lift_deg: float = key(
        0.0, "Angle of no lift of the section.", unit="deg", minimum=-10, maximum=10
    )
    moment: float = key(
        0.0, "Moment coefficient of the section about its quarter chord.", minimum=-0.3, maximum=0.3
    )
    slope_share: float = _share(
        "Lift slope of the section against thin-aerofoil theory, low at these Reynolds numbers.",
        0.93,
        1.2,
    )
    profile_drag: float = _share("Least drag coefficient of the section.", 0.014, 0.2)
    flap: Flap = section(Flap, "Aileron, elevon, elevator or rudder.")


@dataclass(frozen=True, slots=True)
class Fuselage:
    """A body without lift that destabilises in yaw, and drags."""

    length_m: float = _metres("Length.", 0.8, 0.0)
    diameter_m: float = _metres("Mean diameter.", 0.06, 0.0)
    side_height_m: float = _metres("Mean height seen from the side.", 0.07, 0.0)
    nose_x_m: float = _metres("The nose, aft of the wing's root leading edge.", -0.3)
    friction_drag: float = _share("Drag coefficient by its wetted area.", 0.008, 0.2)


@dataclass(frozen=True, slots=True)
class Masses:
    """How heavy it is and how unwillingly it turns."""

    mass_kg: float = key(1.0, "Ready to fly.", unit="kg", minimum=0.05, maximum=100)
    centre_x_m: float = _metres("Centre of gravity, aft of the wing's root leading edge.", 0.07)
    centre_z_m: float = _metres("Centre of gravity, up positive.", 0.0)
    roll_kg_m2: float = key(0.1, "Inertia about x.", unit="kg m2", minimum=1e-5, maximum=1000)
    pitch_kg_m2: float = key(0.1, "Inertia about y.", unit="kg m2", minimum=1e-5, maximum=1000)
    yaw_kg_m2: float = key(0.2, "Inertia about z.", unit="kg m2", minimum=1e-5, maximum=1000)


@dataclass(frozen=True, slots=True)
class Stall:
    """Where the flow leaves the wing, and how."""

    positive_deg: float = key(12.0, "Upper stalling angle.", unit="deg", minimum=3, maximum=40)
    negative_deg: float = key(-9.0, "Lower stalling angle.", unit="deg", minimum=-40, maximum=-3)
    sharpness: float = key(
        45.0, "Of the transition; 30 is gentle, 100 sudden.", minimum=5, maximum=300
    )


@dataclass(frozen=True, slots=True)
class Geometry:
    """The construction of an aircraft: the wing, the tail, its masses."""

    notes: tuple[str, ...] = items(_NOTE, "Sentences for the notes of the model.", max_length=40)
    wing: Surface = section(Surface, "Both halves; its flap is the aileron or elevon.")
    tail: Surface = section(Surface, "The horizontal tail, both halves; its flap is the elevator.")
    fin: Surface = section(Surface, "The vertical tail; its flap is the rudder.")
    tip_fins: bool = key(False, "Whether the fin stands at both tips instead of once.")
    elevons: bool = key(False, "Whether the wing's flaps are the elevator, too.")
    fuselage: Fuselage = section(Fuselage)
    masses: Masses = section(Masses)
    stall: Stall = section(Stall)
    other_drag: float = _share("Gaps, wires, linkages, by the wing's area.", 0.004, 0.2)
    span_efficiency: float = _share("Oswald's factor of the wing alone.", 0.9, 1.2)

    def problems(self) -> Iterator[tuple[str, str]]:
        if self.wing.half_span_m < 0.05:
            yield "wing", "must have a half_span_m of at least 0.05 m"
        if self.span_efficiency < 0.3:
            yield "span_efficiency", "must be at least 0.3"
        if self.elevons and self.tail.half_span_m:
            yield "elevons", "must be false where a tail has the elevator"


GEOMETRY = ConfigFile("geometry.yml", Geometry)
