"""Airframe files: the shipped ones, those of users, and the messages for mistakes."""

import re
import shutil
import sys

import pytest
from arduino_cog.airframe import AIRFRAME
from hypothesis import given
from hypothesis import strategies as st

from up.flight_controller.pids_file import PIDS
from up_simulator.aircraft import (
    DEFAULT_AIRFRAME,
    AirframeError,
    FlightDynamics,
    airframe_names,
    load_airframe,
    model_file,
)
from up_simulator.aircraft.airframe import SHIPPED
from up_simulator.aircraft.airframe_file import file_named
from up_simulator.aircraft.flight import FlightUnavailableError


def own(folder, yml=lambda text: text, xml=lambda text: text):
    """A user's aircraft: the glider with another text."""
    place = folder / "mine"
    shutil.copytree(SHIPPED / "glider", place)
    shutil.copy(load_airframe("glider").model_path, place / "glider.xml")
    with (place / "airframe.yml").open("a") as file:
        file.write("model: glider.xml\n")
    for name, change in (("airframe.yml", yml), ("glider.xml", xml)):
        text = (place / name).read_text()
        changed = change(text)
        (place / name).write_text(changed)
    return place


def refusal(folder, **changes):
    with pytest.raises(AirframeError) as caught:
        load_airframe(own(folder, **changes))
    assert "Traceback" not in str(caught.value)
    return str(caught.value)


def test_two_ship_and_the_glider_is_the_default():
    assert airframe_names() == ("glider", "wing")
    assert DEFAULT_AIRFRAME == "glider"


def test_the_glider_is_of_its_class():
    airframe = load_airframe("glider")
    assert airframe.mass_kg == pytest.approx(0.95)
    assert airframe.title == "motor glider, 1.8 m"
    assert airframe.has_motor
    assert airframe.profile == {"mix": "none", "motor": True}
    assert set(airframe.gains) == {"units", "rate", "stabilize"}
    assert airframe.gains["stabilize"]["rudder"] == {"p": 0.0, "i": 0.0, "d": 0.0}


def test_the_wing_lets_the_firmware_mix():
    airframe = load_airframe("wing")
    assert airframe.profile["mix"] == "elevon"
    assert not airframe.servos.rudder.moves


@pytest.mark.parametrize("name", airframe_names())
def test_profile_and_gains_are_what_the_raspberry_pis_files_take(name, tmp_path):
    """The simulator may not import the cog, so the test compares: both read the same profile."""
    import yaml

    airframe = load_airframe(name)
    read = AIRFRAME.parse(yaml.safe_dump(airframe.profile), tmp_path / "airframe.yml")
    assert read.mix == airframe.profile["mix"]
    assert read.motor == airframe.profile["motor"]
    gains = PIDS.parse(yaml.safe_dump(airframe.gains), tmp_path / "pids.yml", whole=False)
    assert gains.rate.ailerons.p == airframe.gains["rate"]["ailerons"]["p"]


def test_a_users_own_without_a_model_flies_as_its_geometry_says(tmp_path):
    place = own(tmp_path, lambda text: text.replace("model: glider.xml", ""))
    (place / "glider.xml").unlink()
    before = FlightDynamics(load_airframe(place))
    geometry = place / "geometry.yml"
    geometry.write_text(geometry.read_text().replace("mass_kg: 0.95", "mass_kg: 1.9"))
    airframe = load_airframe(place)
    assert airframe.mass_kg == pytest.approx(1.9)
    heavy = FlightDynamics(airframe)
    for each in (before, heavy):
        each.advance(1.0)
    assert heavy.state.altitude_m < before.state.altitude_m - 0.3


def test_neither_a_model_nor_a_geometry_is_one_sentence(tmp_path):
    place = own(tmp_path, lambda text: text.replace("model: glider.xml", ""))
    (place / "geometry.yml").unlink()
    with pytest.raises(AirframeError, match=r'airframe.yml:1:1: the key "model" is missing, and'):
        load_airframe(place)
    (place / "geometry.yml").write_text("wing: {half_span_m: 0.6}\ntail: {half_span_m: 0.6}\n")
    with pytest.raises(AirframeError, match="lie in each other's vortices") as caught:
        load_airframe(place)
    assert len(str(caught.value).splitlines()) == 1


def test_without_numpy_the_mass_is_known_and_nothing_flies(monkeypatch):
    monkeypatch.setitem(sys.modules, "numpy", None)
    for name in ("model_file", "derivation", "lattice", "panels"):
        monkeypatch.delitem(sys.modules, f"up_simulator.aircraft.{name}", raising=False)
    assert load_airframe("glider").mass_kg == pytest.approx(0.95)
    with pytest.raises(FlightUnavailableError, match="numpy"):
        FlightDynamics(load_airframe("glider"))


