"""Airframe files: the shipped ones, those of users, and their problems."""

import re
import shutil
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st

from up.flight_controller.pids_file import PIDS
from up.flight_controller.profile_wire import AIRFRAME
from up.flight_modes.navigation_file import NAVIGATION
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


def rejection(folder, code, **changes):
    with pytest.raises(AirframeError) as caught:
        load_airframe(own(folder, **changes))
    assert caught.value.code == code
    return str(caught.value).splitlines()


def test_two_airframes_ship_and_the_glider_is_the_default():
    assert airframe_names() == ("glider", "wing")
    assert DEFAULT_AIRFRAME == "glider"


def test_the_glider_has_the_figures_of_its_class():
    airframe = load_airframe("glider")
    assert airframe.title == "motor glider, 1.8 m"
    assert airframe.has_motor
    assert airframe.profile == {"mix": "none", "motor": True}
    assert set(airframe.gains) == {"units", "rate", "stabilize"}


def test_the_firmware_mixes_the_elevons_of_the_wing():
    airframe = load_airframe("wing")
    assert airframe.profile["mix"] == "elevon"
    assert not airframe.servos.rudder.moves


@pytest.mark.parametrize("name", airframe_names())
def test_its_settings_are_valid_configuration_of_the_daemon(name, tmp_path):
    """The simulator may not import the cog, so the test compares: both read the same profile."""
    import yaml

    airframe = load_airframe(name)
    read = AIRFRAME.parse(yaml.safe_dump(airframe.profile), tmp_path / "airframe.yml")
    assert read.mix == airframe.profile["mix"]
    assert read.motor == airframe.profile["motor"]
    gains = PIDS.parse(yaml.safe_dump(airframe.gains), tmp_path / "pids.yml", whole=False)
    assert gains.rate.ailerons.p == airframe.gains["rate"]["ailerons"]["p"]
    navigation = NAVIGATION.parse(yaml.safe_dump(airframe.navigation), tmp_path / "navigation.yml")
    assert navigation.airspeed.cruise_m_s == airframe.launch.airspeed_m_s
    assert navigation.performance.level_throttle == airframe.launch.level_throttle


def test_an_airframe_without_a_model_flies_by_its_geometry(tmp_path):
    place = own(tmp_path, lambda text: text.replace("model: glider.xml", ""))
    (place / "glider.xml").unlink()
    before = FlightDynamics(load_airframe(place))
    geometry = place / "geometry.yml"
    geometry.write_text(geometry.read_text().replace("mass_kg: 0.95", "mass_kg: 1.9"))
    heavy = FlightDynamics(load_airframe(place))
    for each in (before, heavy):
        each.advance(1.0)
    assert heavy.state.altitude_m < before.state.altitude_m - 0.3


def test_an_airframe_needs_a_model_or_a_valid_geometry(tmp_path):
    place = own(tmp_path, lambda text: text.replace("model: glider.xml", ""))
    (place / "geometry.yml").unlink()
    with pytest.raises(AirframeError, match=r"airframe\.yml:1:1: model: ") as caught:
        load_airframe(place)
    assert caught.value.code == "missing_key"
    (place / "geometry.yml").write_text("wing: {half_span_m: 0.6}\ntail: {half_span_m: 0.6}\n")
    with pytest.raises(AirframeError) as caught:
        load_airframe(place)
    assert caught.value.code == "invalid_geometry" and "\n" not in str(caught.value)


def test_without_numpy_no_flight_is_possible(monkeypatch):
    monkeypatch.setitem(sys.modules, "numpy", None)
    for name in ("model_file", "derivation", "lattice", "panels"):
        monkeypatch.delitem(sys.modules, f"up_simulator.aircraft.{name}", raising=False)
    with pytest.raises(FlightUnavailableError, match="numpy"):
        FlightDynamics(load_airframe("glider"))


def test_a_model_that_cannot_be_written_names_its_path(tmp_path, monkeypatch):
    (tmp_path / "file").touch()
    monkeypatch.setattr(model_file, "cache_path", lambda *_: tmp_path / "file" / "x.xml")
    with pytest.raises(FlightUnavailableError, match=r"x\.xml: "):
        FlightDynamics(load_airframe("glider"))


