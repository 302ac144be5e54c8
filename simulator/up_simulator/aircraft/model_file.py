"""The JSBSim model of a derivation: ``python -m up_simulator.aircraft.model_file FOLDER``."""

from __future__ import annotations

import hashlib
import sys
import textwrap
from collections.abc import Callable, Sequence
from pathlib import Path
from xml.sax.saxutils import escape

import numpy as np

from up.config import ConfigErrors
from up_simulator.aircraft.derivation import (
    ALPHAS_DEG,
    BETAS_DEG,
    DRAG_OF_DEFLECTION,
    Derivation,
)
from up_simulator.aircraft.flight import FlightUnavailableError
from up_simulator.aircraft.geometry import GEOMETRY, ModelError
from up_simulator.aircraft.glide import describe
from up_simulator.firmware.kept import cache_path, keep

# What a wing that is one has by the radian.
_LEAST_SLOPE, _GREATEST_SLOPE = 0.3, 9.0
_QBAR_AREA = ("aero/qbar-psf", "metrics/Sw-sqft")


def model_text(name: str, derivation: Derivation) -> str:
    """Return the XML that JSBSim loads; the same geometry gives the same text."""
    return "\n".join(
        [
            '<?xml version="1.0"?>',
            f'<fdm_config name="{escape(name)}" version="2.0" release="BETA">',
            _header(name, derivation),
            _metrics(derivation),
            _masses(derivation),
            _CONTACTS,
            _motor(derivation),
            _aerodynamics(derivation),
            "</fdm_config>",
            "",
        ]
    )


def _header(name: str, derivation: Derivation) -> str:
    lines = [
        f"Written by 'python -m up_simulator.aircraft.model_file {name}' from geometry.yml.",
        "Lengths x aft, y right, z up from the leading edge of the wing's root; the reference",
        "point of the forces is the centre of gravity. Surfaces: trailing edge down positive,",
        "rudder trailing edge left; left and right ailerons have an angle of their own.",
        "Attached flow: vortex lattice; separated: flat plate; drag: build-up of the sections.",
        *(line for note in derivation.geometry.notes for line in textwrap.wrap(note, 94)),
        "Derivatives at 0 degrees of alpha, per rad and per p b/2V, q c/2V, r b/2V:",
        *_derivative_lines(derivation),
    ]
    notes = "\n".join(f"    {escape(line)}" for line in lines)
    return (
        f" <fileheader>\n  <author>Raspilot</author>\n  <description>{escape(name)}"
        f"</description>\n  <note>\n{notes}\n  </note>\n </fileheader>"
    )


def _derivative_lines(derivation: Derivation) -> list[str]:
    found = []
    for what in ("alpha_rad", "beta_rad", "roll", "pitch", "yaw", "ailerons", "elevator", "rudder"):
        one = derivation.by(what)
        found.append(
            f"  {what.removesuffix('_rad'):9} CL {one.lift:8.4f} CY {one.side:8.4f} "
            f"Cl {one.roll:8.4f} Cm {one.pitch:8.4f} Cn {one.yaw:8.4f}"
        )
    found.append(f"  parasite drag {derivation.parasite_drag:.4f}")
    return found


def _metrics(derivation: Derivation) -> str:
    masses = derivation.geometry.masses
    return "\n".join(
        [
            " <metrics>",
            f'  <wingarea unit="M2">{derivation.area_m2:.5f}</wingarea>',
            f'  <wingspan unit="M">{derivation.span_m:.4f}</wingspan>',
            f'  <chord unit="M">{derivation.chord_m:.5f}</chord>',
            *(
                _location(point, masses.centre_x_m, masses.centre_z_m)
                for point in ("AERORP", "EYEPOINT", "VRP")
            ),
            " </metrics>",
        ]
    )


def _location(name: str, x_m: float, z_m: float) -> str:
    return f'  <location name="{name}" unit="M"><x>{x_m:g}</x><y>0</y><z>{z_m:g}</z></location>'


def _masses(derivation: Derivation) -> str:
    masses = derivation.geometry.masses
    return "\n".join(
        [
            " <mass_balance>",
            f'  <ixx unit="KG*M2">{masses.roll_kg_m2:g}</ixx>',
            f'  <iyy unit="KG*M2">{masses.pitch_kg_m2:g}</iyy>',
            f'  <izz unit="KG*M2">{masses.yaw_kg_m2:g}</izz>',
            f'  <emptywt unit="KG">{masses.mass_kg:g}</emptywt>',
            _location("CG", masses.centre_x_m, masses.centre_z_m),
            " </mass_balance>",
        ]
    )


