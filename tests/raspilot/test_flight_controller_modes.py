"""The modes of the flight controller on the Raspberry Pi: offered, asked for, refused."""

import pytest
from twisted.internet.task import Clock

from raspilot.flight_controller.attitude_controller import AttitudeController
from tests.raspilot.flight_controller_rig import FBW_MODE, GROUND, MANUAL, Rig
from tests.support.system import build_up
from tests.up.commands.samples import Log
from up.commands.flight_state_command import (
    FlightModeCommand,
)
from up.commands.origin import Origin
from up.commands.output_command import OutputCommand
from up.commands.roles import Role
from up.mode import Mode


class TestModes:
    """Offered, shown and requested modes."""

    def test_telemetry_shows_what_is_really_flown(self, rig):
        def shown():
            return rig.manager.telemetry_content["flight_control"]["mode"]

        assert shown() is None
        rig.frame()
        assert shown() == "FBW"
        rig.clock.advance(0.3)
        assert shown() is None
        rig.sticks()
        rig.frame()
        rig.state(FBW_MODE)
        assert shown() is None

    def test_a_controller_whose_outputs_are_dropped_says_so(self, rig):
        other = Origin("Thermal", Role.INTERNAL)

        def fly(origin=None):
            for number in range(40):
                if origin is not None:
                    rig.bus.execute_command(OutputCommand(1500, 1500, 0, 1500, 1), origin)
                rig.sticks()
                rig.frame()
                if number % 10 == 9:
                    rig.state()
            return state()

        def state():
            event = changes()[-1]
            return event["permitted"], event["flies"], event["owner"]

        def changes():
            return [event for event in log.events if event.get("code") == "control_changed"]

        def counted():
            return rig.manager.telemetry_content["counters"]["flight_control"]["published"]

        controller = rig.manager.class_name
        with Log() as log:
            assert fly() == (True, True, controller)
            delivered = counted()
            assert delivered == len(rig.outputs) == 40
            rig.clock.advance(1)
            assert fly(other) == (True, False, "Thermal")
            assert counted() == delivered
            rig.clock.advance(1)
            assert fly() == (True, True, controller)
            rig.clock.advance(1)
            rig.state()
            assert state() == (True, False, None)
            rig.state(FBW_MODE)
            assert not state()[0]
            rig.state(FBW_MODE)
            rig.state()
            assert len(changes()) == 5

    def test_it_asks_for_auto_only_at_auto_and_while_the_ground_wants_it(self, tmp_path):
        rig = Rig(tmp_path)
        rig.state(MANUAL)
        assert not rig.modes
        rig.state(FBW_MODE)
        assert rig.modes == [FlightModeCommand("AUTO")]
        rig.state(FBW_MODE)
        assert len(rig.modes) == 1
        rig.clock.advance(5)
        rig.state(FBW_MODE)
        assert len(rig.modes) == 2
        rig.bus.execute_command(FlightModeCommand("FBW"), GROUND)
        rig.clock.advance(60)
        rig.state(FBW_MODE)
        assert len(rig.modes) == 3

    @pytest.mark.parametrize(
        ("mode", "text", "loaded"),
        [
            (Mode.AUTO, "raspberry", True),
            (Mode.AUTO, "arduino", False),
            (Mode.BLACK_BOX, "raspberry", False),
        ],
    )
    def test_it_is_loaded_where_the_configuration_says(self, tmp_path, mode, text, loaded):
        up = build_up(
            (AttitudeController,), Clock(), tmp_path, mode=mode,
            config={"config.yml": f"flight controller: {text}\n"},
        )  # fmt: skip
        assert (up.get_module(AttitudeController) is not None) is loaded


def test_a_mode_that_the_board_refuses_is_no_wish(rig):
    """With the switch elsewhere the board refuses; later at AUTO the Pi still requests control."""
    rig.state(MANUAL)
    rig.bus.execute_command(FlightModeCommand("FBW"), GROUND)
    rig.modes.clear()
    rig.state(FBW_MODE)
    assert [each.mode for each in rig.modes] == ["AUTO"]


def test_a_wish_of_the_ground_ends_when_the_switch_leaves_auto(rig):
    rig.state(FBW_MODE)
    rig.bus.execute_command(FlightModeCommand("FBW"), GROUND)
    rig.modes.clear()
    rig.clock.advance(10)
    rig.state(FBW_MODE)
    assert rig.modes == [], "the ground asked for FBW"
    rig.state(MANUAL)
    rig.state(FBW_MODE)
    assert [each.mode for each in rig.modes] == ["AUTO"]
