"""From geometry to coefficients: the lattice against theory, the shipped models against it."""

import dataclasses
import functools
import math

import pytest

from up_simulator.aircraft import airframe_names
from up_simulator.aircraft.airframe import SHIPPED
from up_simulator.aircraft.derivation import ALPHAS_DEG, BETAS_DEG, Derivation
from up_simulator.aircraft.geometry import GEOMETRY, Flap, Fuselage, Geometry, Masses, Surface
from up_simulator.aircraft.model_file import main, model_text
from up_simulator.aircraft.panels import references

NAMES = airframe_names()


@functools.cache
def derived(name):
    return Derivation(GEOMETRY.load(SHIPPED / name))


def plain_wing(aspect=8.0, **changes):
    """A straight wing of chord 0.2 m, turning about its quarter chord."""
    values = {"half_span_m": aspect * 0.1, "root_chord_m": 0.2, "tip_chord_m": 0.2}
    wing = Surface(**{**values, "slope_share": 1.0, **changes})
    return Geometry(wing=wing, fuselage=Fuselage(length_m=0.0), masses=Masses(centre_x_m=0.05))


def test_the_program_writes_the_model(tmp_path):
    folder = tmp_path / "mine"
    folder.mkdir()
    (folder / "geometry.yml").write_text((SHIPPED / "glider" / "geometry.yml").read_text())
    assert main([str(folder)]) == 0
    assert (folder / "mine.xml").read_text() == model_text("mine", derived("glider"))


def test_the_program_prints_the_performance(tmp_path, capsys):
    text = (SHIPPED / "glider" / "geometry.yml").read_text()
    (tmp_path / "geometry.yml").write_text(text)
    assert main([str(tmp_path)]) == 0
    printed = capsys.readouterr().out
    for figure in ("6.2 m/s", "airspeed_m_s: 11.1", "pitch_deg: -5.2", "static margin 14 %"):
        assert figure in printed
    (tmp_path / "geometry.yml").write_text(text.replace("centre_x_m: 0.08", "centre_x_m: 0.16"))
    assert main([str(tmp_path)]) == 0
    assert "static margin" not in capsys.readouterr().out


@pytest.mark.parametrize(
    "text",
    ["wing: {half_span: 1}", "wing: {half_span_m: 1, flap: {from_share: 1.0}}", "- 1",
     "fin: {height_m: 0.2}", "wing: {half_span_m: 0.6}\ntail: {half_span_m: 0.6}\n"],
)  # fmt: skip
def test_a_wrong_geometry_is_one_line_with_its_place(tmp_path, capsys, text):
    (tmp_path / "geometry.yml").write_text(text)
    assert main([str(tmp_path)]) == 2
    printed = capsys.readouterr().err
    assert "geometry.yml:1:" in printed or "vortices" in printed
    assert len(printed.splitlines()) == 1


def test_the_program_requires_a_folder_with_a_geometry(tmp_path, capsys):
    assert main([str(tmp_path)]) == 2
    assert str(tmp_path / "geometry.yml") in capsys.readouterr().err
    assert main([]) == 2


@pytest.mark.parametrize("aspect", [5.0, 8.0, 12.0])
def test_a_plain_wing_lifts_nearly_as_helmbold_says(aspect):
    """CL_alpha = 2 pi A / (2 + sqrt(A^2 + 4)) of an elliptical wing; a rectangular one has less."""
    found = Derivation(plain_wing(aspect)).by("alpha_rad")
    elliptical = 2 * math.pi * aspect / (2 + math.sqrt(aspect**2 + 4))
    assert 0.92 * elliptical < found.lift < elliptical
    # It acts at the quarter chord, about which it turns.
    assert found.pitch == pytest.approx(0.0, abs=0.05)


def test_a_plain_wing_damps_rolling_as_the_charts_say():
    """DATCOM 7.1.2.2: about -0.48 for aspect 8, no taper, no sweep."""
    assert Derivation(plain_wing(8.0)).by("roll").roll == pytest.approx(-0.50, abs=0.04)


def test_dihedral_rolls_it_away_from_the_wind():
    """Strip theory: CL_alpha / 4 for each radian of dihedral, somewhat less at the tips."""
    flat = Derivation(plain_wing(8.0)).by("beta_rad").roll
    bent = Derivation(plain_wing(8.0, dihedral_deg=5.0)).by("beta_rad").roll
    strip = -4.8 / 4 * math.radians(5.0)
    assert 0.7 * strip > bent - flat > 1.1 * strip


