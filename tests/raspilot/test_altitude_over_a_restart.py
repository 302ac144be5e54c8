"""Heights above home with a barometer: from the arming on, and over a restart in flight."""

import pytest

from raspilot.modules.navigation_estimator import NavigationEstimator
from tests.raspilot.flight_controller_rig import PHONE, Rig
from up.commands.altitude_command import AltitudeCommand
from up.commands.flight_state_command import FlightStateCommand
from up.commands.location_command import LocationCommand
from up.commands.origin import Origin
from up.commands.roles import Role

GROUND_M, PRESSURE_M = 300.0, 45.0
SENSOR = Origin("sensor", Role.SENSOR, 5)


class AltitudeRig(Rig):
    """An aircraft that stands, or hangs in the air, with a phone's fixes and pressure."""

    def __init__(self, folder, **more):
        super().__init__(folder, modules=(NavigationEstimator,), **more)
        self.height_m = 0.0

    def armed(self, is_armed=True):
        self.state(FlightStateCommand("FBW", is_armed, True, False, is_armed))

    def stay(self, duration_s, fix_m, pressure_m=PRESSURE_M, origin=PHONE):
        """Let time pass with these errors of receiver and barometer."""
        true_m = GROUND_M + self.height_m
        for turn in range(round(duration_s / 0.1)):
            self.clock.advance(0.1)
            self.attitude()
            if pressure_m is not None:
                self.bus.execute_command(AltitudeCommand(true_m + pressure_m), origin)
            if turn % 10 == 0:
                fix = LocationCommand(50.0, 14.0, true_m + fix_m, 4.0, 0.0, age_ms=500)
                self.bus.execute_command(fix, PHONE)

    @property
    def shown_m(self):
        navigation = self.up.get_module(NavigationEstimator).telemetry_content["navigation"]
        return navigation["height"]


@pytest.fixture
def flying(tmp_path):
    rig = AltitudeRig(tmp_path)
    rig.armed(False)
    rig.stay(30, 7.0)
    rig.armed()
    rig.stay(1, 7.0)
    rig.height_m = 4.0
    rig.stay(60, 0.0)
    return rig


def test_the_receivers_error_when_home_was_set_does_not_move_the_height(flying):
    assert flying.shown_m == pytest.approx(4.0, abs=0.5)


def test_disarmed_the_altitude_follows_the_fixes_again(flying):
    flying.armed(False)
    flying.stay(120, 0.0)
    assert flying.shown_m == pytest.approx(4.0 - 7.0, abs=2.0)


@pytest.mark.parametrize("origin", [PHONE, SENSOR])
def test_a_restart_in_flight_keeps_the_height(flying, tmp_path, origin):
    flying.stay(5, 0.0, -120.0 if origin is SENSOR else PRESSURE_M, origin)
    flying.armed()
    flying.manager.home.memory.wait()
    again = AltitudeRig(tmp_path, gains=None)
    again.height_m = 4.0
    again.attitude()
    again.armed()
    again.stay(2, -6.0, -120.0 if origin is SENSOR else PRESSURE_M, origin)
    assert again.shown_m == pytest.approx(4.0, abs=0.7)
    again.stay(60, -6.0, -120.0 if origin is SENSOR else PRESSURE_M, origin)
    assert again.shown_m == pytest.approx(4.0, abs=0.7)


def test_a_change_of_the_offset_by_the_weather_is_saved_by_half_metres(flying):
    memory = flying.manager.home.memory
    flying.armed()
    first = memory.values.barometer
    memory.follow_barometer("android", first.offset_m + 0.4)
    assert memory.values.barometer == first
    memory.follow_barometer("android", first.offset_m + 0.6)
    assert memory.values.barometer.offset_m == first.offset_m + 0.6