def test_a_place_that_cannot_be_written_is_named(tmp_path, monkeypatch):
    (tmp_path / "file").touch()
    monkeypatch.setattr(model_file, "cache_path", lambda *_: tmp_path / "file" / "x.xml")
    with pytest.raises(FlightUnavailableError, match=r"x\.xml: "):
        FlightDynamics(load_airframe("glider"))


@pytest.mark.parametrize("as_file", [False, True])
def test_a_users_own_flies(tmp_path, as_file):
    place = own(tmp_path, lambda text: text.replace("title: motor glider, 1.8 m", "title: mine"))
    airframe = load_airframe(place / "airframe.yml" if as_file else str(place))
    assert (airframe.name, airframe.title) == ("mine", "mine")
    flight = FlightDynamics(airframe)
    flight.advance(1.0)
    assert flight.state.north_m > 9.0


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("glidr", "glidr: is no airframe (glider, wing) and no folder with an airframe.yml, did"
         " you mean 'glider'?"),
        ("/nowhere", "/nowhere: is no airframe (glider, wing) and no folder with an airframe.yml"),
        ("", ": is no airframe (glider, wing) and no folder with an airframe.yml"),
    ],
)  # fmt: skip
def test_a_name_that_is_none(name, sentence):
    with pytest.raises(AirframeError) as caught:
        load_airframe(name)
    assert str(caught.value) == sentence


def test_all_mistakes_are_told_at_once_each_with_its_place(tmp_path):
    said = refusal(
        tmp_path,
        yml=lambda text: (
            text.replace("slew_us_s", "slew_us")
            .replace("cells: 3", "cells: three")
            .replace("break_g: 10", "break_g: 5")
        ),
    ).splitlines()
    assert len(said) == 3
    assert re.fullmatch(
        r".*/mine/airframe.yml:\d+:3: servos: unknown key \"slew_us\", did you mean 'slew_us_s'\?",
        said[0],
    )
    assert 'battery.cells: must be a whole number between 1 and 14, not "three"' in said[1]
    assert "limits.break_g: must not be below load_g, which is 6" in said[2]


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (lambda text: "", 'airframe.yml:1:1: the key "title" is missing'),
        (
            lambda text: text.replace("glider.xml", "other.xml"),
            "other.xml: cannot be read: No such",
        ),
        (lambda text: text.replace("glider.xml", "../x.xml"), "must be the name of an .xml file"),
        (lambda text: text.replace("mix: none", "mix: elevons"), 'not "elevons"'),
        (lambda text: text.replace("airspeed_m_s: 11.0", "airspeed_m_s: .nan"), "finite"),
        (lambda text: text.replace("rate:", "rates:"), "did you mean 'rate'?"),
        (
            lambda text: text.replace("fcs/elevator-pos-rad", "fcs/elevator-pos-rat"),
            'servos.elevator.moves: the model has no property "fcs/elevator-pos-rat", did you mean'
            " 'fcs/elevator-pos-rad'?",
        ),
    ],
)
def test_a_mistake_in_the_file_is_one_sentence(tmp_path, change, sentence):
    said = refusal(tmp_path, yml=change)
    assert sentence in said
    assert len(said.splitlines()) == 1


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (lambda text: text[: text.index("<metrics>")], "is no XML: no element found"),
        (lambda text: "<glider/>", "is no JSBSim model"),
        (lambda text: text.replace("0.95<", "heavy<"), "emptywt is no mass: heavy"),
        (lambda text: text.replace('"KG*M2"', '"STONES"'), 'Supplied unit: "STONES"'),
        (lambda text: text.replace('"LIFT"', '"UP"'), "An unknown axis type, UP"),
        (lambda text: text.replace("     -170", "  xx -170", 1), "Illegal character"),
        # JSBSim continues without this, and ends the process at that.
        (lambda text: text.replace("sin>", "sinus>"), "Bad operation <sinus>"),
        (lambda text: text.replace("p-aero-rad_sec", "p-air"), "velocities/p-air does not exist"),
        (
            lambda text: text.replace("external_reactions>", "nothing>"),
            "motor: the model has no force 'motor' in its external_reactions",
        ),
    ],
)
def test_a_model_that_jsbsim_does_not_fly_is_told_with_its_reason(tmp_path, change, sentence):
    said = refusal(tmp_path, xml=change)
    assert sentence in said
    assert len(said.splitlines()) == 1


@given(st.text(max_size=300))
def test_no_text_breaks_the_reading(text):
    from pathlib import Path

    from up.config import ConfigErrors

    try:
        file_named("airframe.yml").parse(text, Path("airframe.yml"))
    except ConfigErrors as errors:
        assert errors.problems
