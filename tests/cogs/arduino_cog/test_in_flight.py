"""In flight: armed, or without a motor once the receiver was seen since the board started."""

import struct

import pytest
from arduino_cog.commands.arduino_commands import ArduinoCalibrateCommand

from tests.cogs.arduino_cog.board import PROFILE, PROFILE_FORMAT
from up.commands.flight_state_command import FlightStateCommand
from up.commands.refusal import Code
from up.flight_controller.pids_file import PIDS

UNKNOWN = 255
RECEIVER_WAIT_S = 5
GLIDER = struct.pack(PROFILE_FORMAT, *PROFILE[:17], 0, *PROFILE[18:])


@pytest.mark.parametrize("text", ["", "rudder: {trim_us: 20}\n"], ids=["plain", "airframe.yml"])
@pytest.mark.parametrize(
    ("has_motor", "armed", "switch", "uptime_s", "expected"),
    [
        (True, False, 1, 100, False),
        (True, True, 1, 100, True),
        (False, False, 1, 100, True),
        (False, False, 0, 100, True),
        (False, False, UNKNOWN, RECEIVER_WAIT_S - 1, True),
        (False, False, UNKNOWN, RECEIVER_WAIT_S, False),
        (False, True, UNKNOWN, 100, True),
    ],
)
def test_in_flight(make_rig, text, has_motor, armed, switch, uptime_s, expected):
    rig = make_rig("checked", {"airframe.yml": text})
    states = []
    rig.up.command_executor.register_command(FlightStateCommand, states.append)
    if not has_motor:
        rig.profile = GLIDER
    rig.switch, rig.uptime_s, rig.flags = switch, uptime_s, 0
    rig.connect(armed=armed)
    rig.alive(0.4)
    assert states[-1].is_in_flight is expected
    assert rig.arduino.telemetry_content["in_flight"] is expected
    pushed = bool(rig.sent("C"))
    assert pushed is (bool(text) and not expected), "airframe.yml is for the ground"
    outcomes = [rig.ask(ArduinoCalibrateCommand(what)) for what in ("level", "receiver_begin")]
    if expected:
        assert [outcome[0].code for outcome in outcomes] == [Code.REFUSED] * 2
        assert rig.sent("e") == []
    else:
        assert outcomes == [["done"], ["done"]]
    assert rig.ask(ArduinoCalibrateCommand("receiver_end")) == ["done"]


def test_without_the_profile_it_is_not_known(make_rig):
    rig = make_rig()
    rig.mute = {"c"}
    rig.connect()
    assert rig.arduino.is_in_flight is None
    rig.status(armed=True)
    assert rig.arduino.is_in_flight is True


@pytest.mark.parametrize(("switch", "pushed"), [(1, 0), (UNKNOWN, 1)])
def test_pids_yml_goes_to_a_glider_on_the_ground_only(make_rig, switch, pushed):
    rig = make_rig("checked", {"pids.yml": PIDS.template()})
    rig.profile, rig.switch, rig.flags = GLIDER, switch, 0
    rig.connect()
    rig.alive(0.4)
    assert len(rig.sent("g")) == pushed
