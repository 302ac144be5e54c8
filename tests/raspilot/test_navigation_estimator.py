"""The provider of the reading ``navigation``, fed as by board and phone."""

import math

import pytest
from twisted.internet.task import Clock

from raspilot.modules.navigation_estimator import NavigationEstimator
from raspilot.navigation.motor_watch import SETTLING_S
from tests.support.system import build_up
from up.commands.airspeed_command import AirspeedCommand
from up.commands.altitude_command import AltitudeCommand
from up.commands.flight_state_command import FlightBatteryCommand
from up.commands.heading_command import HeadingCommand
from up.commands.location_command import LocationCommand
from up.commands.orientation_command import AccelerationCommand, OrientationCommand
from up.commands.origin import Origin
from up.commands.roles import Role
from up.commands.servo_command import ServoCommand
from up.commands.telemetry_schema import FIELDS
from up.earth import MEAN_RADIUS_M

BOARD = Origin("arduino", Role.BOARD, 10)
PHONE, RECEIVER = Origin("android", Role.SENSOR, 0), Origin("gps", Role.SENSOR, 20)
PITOT, SPARE = Origin("pitot", Role.SENSOR, 20), Origin("spare", Role.SENSOR, 10)
SPEED_M_S, RADIUS_M, DELAY_S = 11.0, 60.0, 0.5
METRES_PER_DEG = math.radians(MEAN_RADIUS_M)


class Rig:
    """An aircraft that circles without wind; a board whose yaw is 40 deg too low."""

    def __init__(self, folder):
        self.clock = Clock()
        self.up = build_up((NavigationEstimator,), self.clock, folder)
        self.module = self.up.get_module(NavigationEstimator)
        self.throttle_us = 1490
        self.roll_deg = math.degrees(math.atan(SPEED_M_S**2 / RADIUS_M / 9.80665))

    def publish(self, command, origin):
        self.up.command_executor.execute_command(command, origin)

    def heading_rad(self, time_s):
        return SPEED_M_S / RADIUS_M * time_s

    def location(self, time_s, origin=PHONE, north_m=0.0, **changes):
        angle = self.heading_rad(time_s)
        values = {
            "latitude_deg": (north_m + RADIUS_M * math.sin(angle)) / METRES_PER_DEG,
            "longitude_deg": 14 + RADIUS_M * (1 - math.cos(angle)) / METRES_PER_DEG,
            "altitude_m": 300.0,
            "speed_m_s": SPEED_M_S,
            "bearing_deg": math.degrees(angle) % 360,
            "age_ms": DELAY_S * 1000,
        }
        self.publish(LocationCommand(**{**values, **changes}), origin)

    def fly(self, duration_s, wrong_m=None, **changes):
        """Fly by the phone, and by a receiver whose fixes are `wrong_m` beside, if there is one."""
        for _ in range(round(duration_s / 0.02)):
            self.clock.advance(0.02)
            now_s = self.clock.seconds()
            yaw_deg = (math.degrees(self.heading_rad(now_s)) - 40) % 360
            self.publish(ServoCommand(1500, 1500, self.throttle_us, 1500), BOARD)
            self.publish(OrientationCommand(self.roll_deg, 0.9, yaw_deg), BOARD)
            if round(now_s * 50) % 50 == 0:
                self.location(now_s - DELAY_S, **changes)
            if wrong_m is not None and round(now_s * 50) % 10 == 0:
                self.location(now_s - 0.1, RECEIVER, wrong_m, age_ms=100)

    @property
    def off_m(self):
        """How far the estimate is north of the truth."""
        latitude_deg, _ = self.module.state.frame.degrees(self.module.state.position)
        true_m = RADIUS_M * math.sin(self.heading_rad(self.clock.seconds()))
        return latitude_deg * METRES_PER_DEG - true_m

    def feel(self, forward_m_s2, duration_s=3):
        """Fly with an acceleration."""
        for _ in range(round(5 * duration_s)):
            self.publish(AccelerationCommand(forward_m_s2), BOARD)
            self.fly(0.2)


