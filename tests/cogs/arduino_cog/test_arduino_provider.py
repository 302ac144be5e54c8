"""The Arduino as a module: readings, state, veto, Start."""

import math
import struct

import pytest
from arduino_cog.commands.arduino_status_command import ArduinoStatusCommand
from arduino_cog.modules.arduino_provider import ArduinoProvider
from twisted.logger import LogLevel, capturedLogs

from tests.cogs.arduino_cog.board import MODULES
from tests.cogs.serial_cog.rig import VirtualReactor
from tests.support.system import build_up
from up.commands.board_schema import VETOES
from up.commands.orientation_command import OrientationCommand
from up.commands.roles import Role
from up.commands.rx_command import RXCommand
from up.commands.servo_command import ServoCommand
from up.commands.system_commands import LinkStateCommand
from up.config import ConfigErrors
from up.mode import Mode
from up_simulator.firmware.wire import checked_frame

ORIENTATION = (65535, 10.5, -5.5, 3.25, 0.5, -1.5, 20.0)


def orientation(*values):
    return struct.pack(">H6f", *values)


def test_an_orientation_reaches_the_bus_with_its_sequence_and_origin(rig):
    taken = rig.heard_on_bus(OrientationCommand)
    rig.connect()
    rig.say("O", orientation(*ORIENTATION))
    ((command, origin),) = taken
    assert command == OrientationCommand(3.25, -5.5, 10.5, 20.0, -1.5, 0.5, 65535)
    assert (origin.link, origin.role, origin.priority) == ("arduino", Role.BOARD, 10)


@pytest.mark.parametrize("place", range(1, 7))
@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf, 4001.0])
def test_an_orientation_that_cannot_be_is_dropped_and_counted(rig, place, bad):
    taken = rig.heard_on_bus(OrientationCommand)
    rig.connect()
    values = list(ORIENTATION)
    values[place] = bad
    rig.say("O", orientation(*values))
    assert taken == []
    assert rig.arduino.counters["invalid_orientations"] == 1


def test_inputs_outputs_and_status_reach_the_bus(rig):
    taken = [rig.heard_on_bus(each) for each in (RXCommand, ServoCommand, ArduinoStatusCommand)]
    rig.start()
    rig.say("i", struct.pack(">6HB", 1500, 1502, 0, 1498, 1100, 0, 0b011011))
    rig.say("r", struct.pack(">4H", 1500, 1501, 1000, 1503))
    rig.status(armed=True)
    ((rx, _),), ((servo, _),), ((status, _),) = taken
    assert rx == RXCommand(1500, 1502, 0, 1498, 1100, 0, 27)
    assert servo == ServoCommand(1500, 1501, 1000, 1503)
    assert status.is_armed


@pytest.mark.parametrize("inputs", [(3001, 0, 0, 0, 0, 0, 63), (0, 0, 0, 0, 0, 0, 64)])
def test_inputs_that_cannot_be_are_dropped(rig, inputs):
    taken = rig.heard_on_bus(RXCommand)
    rig.connect()
    rig.say("i", struct.pack(">6HB", *inputs))
    rig.say("r", struct.pack(">4H", 1500, 1500, 3001, 1500))
    assert taken == []
    assert rig.arduino.counters == {"invalid_inputs": 1, "invalid_outputs": 1}
    assert rig.arduino.servo is None


def test_telemetry_has_the_arduinos_keys(rig):
    rig.start()
    rig.say("r", struct.pack(">4H", 1500, 1501, 1000, 1503))
    rig.status(armed=False, vetoes=0b1001)
    rig.advance(0.1)
    content = rig.up.telemetry_controller.collect()
    assert content["arduino"] == {
        "connected": True,
        "framing": "checked",
        "switch": "high",
        "failsafe": False,
        "loop_us": 2000,
        "late_us": 48,
        "frame_errors": 3,
        "reset_cause": "power-on",
        "restored": False,
        "bias_stored": False,
        "receiver_valid": True,
        "imu_valid": True,
        "flight_battery_v": None,
        "flight_battery_a": None,
        "flight_battery_low": None,
        "flight_battery_critical": None,
    }
    assert content["armed"] is False
    assert content["flight_mode"] == "FBW"
    assert content["servo"] == {
        "ailerons": 1500,
        "elevator": 1501,
        "throttle": 1000,
        "rudder": 1503,
    }
    assert content["vetoes"] == [f"arduino: {VETOES[bit]}" for bit in (0, 3)]
    assert content["age_ms"]["servo"] == 100
    assert content["source"]["servo"] == "arduino"
    assert content["source"]["flight"] == "arduino"