def test_a_plain_flap_lifts_as_thin_aerofoil_theory_says():
    """A quarter of the chord, over the whole span: 0.61 of an equal incidence."""
    flap = Flap(chord_share=0.25, from_share=0.0, to_share=1.0, effectiveness=1.0)
    geometry = dataclasses.replace(plain_wing(8.0, flap=flap), elevons=True)
    found = Derivation(geometry)
    assert found.by("elevator").lift == pytest.approx(0.61 * found.by("alpha_rad").lift, rel=0.02)


SIGNS = [
    ("alpha_rad", "lift", 1), ("alpha_rad", "pitch", -1), ("beta_rad", "side", -1),
    ("beta_rad", "roll", -1), ("beta_rad", "yaw", 1), ("roll", "roll", -1), ("pitch", "pitch", -1),
    ("yaw", "yaw", -1), ("yaw", "roll", 1), ("ailerons", "roll", 1), ("elevator", "lift", 1),
    ("elevator", "pitch", -1),
]  # fmt: skip


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize(("what", "load", "sign"), SIGNS)
def test_every_derivative_has_its_sign(name, what, load, sign):
    assert sign * getattr(derived(name).by(what, 2.0), load) > 0.003


def test_the_gliders_derivatives_are_those_of_its_class():
    """Ranges of model gliders, e.g. of Beard and McLain's and of the UAV literature."""
    found = derived("glider")
    assert references(found.geometry.wing)[0] == pytest.approx(0.41, abs=0.005)
    assert 4.3 < found.by("alpha_rad").lift < 5.3
    assert -0.60 < found.by("roll").roll < -0.40
    assert -14.0 < found.by("pitch").pitch < -6.0
    assert 0.03 < found.by("beta_rad").yaw < 0.09
    assert -0.12 < found.by("beta_rad").roll < -0.03
    assert 0.022 < found.parasite_drag < 0.032
    margin = -(found.pitch(2.0) - found.pitch(0.0)) / (found.lift(2.0) - found.lift(0.0))
    assert 0.08 < margin < 0.18


def test_ailerons_pull_the_nose_the_other_way_the_more_the_wing_lifts():
    found = derived("glider")

    def about_the_flight_path(alpha_deg):
        roll, yaw = found.lateral("ailerons", alpha_deg)
        alpha = math.radians(alpha_deg)
        return yaw * math.cos(alpha) - roll * math.sin(alpha)

    assert about_the_flight_path(6.0) < about_the_flight_path(0.0) < 0.0


@pytest.mark.parametrize("name", NAMES)
def test_all_coefficients_are_finite_bounded_and_close_round_the_circle(name):
    found = derived(name)
    for alpha in ALPHAS_DEG:
        lift, drag, pitch = found.lift(alpha), found.drag(alpha), found.pitch(alpha)
        assert abs(lift) < 1.5 and 0.0 < drag < 2.0 and abs(pitch) < 2.5
        for what in ("beta_rad", "roll", "yaw", "ailerons"):
            assert all(abs(each) < 2.0 for each in found.lateral(what, alpha))
    for beta in BETAS_DEG:
        assert abs(found.side(beta)) < 1.5 and abs(found.yaw(beta)) < 0.3
    for each in (found.lift, found.drag, found.pitch):
        assert each(-180.0) == pytest.approx(each(180.0), abs=1e-6)


@pytest.mark.parametrize("name", NAMES)
def test_past_the_stall_it_lifts_less_drags_more_and_drops_its_nose(name):
    found = derived(name)
    stall = found.geometry.stall.positive_deg
    greatest = max(found.lift(at / 4) for at in range(0, 100))
    assert found.lift(stall + 6) < greatest - 0.05
    assert found.drag(stall + 6) > 2 * found.drag(stall - 5)
    assert found.pitch(stall + 6) < found.pitch(stall - 5) - 0.1
    for alpha in (20.0, 45.0, 90.0, 150.0):
        assert found.pitch(alpha) < 0.0 < found.pitch(-alpha)


def test_a_stalled_wing_no_longer_damps_its_rolling():
    found = derived("glider")
    assert found.lateral("roll", 3.0)[0] < -0.4
    assert found.lateral("roll", 12.5)[0] > -0.1


@pytest.mark.parametrize("name", NAMES)
def test_a_sideslip_of_any_size_turns_the_nose_into_the_wind(name):
    found = derived(name)
    values = [found.yaw(beta) for beta in BETAS_DEG]
    for beta, value in zip(BETAS_DEG, values, strict=True):
        assert not beta or math.copysign(1.0, value) == math.copysign(1.0, beta)
