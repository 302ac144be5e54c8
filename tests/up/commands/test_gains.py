import json
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from up.commands.command import InvalidCommandError
from up.commands.gains import (
    Gains,
    GainSet,
    LoopGains,
    gain_set_from_data,
    gain_set_to_data,
)
from up.commands.pid_tunings_commands import PIDTuningsCommand, PIDTuningsValuesCommand
from up.commands.roles import Role

LOOP = {
    "ailerons": {"p": 2.1, "i": 0.125, "d": 0.003},
    "elevator": {"p": 1, "i": 0, "d": 0},
    "rudder": {"p": 0.5, "i": 0, "d": 0},
}
WHOLE = {"ratePIDs": LOOP, "stabPIDs": LOOP, "navPIDs": LOOP}
FIELDS = st.builds(Gains, st.floats(0, 50), st.floats(0, 50), st.floats(0, 50))


def without(path):
    data = json.loads(json.dumps(WHOLE))
    inner = data
    for key in path[:-1]:
        inner = inner[key]
    del inner[path[-1]]
    return data


def changed(path, value):
    data = json.loads(json.dumps(WHOLE))
    inner = data
    for key in path[:-1]:
        inner = inner[key]
    inner[path[-1]] = value
    return data


def test_the_three_axis_and_the_two_axis_form():
    assert gain_set_from_data(WHOLE).rate.ailerons == Gains(2.1, 0.125, 0.003)
    two = {axis: LOOP[axis] for axis in ("ailerons", "elevator")}
    gains = gain_set_from_data({"ratePIDs": two, "stabPIDs": two})
    assert not gains.has_rudder
    completed = gains.completed(gain_set_from_data(WHOLE))
    assert completed.rate.rudder == Gains(0.5) and completed.stabilize.rudder == Gains(0.5)


@pytest.mark.parametrize(
    "path",
    [
        ("ratePIDs",), ("stabPIDs",), ("ratePIDs", "ailerons"), ("stabPIDs", "elevator"),
        ("ratePIDs", "elevator", "p"), ("navPIDs", "rudder", "d"), ("stabPIDs", "rudder"),
    ],
)  # fmt: skip
def test_a_partial_set_is_refused_whole(path):
    with pytest.raises(ValueError, match=path[-1] if path[-1] != "rudder" else "rudder"):
        gain_set_from_data(without(path))


@pytest.mark.parametrize("bad", [math.nan, math.inf, -0.001, 50.001, "2", None, True, [], 10**400])
@pytest.mark.parametrize("path", [("ratePIDs", "ailerons", "p"), ("navPIDs", "elevator", "i")])
def test_a_bad_gain_is_refused_and_its_place_named(path, bad):
    with pytest.raises(InvalidCommandError, match=r"\.".join(path)):
        PIDTuningsCommand.from_data({"pids": changed(path, bad)})


@pytest.mark.parametrize("path", [("more",), ("ratePIDs", "flaps"), ("ratePIDs", "rudder", "x")])
def test_what_is_not_known_is_refused(path):
    with pytest.raises(ValueError, match="not known"):
        gain_set_from_data(changed(path, {}))


@pytest.mark.parametrize("bad", [None, [], "x", 5])
@pytest.mark.parametrize("path", [("ratePIDs",), ("ratePIDs", "ailerons")])
def test_what_is_no_object_is_refused(path, bad):
    with pytest.raises(ValueError, match="object"):
        gain_set_from_data(changed(path, bad))


@given(FIELDS, FIELDS, FIELDS)
def test_nothing_is_rounded_on_the_way_there_and_back(a, b, c):
    loop = LoopGains(a, b, c)
    gains = GainSet(loop, loop)
    assert gain_set_from_data(gain_set_to_data(gains)) == gains
    assert PIDTuningsValuesCommand.of(gains).data == gain_set_to_data(gains)


def test_asking_is_for_observers_and_setting_for_pilots():
    ask = PIDTuningsCommand.from_data({"request": True})
    assert ask.roles() == {Role.OBSERVER} and ask.gains is None
    both = PIDTuningsCommand.from_data({"request": True, "pids": WHOLE})
    assert both.gains is None
    assert PIDTuningsCommand.from_data({"pids": WHOLE}).roles() == {Role.PILOT}
    for nothing in ({}, {"request": False}, {"request": None}):
        with pytest.raises(InvalidCommandError, match="request"):
            PIDTuningsCommand.from_data(nothing)
