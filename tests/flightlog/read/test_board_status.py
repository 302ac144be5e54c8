import dataclasses

import pytest
from arduino_cog.commands import arduino_status_command
from arduino_cog.commands.arduino_status_command import ArduinoStatusCommand

from up_flightlog.read.board_status import (
    FAILSAFE,
    has_bit,
    reset_causes_of,
    telemetry_of,
    vetoes_of,
)


def status(**fields) -> ArduinoStatusCommand:
    plain = {field.name: 0 for field in dataclasses.fields(ArduinoStatusCommand)}
    return ArduinoStatusCommand(**{**plain, **fields})


@pytest.mark.parametrize("bits", range(256))
def test_the_same_words_as_the_cog(bits):
    command = status(flags=bits, vetoes=bits, reset_cause=bits, switch=bits % 5, loop_us=2000)
    data = command.data
    assert vetoes_of(data) == list(command.veto_names)
    assert reset_causes_of(data) == command.reset_causes
    assert telemetry_of(data) == {
        "switch": command.switch_position,
        "failsafe": command.is_failsafe,
        "loop_us": 2000,
        "late_us": 0,
        "frame_errors": 0,
        "reset_cause": command.reset_causes,
        "restored": command.is_restored,
        "bias_stored": command.is_bias_stored,
        "receiver_valid": command.is_receiver_valid,
        "imu_valid": command.is_imu_valid,
    }


def test_it_knows_every_bit_of_the_cog():
    assert arduino_status_command.STATUS.size == 20
    assert len(arduino_status_command.VETOES) == 8


@pytest.mark.parametrize("flags", [None, "1", -1, 256, 1.0, [1], True])
def test_invalid_values(flags):
    data = {"flags": flags, "vetoes": flags, "reset_cause": flags, "switch": [flags]}
    assert has_bit(data, "flags", FAILSAFE) is None
    assert vetoes_of(data) == []
    assert reset_causes_of(data) == "unknown"
    assert telemetry_of(data)["switch"] is None
