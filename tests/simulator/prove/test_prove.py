"""``up-sim prove`` as a user calls it: real flights, a refused configuration, wrong arguments."""

import json

import pytest

from tests.support.program_output import fields_of
from up_simulator.cli import main
from up_simulator.prove.cases import Case, left_out, limits_of, quick, scenario_of, thorough
from up_simulator.prove.rows import CODES
from up_simulator.prove.setup import read_setup
from up_simulator.scenario.flight import ScenarioFlight

FLOOR = "fence: {floor_m: 30, action: %s}\n"


@pytest.fixture
def config(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    folder = tmp_path / "config"
    folder.mkdir()
    (folder / "config.yml").write_text("flight controller: raspberry\nlog file: here.log\n")
    return folder


def prove(capsys, *words):
    status = main(["prove", "--only", "fence_floor", "--wind", "0", "--json", *words])
    return status, json.loads(capsys.readouterr().out)


@pytest.mark.parametrize(("action", "status"), [("RETURN", 0), ("warn", 1)])
def test_a_flight_towards_the_floor(config, capsys, action, status):
    (config / "failsafe.yml").write_text(FLOOR % action)
    found, document = prove(capsys)
    (flight,) = document["flights"]
    assert (found, document["held"], flight["controller"]) == (status, not status, "raspberry")
    assert flight["codes"] == (["below_floor"] if status else [])
    # Between the deck of the fence and the ground, and seen before the border.
    assert (flight["lowest_m"] < 30) == bool(status)
    assert flight["reaction_s"] is not None and flight["flown_s"] == pytest.approx(40, abs=6)
    if status:
        keys = [each["key"] for each in flight["advice"]["settings"]]
        assert keys == ["fence.action", "fence.floor_m"]
    assert (config.parent / "run" / "proof.html").read_text().count("<svg") == status
    assert not (config.parent / "here.log").exists()


def test_a_configuration_that_is_refused_is_not_flown(config, capsys):
    (config / "failsafe.yml").write_text(FLOOR % "RETURN")
    (config / "return.yml").write_text("height_m: 25\n")
    status, document = prove(capsys)
    assert (status, document["held"], document["flights"]) == (1, False, [])
    assert any("floor_m" in each and "return.yml" in each for each in document["refusals"])


@pytest.mark.parametrize(
    ("words", "code"),
    [
        (["--only", "gps_lots"], "no_such_failure"),
        (["--config", "nowhere"], "no_configuration"),
        (["--only", "fence_floor"], "nothing_to_fly"),
        (["--airframe", "nothing"], "airframe"),
        (["--output", "config"], "cannot_write"),
    ],
)
def test_wrong_use_has_a_code_and_status_2(config, capsys, monkeypatch, words, code):
    monkeypatch.setenv("UP_LOG_FORMAT", "json")
    assert main(["prove", *words]) == 2
    assert [each["code"] for each in fields_of(capsys.readouterr().err)] == [code]


def test_a_mistake_in_a_file_is_named_with_its_place(config, capsys):
    (config / "return.yml").write_text("height_m: 25\nradius: 3\n")
    assert main(["prove"]) == 2
    assert "return.yml:2:1" in capsys.readouterr().err


def test_without_auto_nothing_is_proved(config, capsys, monkeypatch):
    monkeypatch.setenv("UP_LOG_FORMAT", "json")
    (config / "airframe.yml").write_text("switch: {high: FBW}\n")
    assert main(["prove"]) == 2
    assert [each["code"] for each in fields_of(capsys.readouterr().err)] == ["no_auto"]


def test_ctrl_c_in_a_flight_ends_it_with_what_is_known(config, capsys, monkeypatch):
    (config / "failsafe.yml").write_text(FLOOR % "RETURN")
    step, steps = ScenarioFlight.step, []

    def interrupted(self):
        steps.append(step(self))
        if len(steps) == 10:
            raise KeyboardInterrupt

    monkeypatch.setattr(ScenarioFlight, "step", interrupted)
    status, document = prove(capsys)
    assert (status, document["held"], document["planned"], document["flights"]) == (
        130,
        False,
        1,
        [],
    )
    assert len(steps) == 10


def test_every_row_flies_and_the_same_seeds_draw_the_same_flights(config):
    (config / "failsafe.yml").write_text("fence: {radius_m: 500, ceiling_m: 120, floor_m: 30}\n")
    (config / "flight_battery.yml").write_text("low_v: 11.1\ncritical_v: 10.6\n")
    setup = read_setup(config, "glider", None)
    assert left_out(setup, CODES) == {}
    cases = list(thorough(setup, CODES, ("arduino", "raspberry"), 1))
    assert len(cases) >= 500 and cases == list(thorough(setup, CODES, ("arduino", "raspberry"), 1))
    assert {each.row for each in cases} == set(CODES) == {e.row for e in quick(setup, CODES, 6, 1)}
    assert max(each.wind_m_s for each in cases if each.row != "no_progress") <= 8
    for case in quick(setup, CODES, 6.0, 1):
        scenario = scenario_of(case, setup)
        assert all(len(event.kinds) == 1 for event in scenario.events)
        assert all(event.at_s < scenario.duration_s for event in scenario.events)


def test_what_the_configuration_does_not_have_is_left_out(config):
    setup = read_setup(config, "wing", None)
    assert {"fence_radius", "fence_floor", "flight_battery_low"} <= left_out(setup, CODES).keys()


@pytest.mark.parametrize(
    ("row", "gps", "blind_s"),
    [("uplink_lost", "", 0), ("uplink_lost", "lost", 10), ("motor_stopped", "jumped", 17),
     ("gps_lost", "", 20), ("gps_jumped", "", 15)],
)  # fmt: skip
def test_outside_the_fence_counts_what_the_wind_drifts_while_the_position_is_wrong(
    config, row, gps, blind_s
):
    (config / "failsafe.yml").write_text("fence: {radius_m: 500}\n")
    case = Case(row, "far", "arduino", 4.0, 180.0, "none", 1, gps)
    assert limits_of(case, read_setup(config, "glider", None)).radius_m == 500 + 4 * blind_s