@pytest.mark.parametrize("as_file", [False, True])
def test_an_airframe_of_the_user_flies(tmp_path, as_file):
    place = own(tmp_path, lambda text: text.replace("title: motor glider, 1.8 m", "title: mine"))
    airframe = load_airframe(place / "airframe.yml" if as_file else str(place))
    assert (airframe.name, airframe.title) == ("mine", "mine")
    flight = FlightDynamics(airframe)
    flight.advance(1.0)
    assert flight.state.north_m > 9.0


@pytest.mark.parametrize("name", ["glidr", "/nowhere", ""])
def test_an_unknown_airframe_is_rejected(name):
    with pytest.raises(AirframeError) as caught:
        load_airframe(name)
    assert caught.value.code == "unknown_airframe" and str(caught.value).startswith(f"{name}: ")
    assert ("'glider'?" in str(caught.value)) is (name == "glidr")


def test_all_problems_of_a_file_are_reported_with_line_and_key(tmp_path):
    lines = rejection(
        tmp_path,
        "invalid_file",
        yml=lambda text: (
            text.replace("slew_us_s", "slew_us")
            .replace("cells: 3", "cells: three")
            .replace("break_g: 10", "break_g: 5")
        ),
    )
    keys = ("servos: ", "battery.cells: ", "limits.break_g: ")
    for line, key in zip(lines, keys, strict=True):
        assert re.match(rf".*/mine/airframe\.yml:\d+:\d+: {re.escape(key)}", line)


@pytest.mark.parametrize(
    ("change", "code", "place"),
    [
        (lambda text: "", "missing_key", r"airframe\.yml:1:1: title: "),
        (
            lambda text: text.replace("glider.xml", "other.xml"),
            "not_readable",
            r"other\.xml: ",
        ),
        (lambda text: text.replace("glider.xml", "../x.xml"), "invalid_file", r":\d+: model: "),
        (lambda text: text.replace("mix: none", "mix: elevons"), "invalid_file", "profile.mix: "),
        (
            lambda text: text.replace("airspeed_m_s: 11.0", "airspeed_m_s: .nan"),
            "invalid_file",
            "launch.airspeed_m_s: ",
        ),
        (lambda text: text.replace("rate:", "rates:"), "invalid_file", "did you mean 'rate'"),
        (
            lambda text: text.replace("fcs/elevator-pos-rad", "fcs/elevator-pos-rat"),
            "unknown_property",
            r":\d+: servos\.elevator\.moves: .*'fcs/elevator-pos-rad'",
        ),
    ],
)
def test_a_problem_of_the_file_has_its_place(tmp_path, change, code, place):
    (line,) = rejection(tmp_path, code, yml=change)
    assert re.search(place, line)


@pytest.mark.parametrize(
    ("change", "code"),
    [
        (lambda text: text[: text.index("<metrics>")], "not_a_model"),
        (lambda text: "<glider/>", "not_a_model"),
        (lambda text: text.replace("0.95<", "heavy<"), "invalid_mass"),
        (lambda text: text.replace('"KG*M2"', '"STONES"'), "model_refused"),
        (lambda text: text.replace('"LIFT"', '"UP"'), "model_refused"),
        (lambda text: text.replace("     -170", "  xx -170", 1), "model_refused"),
        # JSBSim continues without this, and ends the process at that.
        (lambda text: text.replace("sin>", "sinus>"), "model_refused"),
        (lambda text: text.replace("p-aero-rad_sec", "p-air"), "model_refused"),
        (lambda text: text.replace("external_reactions>", "nothing>"), "unknown_property"),
    ],
)
def test_a_model_that_jsbsim_does_not_fly_is_rejected(tmp_path, change, code):
    assert len(rejection(tmp_path, code, xml=change)) == 1


@given(st.text(max_size=300))
def test_any_text_is_an_airframe_or_problems(text):
    from pathlib import Path

    from up.config import ConfigErrors

    try:
        file_named("airframe.yml").parse(text, Path("airframe.yml"))
    except ConfigErrors as errors:
        assert errors.problems
