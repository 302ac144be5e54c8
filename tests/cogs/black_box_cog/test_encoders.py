import json
import math
from dataclasses import dataclass
from typing import Any, ClassVar

import pytest
from black_box_cog.encoders import OriginTexts, encoder_of, json_of
from hypothesis import given
from hypothesis import strategies as st

from up.commands.command import BaseCommand, value
from up.commands.orientation_command import OrientationCommand
from up.commands.origin import INTERNAL, Origin
from up.commands.roles import Role
from up.commands.rx_command import RXCommand
from up.commands.system_commands import SystemStateCommand
from up.commands.telemetry_commands import TelemetryCommand

BOARD = Origin("arduino", Role.BOARD, 10)
NUMBERS = st.one_of(
    st.none(), st.floats(allow_nan=True), st.integers(-(2**63), 2**63), st.booleans()
)


@dataclass(frozen=True, slots=True)
class OddCommand(BaseCommand):
    """Keys that a template must not take for places, and a value of any kind."""

    NAME: ClassVar[str] = "test.odd"
    load_percent: float = value(key='100 % "full" %s')
    rest: dict[str, Any] | None = None


@dataclass(frozen=True, slots=True)
class EmptyCommand(BaseCommand):
    """Nothing."""

    NAME: ClassVar[str] = "test.empty"


def logged(command, origin=BOARD):
    return json.loads(OriginTexts().ended(encoder_of(type(command))(command), origin))


def same(written, meant):
    if isinstance(meant, float) and not math.isfinite(meant):
        return written is None
    if isinstance(meant, float):
        return math.isclose(written, meant, rel_tol=1e-11, abs_tol=0.0)
    return written == meant and type(written) is type(meant)


@given(st.lists(NUMBERS, min_size=7, max_size=7))
def test_whatever_numbers_a_command_has_they_are_written(values):
    written = logged(OrientationCommand(*values))
    keys = ["roll", "pitch", "yaw", "roll_rate", "pitch_rate", "yaw_rate", "sequence"]
    assert list(written) == [*keys, "_origin"]
    for key, meant in zip(keys, values, strict=True):
        assert same(written[key], meant) or written[key] == meant


def test_numbers_keep_twelve_digits():
    place = 47.123456789012345
    written = logged(OrientationCommand(place, -1e-7, 222.0))
    assert written["roll"] == pytest.approx(place, rel=1e-12)
    assert written["pitch"] == -1e-7
    assert logged(RXCommand(1500, 1501, 1000, 1499, 2000, 1000, 63))["elevator"] == 1501


@pytest.mark.parametrize("odd", [float("nan"), float("inf"), float("-inf")])
def test_values_that_are_not_numbers_are_null(odd):
    assert logged(OrientationCommand(1.0, odd, 2.0))["pitch"] is None
    frame = TelemetryCommand({"a": [odd, {"b": odd}], "c": (1, 2)}, 7)
    assert logged(frame) == {
        "a": [None, {"b": None}],
        "c": [1, 2],
        "_beacon": 7,
        "_origin": "arduino (board)",
    }


@given(st.one_of(NUMBERS, st.text(), st.lists(st.text()), st.dictionaries(st.text(), st.text())))
def test_any_other_value_and_any_key(rest):
    written = logged(OddCommand(99.5, rest))
    assert written['100 % "full" %s'] == 99.5
    if not isinstance(rest, float):
        assert written["rest"] == rest


def test_lists_truths_and_texts():
    state = SystemStateCommand(1.5, 2.0, ("rx", 'a "quoted"'), True, "flight controller")
    assert logged(state, INTERNAL) == {**state.data, "_origin": "internal"}


def test_a_command_without_fields_has_its_origin():
    assert logged(EmptyCommand()) == {"_origin": "arduino (board)"}


def test_what_a_command_makes_itself_is_taken_as_it_is():
    class Own(OddCommand):
        @property
        def data(self):
            return {"own": 1}

    assert logged(Own(1.0)) == {"own": 1, "_origin": "arduino (board)"}


def test_a_value_that_json_lacks_is_written_as_text():
    assert json.loads(json_of({"role": Role.PILOT})) == {"role": "Role.PILOT"}


def test_origins_come_and_go_by_the_thousand():
    texts = OriginTexts()
    for number in range(5000):
        text = texts.ended("{}", Origin(f"link{number}", Role.PILOT))
        assert json.loads(text) == {"_origin": f"link{number} (pilot)"}
    assert len(texts._texts) <= 256
