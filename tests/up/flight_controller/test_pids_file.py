"""pids.yml: never a flight with rubbish, never a lost set."""

from dataclasses import replace

import pytest
import yaml

from up.commands.gains import Gains, GainSet, LoopGains
from up.flight_controller.pids_file import PIDS, PidsConfig, PidsFile, gain_set_of

DEFAULT = gain_set_of(PidsConfig())
LOOP = LoopGains(Gains(3.0, 0.25, 0.003), Gains(1.0), Gains(0.5))
OURS = GainSet(LOOP, replace(LOOP, rudder=Gains(0.0)))
PROTOTYPE = """\
rate:
  ailerons: {p: 6.0, i: 0.0, d: 0.0}
  elevator: {p: 6.0, i: 0.0, d: 0.0}
stabilize:
  ailerons: {p: 0.7, i: 0.0, d: 0.0}
  elevator: {p: 0.7, i: 0.0, d: 0.0}
"""


@pytest.fixture
def pids(tmp_path):
    return PidsFile(tmp_path)


def test_without_a_file_the_defaults_fly_and_nothing_is_wrong(pids):
    assert pids.load() == (DEFAULT, None)


def test_what_was_saved_comes_back_exactly(pids, tmp_path):
    pids.save(OURS)
    assert PidsFile(tmp_path).load() == (OURS, None)


def test_a_set_without_a_rudder_keeps_the_saved_one(pids):
    pids.save(OURS)
    two = LoopGains(Gains(4.0), Gains(5.0))
    pids.save(GainSet(two, two))
    gains, problem = pids.load()
    assert problem is None
    assert gains.rate == LoopGains(Gains(4.0), Gains(5.0), LOOP.rudder)
    assert gains.stabilize == LoopGains(Gains(4.0), Gains(5.0), Gains(0.0))


def test_an_old_file_with_gains_that_nothing_uses_is_valid(pids, tmp_path):
    pids.save(OURS)
    file = tmp_path / "pids.yml"
    values = yaml.safe_load(file.read_text())
    values["stabilize"]["rudder"] = {"p": 1.0, "i": 0.0, "d": 0.0}
    values["navigation"] = {"ailerons": {"p": 0.5, "i": 0.0, "d": 0.0}}
    file.write_text(yaml.safe_dump(values))
    assert PidsFile(tmp_path).load() == (OURS, None)
    ignored = {(each.code, each.key) for each in PIDS.ignored_keys(tmp_path)}
    assert ignored == {("key_removed", "stabilize.rudder"), ("key_removed", "navigation")}
    PidsFile(tmp_path).save(OURS)
    assert PIDS.ignored_keys(tmp_path) == []


@pytest.mark.parametrize(
    "text",
    [
        PROTOTYPE,
        "rate: null\nstabilize: null\n",
        "",
        "units: counts\n" + PROTOTYPE,
        "rate: {ailerons: {p: .nan, i: 0, d: 0}}\n",
        "\x00\x01",
        "[",
    ],
)
def test_a_file_that_is_not_whole_or_not_ours_flies_the_last_good_set_and_says_so(
    pids, tmp_path, text
):
    pids.save(OURS)
    (tmp_path / "pids.yml").write_text(text)
    gains, problem = PidsFile(tmp_path).load()
    assert gains == OURS
    assert problem.fields["used"] == "good_copy"
    assert "\n" not in str(problem)


def test_the_prototypes_swapped_gains_never_fly(pids, tmp_path):
    (tmp_path / "pids.yml").write_text(PROTOTYPE)
    gains, problem = pids.load()
    assert gains == DEFAULT
    assert gains.rate.ailerons.p < 3
    assert problem.fields["used"] == "defaults"


@pytest.mark.parametrize("left_out", ["rate", "stabilize"])
def test_a_file_without_a_whole_loop_is_not_flown(tmp_path, left_out):
    file = PidsFile(tmp_path)
    file.save(file.load()[0])
    (tmp_path / "pids.yml.good").unlink()
    text = (tmp_path / "pids.yml").read_text(encoding="utf-8")
    kept = "stabilize" if left_out == "rate" else "rate"
    body = yaml.safe_load(text)
    (tmp_path / "pids.yml").write_text(
        yaml.safe_dump({"units": body["units"], kept: body[kept]}), encoding="utf-8"
    )
    _, problem = file.load()
    assert (problem.code, problem.fields["key"]) == ("key_missing", left_out)
