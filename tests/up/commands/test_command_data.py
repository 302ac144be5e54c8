"""Whatever JSON comes as a Command's data: a valid Command, or one clear refusal."""

import dataclasses
import json
import math

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.up.commands.test_roles_table import COGS, SAMPLES
from up.commands.builtin import BUILTIN_COMMANDS
from up.commands.command import BaseCommand, InvalidCommandError, value, wire_fields
from up.protocols.general_message import encode

ALL = (*BUILTIN_COMMANDS, *COGS)
SCALARS = (
    st.none()
    | st.booleans()
    | st.integers()
    | st.integers(-5000, 5000)
    | st.floats(allow_nan=True)
    | st.text(max_size=20)
    | st.sampled_from(["actual", "required", "FBW", "ACRO", "AUTO", "x" * 1000, 10**400])
)
JSON = st.recursive(
    SCALARS,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=8), inner),
    max_leaves=8,
)
LOOPS = st.fixed_dictionaries(
    {},
    optional={
        axis: st.fixed_dictionaries({}, optional=dict.fromkeys("pid", SCALARS)) | JSON
        for axis in ("ailerons", "elevator", "rudder", "flaps")
    },
)
PIDS = st.fixed_dictionaries(
    {}, optional=dict.fromkeys(("ratePIDs", "stabPIDs", "navPIDs", "more"), LOOPS | JSON)
)


@pytest.mark.parametrize("cls", ALL, ids=lambda cls: cls.NAME)
@settings(deadline=None, suppress_health_check=list(HealthCheck))
@given(draw=st.data())
def test_arbitrary_json_makes_a_command_or_an_invalid_command_error(cls, draw):
    keys = [key for _, key, _ in wire_fields(cls)]
    special = {"pids": PIDS | JSON}
    data = draw.draw(
        st.fixed_dictionaries(
            {}, optional={**{key: special.get(key, JSON) for key in keys}, "unknown": JSON}
        )
    )
    try:
        command = cls.from_data(data)
    except InvalidCommandError as error:
        assert str(error)
        return
    for field in dataclasses.fields(command):
        got = getattr(command, field.name)
        assert not isinstance(got, float) or math.isfinite(got)
    hash(command.NAME)
    command.roles()


@pytest.mark.parametrize("name", sorted(SAMPLES))
def test_a_sample_survives_the_wire(name):
    cls = next(each for each in ALL if name == each.NAME)
    command = cls.from_data(SAMPLES[name])
    if name not in ("up.telemetry.update", "arduino.pids.values", "arduino.profile.values"):
        line = encode(command.NAME, command.data)
        assert cls.from_data(json.loads(line)["data"]) == command


@pytest.mark.parametrize("name", sorted(SAMPLES))
def test_a_missing_or_wrong_field_is_named(name):
    cls = next(each for each in ALL if name == each.NAME)
    for _, key, _ in wire_fields(cls):
        wrong = {**SAMPLES[name], key: object}
        with pytest.raises(InvalidCommandError, match=key):
            cls.from_data(wrong)


def test_text_is_no_number_and_true_is_none_either():
    cls = next(each for each in ALL if each.NAME == "up.telemetry.frequency")
    for bad in ("100", True, None, -1, 0, 19.99, 10000.1, float("nan"), [], {}):
        with pytest.raises(InvalidCommandError, match="frequency"):
            cls.from_data({"frequency": bad})
    assert cls.from_data({"frequency": 20}).period_ms == 20.0


def test_a_check_of_the_whole_command_is_invalid_too():
    @dataclasses.dataclass(frozen=True, slots=True)
    class Pair(BaseCommand):
        NAME = "test.pair"
        low: int = value(minimum=0)
        high: int = value(minimum=0)

        def __post_init__(self):
            if self.low > self.high:
                raise ValueError("low is above high")

    with pytest.raises(InvalidCommandError):
        Pair.from_data({"low": 2, "high": 1})


@pytest.mark.parametrize("mode", ["A" * 33, None, 1])
def test_a_flight_mode_is_a_short_name(mode):
    cls = next(each for each in ALL if each.NAME == "up.flight_mode.set")
    with pytest.raises(InvalidCommandError):
        cls.from_data({"mode": mode})