def _aerodynamics(derivation: Derivation) -> str:
    elevons = derivation.geometry.elevons
    rudder = derivation.by("rudder")
    side_rates = {name: derivation.by(name).side for name in ("roll", "yaw")}
    lift_by_pitch = derivation.by("pitch").lift

    def alpha(value: Callable[[float], float]) -> str:
        return _table("aero/alpha-deg", ALPHAS_DEG, value)

    def lateral(what: str, moment: int) -> Callable[[float], float]:
        return lambda degrees: derivation.lateral(what, degrees)[moment]

    def attached(degrees: float) -> float:
        return 0.4 + 0.6 * derivation.attached(degrees, 8.0)

    ailerons = _DIFFERENCE
    elevator = _SUM if elevons else _property("fcs/elevator-pos-rad")
    turned = _property("fcs/rudder-pos-rad")
    sine_beta = "<sin><property>aero/beta-rad</property></sin>"
    cosine_squared = "<pow><cos><property>aero/beta-rad</property></cos><value>2</value></pow>"
    roll = _rate("p", "aero/bi2vel")
    pitch = _rate("q", "aero/ci2vel")
    yaw = _rate("r", "aero/bi2vel")
    parts = [
        " <aerodynamics>",
        '  <axis name="LIFT">',
        _force("lift", cosine_squared, alpha(derivation.lift)),
        _force("lift-elevator", elevator, alpha(lambda at: derivation.elevator(at)[0])),
        _force("lift-pitching", *pitch, _value(lift_by_pitch), alpha(derivation.attached)),
        "  </axis>",
        '  <axis name="DRAG">',
        _force("drag", cosine_squared, alpha(derivation.drag)),
        _force("drag-sideslip", sine_beta, sine_beta, _value(derivation.crossflow_drag)),
        _force("drag-elevator", elevator, elevator, _value(DRAG_OF_DEFLECTION)),
        _force("drag-ailerons", ailerons, ailerons, _value(DRAG_OF_DEFLECTION)),
        "  </axis>",
        '  <axis name="SIDE">',
        _force("side", _table("aero/beta-deg", BETAS_DEG, derivation.side)),
        _force("side-rudder", turned, _value(rudder.side)),
        _force("side-rolling", *roll, _value(side_rates["roll"])),
        _force("side-yawing", *yaw, _value(side_rates["yaw"])),
        "  </axis>",
        '  <axis name="ROLL">',
        _moment("roll-sideslip", "bw", sine_beta, alpha(lateral("beta_rad", 0))),
        _moment("roll-rolling", "bw", *roll, alpha(lateral("roll", 0))),
        _moment("roll-yawing", "bw", *yaw, alpha(lateral("yaw", 0))),
        _moment("roll-ailerons", "bw", ailerons, alpha(lateral("ailerons", 0))),
        _moment("roll-rudder", "bw", turned, _value(rudder.roll)),
        "  </axis>",
        '  <axis name="PITCH">',
        _moment("pitch", "cbarw", alpha(derivation.pitch)),
        _moment("pitch-pitching", "cbarw", *pitch, _value(derivation.by("pitch").pitch)),
        _moment(
            "pitch-downwash",
            "cbarw",
            _property("aero/alphadot-rad_sec"),
            _property("aero/ci2vel"),
            _value(derivation.downwash_lag),
            alpha(derivation.attached),
        ),
        _moment(
            "pitch-elevator", "cbarw", elevator, alpha(lambda at: derivation.elevator(at)[1])
        ),
        "  </axis>",
        '  <axis name="YAW">',
        _moment(
            "yaw-sideslip", "bw", alpha(attached),
            _table("aero/beta-deg", BETAS_DEG, derivation.yaw),
        ),
        _moment("yaw-rolling", "bw", *roll, alpha(lateral("roll", 1))),
        _moment("yaw-yawing", "bw", *yaw, _value(derivation.by("yaw").yaw)),
        _moment("yaw-ailerons", "bw", ailerons, alpha(lateral("ailerons", 1))),
        _moment("yaw-rudder", "bw", turned, _value(rudder.yaw), alpha(attached)),
        "  </axis>",
        " </aerodynamics>",
    ]  # fmt: skip
    return "\n".join(parts)


