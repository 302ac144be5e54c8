"""docs/simulator-airframe.md: its aircraft is derived, loaded and flown by the page's steps."""

import re
import sys

import pytest

from tests.docs.flying import files_of, lines_of
from tests.support.firmware import build_firmware
from tests.support.virtual_environment import REPOSITORY
from up_simulator.aircraft import AirframeError, airframe_names, load_airframe
from up_simulator.aircraft.airframe import SHIPPED
from up_simulator.aircraft.derivation import Derivation
from up_simulator.aircraft.geometry import GEOMETRY
from up_simulator.aircraft.model_file import main as write_model
from up_simulator.cli import main as up_sim

PAGE = "simulator-airframe.md"
TEXT = (REPOSITORY / "docs" / PAGE).read_text(encoding="utf-8")


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The folder of a user after following the page."""
    for name, text in files_of(PAGE).items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "argv", ["up-sim"])
    (line,) = lines_of(PAGE, "model")
    assert line.startswith("python -m up_simulator.aircraft.model_file ")
    assert write_model(line.split()[3:]) == 0
    return tmp_path


def test_the_program_prints_the_output_of_the_page(folder, capsys):
    write_model(["trainer"])
    assert capsys.readouterr().out in TEXT


def test_the_aircraft_of_the_page_flies(folder, capsys):
    build_firmware()
    for line in lines_of(PAGE, "up-sim"):
        assert up_sim(line.split()[1:]) == 0, capsys.readouterr().out


def test_the_mistake_of_the_page_is_reported(folder):
    path = folder / "trainer" / "airframe.yml"
    path.write_text(path.read_text().replace("fcs/left-aileron-pos-rad", "fcs/left-aileron"))
    with pytest.raises(AirframeError) as caught:
        load_airframe("trainer")
    assert str(caught.value) in TEXT


def test_the_derivatives_of_the_page_are_the_gliders():
    found = Derivation(GEOMETRY.load(SHIPPED / "glider"))
    table = TEXT.partition("| glider, per radian |")[2].partition("Parasite drag")[0]
    rows = {row.split("|")[1].strip(): row for row in table.splitlines() if row.count("|") == 7}
    for label, what in (
        ("angle of attack", "alpha_rad"), ("sideslip", "beta_rad"), ("roll rate (pb/2V)", "roll"),
        ("pitch rate (qc/2V)", "pitch"), ("yaw rate (rb/2V)", "yaw"), ("ailerons", "ailerons"),
        ("elevator", "elevator"), ("rudder", "rudder"),
    ):  # fmt: skip
        cells = rows[label].replace("\N{MINUS SIGN}", "-").split("|")[2:7]
        loads = found.by(what)
        for cell, name in zip(cells, ("lift", "pitch", "side", "roll", "yaw"), strict=True):
            number = re.match(r"\s*(-?[\d.]+)", cell)
            if number:
                digits = len(number[1].partition(".")[2])
                assert float(number[1]) == round(getattr(loads, name), digits), (label, name)


def test_every_shipped_airframe_is_on_the_page():
    assert all(f"`{name}`" in TEXT for name in airframe_names())