@pytest.fixture
def rig(tmp_path):
    return Rig(tmp_path)


def flat(prefix, values):
    for key, value in values.items():
        name = f"{prefix}.{key}"
        yield from flat(name, value) if isinstance(value, dict) else [(name, value)]


def test_before_a_fix_nothing_is_known(rig):
    assert rig.module.state is None and rig.module.reading is None
    assert rig.module.fresh(1e9) is None and rig.module.age_ms is None
    rig.publish(OrientationCommand(0.0, 0.0, 0.0), BOARD)
    assert rig.module.telemetry_content["navigation"] == {}


def test_the_age_of_the_reading_is_that_of_the_fix(rig):
    rig.fly(20)
    assert rig.module.age_ms == pytest.approx(500, abs=1)
    rig.fly(1)
    # Before anything else reads the state: a new value is computed, the old one is never read.
    assert rig.module.fresh(0.51).value is rig.module.state
    assert rig.module.fresh(0.4) is None
    assert rig.module.reading.source == "android"


def test_the_state_is_that_of_now_although_the_fix_is_late(rig):
    rig.fly(60)
    now_s = rig.clock.seconds()
    angle = rig.heading_rad(now_s)
    state = rig.module.state
    assert state.time_s == now_s
    latitude, longitude = state.frame.degrees(state.position)
    assert latitude * METRES_PER_DEG == pytest.approx(RADIUS_M * math.sin(angle), abs=1.0)
    east_m = RADIUS_M * (1 - math.cos(angle))
    assert (longitude - 14) * METRES_PER_DEG == pytest.approx(east_m, abs=1.0)
    off_deg = math.remainder(state.heading_deg - math.degrees(angle), 360)
    assert abs(off_deg) < 3
    assert state.wind_speed_m_s < 0.5
    assert state.airspeed_m_s == pytest.approx(SPEED_M_S, abs=0.5)


def test_telemetry_has_the_fields_of_the_schema_and_null_for_the_unknown(rig):
    rig.publish(OrientationCommand(0.0, 0.0, 0.0), BOARD)
    rig.location(0.0, speed_m_s=0.0, bearing_deg=None, altitude_m=None, age_ms=0)
    known = {field.path for field in FIELDS if field.path.startswith("navigation.")}
    resting = dict(flat("navigation", rig.module.telemetry_content["navigation"]))
    assert {path for path in known if "target" not in path} == set(resting)
    for name in ("altitude", "height", "course", "airspeed", "heading", "climb", "wind.from"):
        assert resting[f"navigation.{name}"] is None
    rig.module.home_altitude_m = 280.0
    rig.fly(60)
    flying = dict(flat("navigation", rig.module.telemetry_content["navigation"]))
    assert None not in flying.values()
    assert flying["navigation.height"] == pytest.approx(20, abs=1)


def test_rejected_fixes_are_counted_by_reason(rig):
    rig.fly(20)
    rig.fly(2, accuracy_m=80.0)
    rig.fly(1, latitude_deg=20.0)
    counters = rig.module.telemetry_content["counters"]["navigation"]
    assert (counters["accuracy"], counters["jump"]) == (2, 1)
    assert rig.module.age_ms == pytest.approx(3500, abs=1)


def test_a_source_that_another_one_and_the_estimate_contradict_is_left_out(rig):
    rig.fly(30, wrong_m=0.0)
    assert rig.module.location.reading.source == "gps"
    for _ in range(15):
        rig.fly(1, wrong_m=300.0)
        assert abs(rig.off_m) < 10
    assert rig.module.location.reading.source == "android"
    assert rig.module.telemetry_content["counters"]["navigation"]["doubted"] > 50
    rig.fly(4, wrong_m=0.0)
    assert rig.module.location.reading.source == "gps"