def test_telemetry_tells_how_old_the_state_of_the_flight_is(rig):
    assert rig.up.telemetry_controller.collect()["age_ms"]["flight"] is None
    rig.start()
    rig.status(armed=False)
    content = rig.up.telemetry_controller.collect()
    assert (content["armed"], content["age_ms"]["flight"]) == (False, 0)
    rig.advance(0.3)
    content = rig.up.telemetry_controller.collect()
    assert (content["armed"], content["age_ms"]["flight"]) == (False, 300)
    rig.advance(5.0)
    content = rig.up.telemetry_controller.collect()
    assert content["armed"] is content["flight_mode"] is content["age_ms"]["flight"] is None


def test_telemetry_tells_an_old_gyro_bias_and_a_state_that_came_back(rig):
    rig.start()
    rig.flags = 0b100001
    rig.status(cause=0x88)
    arduino = rig.up.telemetry_controller.collect()["arduino"]
    assert arduino["restored"] is arduino["bias_stored"] is True
    assert arduino["receiver_valid"] is arduino["imu_valid"] is False
    assert arduino["reset_cause"] == "watchdog, state restored"


def test_what_is_not_known_is_null(rig):
    rig.start_alone()
    content = rig.up.telemetry_controller.collect()
    assert content["armed"] is content["flight_mode"] is content["arduino"]["switch"] is None
    assert content["servo"]["throttle"] is None
    assert [each.partition(":")[0] for each in content["vetoes"]] == ["arduino"]


def test_the_link_comes_with_the_first_frame_and_goes_after_a_second(rig):
    taken = rig.heard_on_bus(LinkStateCommand)
    rig.mute = set("sGgv")
    rig.start()
    assert taken == []
    rig.status(armed=True)
    assert [each.connected for each, _ in taken] == [True]
    assert rig.arduino.is_armed
    rig.advance(0.96)
    assert len(taken) == 1
    rig.advance(0.06)
    assert [(each.link, each.connected) for each, _ in taken] == [
        ("arduino", True),
        ("arduino", False),
    ]
    assert rig.arduino.is_armed is None, "an Arduino that is gone is neither armed nor disarmed"
    assert [each.partition(":")[0] for each in rig.up.vetoes.all] == ["arduino"]


def test_start_is_sent_when_the_line_opens_and_until_status_comes(rig):
    rig.mute = {"s"}
    rig.start()
    assert len(rig.sent("s")) == 1
    rig.advance(1.3)
    assert len(rig.sent("s")) == 4
    rig.status()
    rig.forget()
    for _ in range(10):
        rig.advance(0.2)
        rig.status()
    assert rig.sent("s") == []


def test_an_answer_without_forwarding_is_no_reason_to_stop_starting(rig):
    rig.start()
    rig.forget()
    rig.advance(2.1)
    assert len(rig.sent("s")) == 5


def test_every_reconnection_is_started_anew(rig):
    rig.connect()
    rig.port.unplug()
    rig.turn()
    rig.advance(3)
    rig.forget()
    rig.port.plug_in()
    rig.advance(2)
    assert rig.sent("s")[:1] == [b""]
    assert rig.sent("v")[:1] == [b"\0"]


def test_the_veto_is_told_within_every_500_ms_and_at_once_when_it_changes(rig):
    rig.connect()
    rig.advance(0.05)
    rig.forget()
    rig.up.vetoes.set("pids.yml", "is corrupt")
    rig.turn()
    assert rig.sent("v") == [b"\1"]
    for _ in range(8):
        rig.forget()
        rig.advance(0.5)
        assert set(rig.sent("v")) == {b"\1"}
    rig.forget()
    rig.up.vetoes.clear("pids.yml")
    rig.turn()
    assert rig.sent("v") == [b"\0"]


def test_what_the_arduino_vetoes_is_not_told_back_to_it(rig):
    rig.connect()
    rig.status(vetoes=0b1111)
    rig.forget()
    rig.advance(1)
    assert set(rig.sent("v")) == {b"\0"}


