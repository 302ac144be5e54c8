import dataclasses

import pytest

from up.commands.board_schema import DATA, RESET_CAUSES, STATUS, VETOES, BoardStatus, Flag, Veto
from up.commands.board_status import has_bit, reset_causes_of, telemetry_of, vetoes_of


def test_the_fields_are_those_of_the_message():
    names = [each.name for each in dataclasses.fields(BoardStatus)]
    assert names == [each.name for each in DATA if each.name == each.field]
    assert len(STATUS.unpack(bytes(STATUS.size))) == len(names)


@pytest.mark.parametrize("bit", range(8))
def test_each_bit_is_read_alone(bit):
    status = {"flags": 1 << bit, "vetoes": 1 << bit, "reset_cause": 1 << bit, "switch": 1}
    telemetry = telemetry_of(status)
    assert vetoes_of(status) == [VETOES[bit]]
    assert reset_causes_of(status) == RESET_CAUSES.get(bit, "unknown")
    assert telemetry["switch"] == "middle"
    assert telemetry["failsafe"] is (1 << bit == Flag.FAILSAFE)
    assert telemetry["imu_valid"] is (1 << bit == Flag.IMU_VALID)
    assert telemetry["restored"] is (bit == 7)
    assert Veto(1 << bit).name is not None


@pytest.mark.parametrize("invalid", [None, "1", -1, 256, 1.0, [1], True])
def test_an_invalid_field_is_unknown(invalid):
    data = {"flags": invalid, "vetoes": invalid, "reset_cause": invalid, "loop_us": [invalid]}
    telemetry = telemetry_of({**data, "switch": [invalid]})
    assert has_bit(data, "flags", 4) is None
    assert vetoes_of(data) == []
    assert telemetry.pop("reset_cause") == "unknown"
    assert set(telemetry.values()) == {None}


def test_without_a_status_everything_is_unknown():
    assert set(telemetry_of(None).values()) == {None}