def _force(name: str, *factors: str) -> str:
    return _function(name, (*map(_property, _QBAR_AREA), *factors))


def _moment(name: str, length: str, *factors: str) -> str:
    lengths = (*_QBAR_AREA, f"metrics/{length}-ft")
    return _function(name, (*map(_property, lengths), *factors))


def _function(name: str, factors: Sequence[str]) -> str:
    inside = "\n".join(f"    {each}" for each in factors)
    return (
        f'  <function name="aero/coefficient/{name}">\n   <product>\n{inside}\n'
        "   </product>\n  </function>"
    )


def _rate(letter: str, to_pure: str) -> tuple[str, str]:
    return _property(f"velocities/{letter}-aero-rad_sec"), _property(to_pure)


def _property(name: str) -> str:
    return f"<property>{name}</property>"


def _value(number: float) -> str:
    return f"<value>{number:.5f}</value>"


def _table(by: str, angles_deg: Sequence[float], value: Callable[[float], float]) -> str:
    rows = "\n".join(f"      {at:6.0f} {value(at):9.5f}" for at in angles_deg)
    return (
        f"<table><independentVar>{by}</independentVar><tableData>\n{rows}\n    </tableData></table>"
    )


_LEFT, _RIGHT = _property("fcs/left-aileron-pos-rad"), _property("fcs/right-aileron-pos-rad")
_DIFFERENCE = f"<product><value>0.5</value><difference>{_LEFT}{_RIGHT}</difference></product>"
_SUM = f"<product><value>0.5</value><sum>{_LEFT}{_RIGHT}</sum></product>"
# The simulator, not JSBSim, decides where the flight ends at the ground.
_CONTACTS = " <ground_reactions/>"


def _motor(derivation: Derivation) -> str:
    masses = derivation.geometry.masses
    return f"""\
 <external_reactions>
  <force name="motor" frame="BODY">
   <location unit="M"><x>{masses.centre_x_m:g}</x><y>0</y><z>{masses.centre_z_m:g}</z></location>
   <direction><x>1</x><y>0</y><z>0</z></direction>
  </force>
 </external_reactions>"""


def derive(folder: Path) -> Derivation:
    """Return the model of a folder's geometry; raises ``ConfigErrors`` and ``ModelError``."""
    derivation = Derivation(GEOMETRY.load(folder))
    try:
        slope = derivation.by("alpha_rad").lift
    except np.linalg.LinAlgError:
        slope = 0.0
    if not _LEAST_SLOPE < slope < _GREATEST_SLOPE:
        raise ModelError(
            f"{folder / GEOMETRY.filename}: surfaces lie in each other's vortices "
            f"(a lift slope of {slope:.3g}): move the tail up, down or aft"
        )
    return derivation


def derived_model(folder: Path) -> Path:
    """Return the model of a folder's geometry, derived once and kept (0.2 s).

    Raises ``ModelError`` and, where it cannot be written, ``FlightUnavailableError``.
    """
    sources = [folder / GEOMETRY.filename, *sorted(Path(__file__).parent.glob("*.py"))]
    digest = hashlib.sha256(b"".join(each.read_bytes() for each in sources)).hexdigest()[:32]
    kept = cache_path("models", f"{digest}.xml")
    if not kept.is_file():
        text = model_text(folder.resolve().name, derive(folder))
        try:
            keep(kept, text.encode())
        except OSError as error:
            raise FlightUnavailableError(f"{kept}: {error.strerror or error}") from error
    return kept


def main(arguments: Sequence[str] | None = None) -> int:
    """Write ``<folder>/<folder's name>.xml`` and return the exit status."""
    names = list(sys.argv[1:] if arguments is None else arguments)
    if not names:
        sys.stderr.write("usage: python -m up_simulator.aircraft.model_file FOLDER ...\n")
        return 2
    for folder in map(Path, names):
        if not (folder / GEOMETRY.filename).is_file():
            sys.stderr.write(f"{folder / GEOMETRY.filename}: no such file\n")
            return 2
        name = folder.resolve().name
        path = folder / f"{name}.xml"
        try:
            derivation = derive(folder)
            path.write_text(model_text(name, derivation), "utf-8")
        except (ConfigErrors, ModelError) as error:
            sys.stderr.write(f"{error}\n")
            return 2
        except OSError as error:
            sys.stderr.write(f"{path}: {error.strerror or error}\n")
            return 1
        sys.stdout.write(f"{path}: {describe(derivation)}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