def test_a_reset_in_flight_is_noticed_and_started_again(rig):
    rig.connect(armed=True)
    rig.advance(0.2)
    rig.status(uptime_s=400)
    rig.forget()
    rig.status(uptime_s=1, cause=0x88)
    assert rig.sent("s") == [b""]
    assert rig.sent("G") == [b""]
    assert rig.sent("gt") == [], "nothing is pushed to an Arduino that flies"
    assert rig.arduino.counters["resets"] == 1
    assert rig.arduino.telemetry_content["arduino"]["reset_cause"] == "watchdog, state restored"


def test_a_board_that_flies_after_a_reset_is_named_by_a_program_that_starts(rig):
    with capturedLogs() as events:
        rig.start()
        rig.status(armed=True, cause=0x88)
        rig.status(armed=True, cause=0x88)
    (warning,) = [each for each in events if each["log_level"] is LogLevel.warn]
    assert warning["reset_cause"] == "watchdog, state restored" and warning["armed"]
    assert rig.arduino.counters["resets"] == 0


def test_time_that_stands_at_its_most_is_no_reset(rig):
    rig.connect()
    rig.status(uptime_s=65535)
    rig.status(uptime_s=65535)
    assert rig.arduino.counters["resets"] == 0


def test_a_firmware_of_another_version_is_not_armed(rig):
    rig.connect()
    rig.status(version=2, armed=True)
    assert "version 2" in rig.up.vetoes.own["arduino firmware"]
    rig.status(version=1)
    assert rig.up.vetoes.own == {}


def test_a_refused_stream_is_counted_and_harms_nothing(rig):
    rig.connect()
    for _ in range(3):
        rig.say("!", bytes((ord("u"), 9, 6)))
    assert rig.arduino.counters["refused_frames"] == 3


def test_a_repeated_orientation_frame_is_published_once(rig):
    taken = rig.heard_on_bus(OrientationCommand)
    rig.connect()
    frame = checked_frame(77, "O", orientation(*ORIENTATION))
    rig.port.write(frame + frame)
    rig.turn()
    assert len(taken) == 1


def test_thesis_framing_brings_orientation_without_rates_and_servo(make_rig):
    rig = make_rig("thesis")
    taken = rig.heard_on_bus(OrientationCommand)
    rig.start()
    rig.port.write(b"FIFO reset\r\n")
    rig.turn()
    rig.advance(0.2)
    rig.say("o", struct.pack(">3f", 10.5, -5.5, 3.25))
    rig.say("r", struct.pack(">4H", 1500, 1501, 1000, 1503))
    assert taken[-1][0] == OrientationCommand(3.25, -5.5, 10.5)
    assert rig.arduino.servo == ServoCommand(1500, 1501, 1000, 1503)
    content = rig.up.telemetry_controller.collect()
    assert content["armed"] is None
    assert "rx" not in content


def test_an_old_firmware_gets_no_start_and_no_veto(make_rig):
    rig = make_rig("thesis")
    rig.start()
    rig.say("r", struct.pack(">4H", 1500, 1501, 1000, 1503))
    rig.up.vetoes.set("a", "reason")
    rig.advance(3)
    assert {each.type for each in rig.port.heard if not isinstance(each, int)} <= {"T", "t"}
    assert not any(isinstance(each, int) for each in rig.port.heard)


def test_the_raspberry_cannot_control_an_old_firmware(make_rig):
    config = {"config.yml": "flight controller: raspberry\n"}
    with pytest.raises(ConfigErrors) as caught:
        make_rig("thesis", config)
    (problem,) = caught.value.problems
    assert (problem.path.name, problem.line) == ("arduino.yml", 1)
    assert make_rig("checked", config).arduino.is_checked


def test_stopping_leaves_no_timer(rig):
    rig.connect()
    rig.say("O", orientation(*ORIENTATION))
    rig.stop()
    assert not rig.reactor.getDelayedCalls()
    assert not rig.reactor.readers


def test_in_black_box_mode_there_is_no_arduino(tmp_path):
    up = build_up(MODULES, VirtualReactor(), tmp_path, mode=Mode.BLACK_BOX)
    assert up.get_module(ArduinoProvider) is None
    assert not [each for each in up.modules if "arduino" in each.path]