def test_a_wrong_phone_changes_nothing_until_it_is_the_only_source(rig):
    rig.fly(30, wrong_m=0.0)
    rig.fly(15, wrong_m=0.0, north_m=200.0)
    assert rig.module.location.reading.source == "gps" and abs(rig.off_m) < 5
    # No measurement contradicts it now, and the aircraft can have flown there.
    rig.fly(20, north_m=200.0)
    assert rig.module.location.reading.source == "android" and rig.off_m > 150


def test_only_the_followed_source_and_valid_values_are_used(rig):
    rig.fly(20)
    before = rig.module.state
    rig.publish(OrientationCommand(math.nan, 0.0, 0.0), BOARD)
    rig.publish(AltitudeCommand(900.0, "required"), Origin("ground", Role.OPERATOR, 0))
    rig.publish(HeadingCommand(90.0, "required"), Origin("ground", Role.OPERATOR, 0))
    assert rig.module.state == before


def test_a_throttle_that_gives_no_thrust_is_a_stopped_motor(rig):
    rig.fly(40)
    rig.feel(0.0, SETTLING_S + 1)
    assert rig.module.telemetry_content["navigation"]["motor_stopped"] is False
    rig.feel(-0.9)
    assert rig.module.state.motor_stopped
    assert rig.module.telemetry_content["navigation"]["motor_stopped"] is True


def test_a_weak_battery_is_no_stopped_motor(rig):
    rig.publish(FlightBatteryCommand(36.0), BOARD)
    rig.fly(40)
    rig.throttle_us = 1100
    rig.fly(1)
    # Without load it is no measure; a single false one changes little.
    rig.publish(FlightBatteryCommand(12.6), BOARD)
    rig.throttle_us = 1490
    rig.fly(1)
    for voltage_v in (12.0, 36.0, 12.0):
        rig.publish(FlightBatteryCommand(voltage_v), BOARD)
    rig.feel(0.0, SETTLING_S + 1)
    rig.publish(FlightBatteryCommand(8.7), BOARD)
    # It nearly holds the altitude; with a full battery this throttle climbs with 2 m/s.
    rig.throttle_us = round(1000 + 490 * 12.0 / 8.7)
    rig.feel(-0.2)
    assert not rig.module.state.motor_stopped
    rig.feel(-0.9)
    assert rig.module.state.motor_stopped


def test_whether_a_stop_would_be_noticed_is_known(rig):
    rig.fly(40)
    assert not rig.module.state.motor_watched
    rig.feel(0.0, SETTLING_S - 1)
    assert not rig.module.state.motor_watched
    rig.feel(0.0, 2)
    assert rig.module.state.motor_watched
    rig.fly(3)
    assert not rig.module.state.motor_watched


def test_an_airframe_without_motor_has_none_that_stops(tmp_path):
    (tmp_path / "navigation.yml").write_text("performance:\n  motor: false\n")
    rig = Rig(tmp_path)
    rig.fly(40)
    rig.feel(-0.9)
    assert rig.module.telemetry_content["navigation"]["motor_stopped"] is False


def test_the_airspeed_of_the_sensor_with_the_highest_priority_corrects_the_model(rig):
    rig.fly(40)
    before = rig.module.state
    assert before.airspeed_m_s == pytest.approx(SPEED_M_S, abs=0.5)
    for _ in range(300):
        rig.publish(AirspeedCommand(SPEED_M_S + 2.0), PITOT)
        rig.publish(AirspeedCommand(5.0), SPARE)
        rig.fly(0.1)
    state = rig.module.state
    assert state.measured_airspeed_m_s == SPEED_M_S + 2.0
    assert state.airspeed_m_s - before.airspeed_m_s > 0.7
    assert state.airspeed_sd_m_s < before.airspeed_sd_m_s
    rig.fly(1.0)
    assert rig.module.state.measured_airspeed_m_s != SPEED_M_S + 2.0
    for value in (math.nan, math.inf):
        rig.module.estimator.airspeed(rig.clock.seconds(), value)
    assert math.isfinite(rig.module.state.airspeed_m_s)
