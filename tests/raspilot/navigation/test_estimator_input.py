"""Ground, outliers, lost and absurd input, on a flight that needs no simulator."""

import math
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from raspilot.navigation.airframe_model import AirframeModel
from raspilot.navigation.estimator import Estimator
from raspilot.navigation.fix_gate import Fix
from up.flight_modes.navigation_file import NavigationConfig
from up.flight_modes.navigation_state import LocalFrame, Point

FRAME = LocalFrame(50.0, 14.0)
SPEED_M_S, RADIUS_M, DELAY_S = 11.0, 60.0, 0.5
ROLL_DEG = math.degrees(math.atan(SPEED_M_S**2 / RADIUS_M / 9.80665))


class Circling:
    """An estimator in an aircraft that circles without wind; ``change`` replaces its fixes."""

    def __init__(self, config=None):
        self.estimator = Estimator(AirframeModel(config))
        self.estimator.throttle(0.49)
        self.time_s = 0.0
        self.yaw_offset_deg = 40.0
        self.shaken_deg, self.pitch_deg = 0.0, 0.9

    def heading_deg(self, time_s):
        return math.degrees(SPEED_M_S / RADIUS_M * time_s) % 360

    def true(self, time_s):
        angle = math.radians(self.heading_deg(time_s))
        return Point(RADIUS_M * math.sin(angle), RADIUS_M * (1 - math.cos(angle)))

    def fix(self, time_s):
        latitude, longitude = FRAME.degrees(self.true(time_s))
        heading = self.heading_deg(time_s)
        return Fix(time_s, latitude, longitude, 300.0, 4.0, SPEED_M_S, heading)

    def fly(self, duration_s, change=lambda fix: fix):
        for _ in range(round(duration_s / 0.02)):
            self.time_s = round(self.time_s + 0.02, 2)
            yaw_deg = (self.heading_deg(self.time_s) + self.yaw_offset_deg) % 360
            roll_deg = ROLL_DEG + self.shaken_deg * math.sin(4 * self.time_s)
            self.estimator.orientation(self.time_s, roll_deg, self.pitch_deg, yaw_deg)
            if self.time_s % 1.0 == 0.0:
                fix = change(self.fix(self.time_s - DELAY_S))
                if fix is not None:
                    self.estimator.fix(fix, self.time_s)
        return self

    @property
    def off_m(self):
        state = self.estimator.state()
        return math.dist(FRAME.point(*state.frame.degrees(state.position)), self.true(self.time_s))


@pytest.fixture
def circling():
    return Circling().fly(40)


def all_finite(state):
    flat = [*state.position, *state.velocity_m_s, *state.wind_m_s]
    flat += [getattr(state, name) for name in state.__slots__ if name.endswith(("_m", "_s", "_deg"))
             and name not in ("velocity_m_s", "wind_m_s")]  # fmt: skip
    # No fix has measured an airspeed yet: None.
    return all(each is None or math.isfinite(each) for each in flat)


@pytest.mark.parametrize(
    ("reason", "change"),
    [
        ("jump", lambda fix: replace(fix, latitude_deg=fix.latitude_deg + 0.003)),
        ("jump", lambda fix: replace(fix, latitude_deg=-33.0, longitude_deg=151.0)),
        ("accuracy", lambda fix: replace(fix, accuracy_m=31.0)),
        ("invalid", lambda fix: replace(fix, latitude_deg=math.nan)),
        ("invalid", lambda fix: replace(fix, speed_m_s=1e9)),
        ("old", lambda fix: replace(fix, time_s=fix.time_s - 5)),
        ("order", lambda fix: replace(fix, time_s=fix.time_s - 3)),
    ],
)
def test_an_outlier_is_rejected_counted_and_moves_nothing(circling, reason, change):
    circling.fly(2, change)
    assert circling.estimator.rejected == {reason: 2}
    assert circling.off_m < 4
    assert circling.estimator.state().fix_age_s == pytest.approx(2.5)


def test_a_frozen_receiver_is_noticed_with_its_second_equal_fix(circling):
    frozen = circling.fix(circling.time_s)
    circling.fly(5, lambda fix: replace(frozen, time_s=fix.time_s))
    assert circling.estimator.rejected["frozen"] == 4


def test_a_repeated_fix_is_not_an_outlier(circling):
    last = circling.fix(circling.time_s)
    circling.fly(1, lambda fix: last)
    circling.fly(2, lambda fix: last)
    assert circling.estimator.rejected == {}


def test_a_reachable_outlier_that_proves_true_is_believed(circling):
    def beside(fix):
        return replace(fix, latitude_deg=fix.latitude_deg + 100 / 111_195)

    circling.fly(4, beside)
    assert circling.off_m < 10 and circling.estimator.rejected["jump"] == 4
    circling.fly(8, beside)
    assert circling.off_m == pytest.approx(90, abs=20)


@pytest.mark.parametrize(("maximum_m_s", "is_believed"), [(16.0, False), (60.0, True)])
def test_what_is_reachable_depends_on_the_greatest_airspeed(maximum_m_s, is_believed):
    config = NavigationConfig()
    speeds = replace(config.airspeed, maximum_m_s=maximum_m_s)
    circling = Circling(replace(config, airspeed=speeds)).fly(40)
    circling.fly(6, lambda fix: replace(fix, latitude_deg=fix.latitude_deg + 330 / 111_195))
    assert (circling.off_m > 100) == is_believed


def test_gusts_make_a_circle_without_fixes_as_uncertain_as_flights_show(circling):
    """In moderate turbulence 30 s of dead reckoning were wrong by 45 m rms, 77 m at most."""
    assert circling.estimator.state().position_sd_m < 5
    state = circling.fly(30, lambda fix: None).estimator.state()
    assert 35.0 < state.position_sd_m < 55.0


def test_another_country_is_never_believed_in_flight(circling):
    circling.fly(60, lambda fix: replace(fix, latitude_deg=-33.0))
    assert circling.estimator.rejected["jump"] == 60


def test_another_country_is_believed_on_the_ground():
    resting = Circling()

    def still(latitude_deg):
        return lambda fix: Fix(fix.time_s, latitude_deg, 14.0, 300.0, 4.0, 0.0, None)

    resting.fly(3, still(-33.0))
    resting.fly(10, still(50.0))
    assert resting.estimator.state().frame.latitude_deg == 50.0


def test_after_a_minute_without_fixes_the_next_one_is_believed(circling):
    circling.fly(60, lambda fix: None)
    circling.fly(15)
    assert circling.off_m < 5


def test_on_the_ground_nothing_moves():
    resting = Circling()
    resting.fly(120, lambda fix: Fix(fix.time_s, 50.0, 14.0, 300.0, 4.0, 0.2, 10.0))
    state = resting.estimator.state()
    assert not resting.estimator.is_in_flight
    assert math.hypot(*state.position) < 1 and state.ground_speed_m_s < 0.5
    assert state.airspeed_m_s == 0 and state.climb_m_s == 0
    assert state.altitude_m == pytest.approx(300, abs=1)
    resting.fly(40)
    assert resting.estimator.is_in_flight and resting.off_m < 5


@pytest.mark.parametrize(("shaken_deg", "in_flight"), [(0.0, False), (2.0, True)])
def test_who_is_slow_and_still_has_landed_and_who_is_slow_and_shaken_flies(
    circling, shaken_deg, in_flight
):
    """In a head wind as fast as the airspeed the ground speed is zero too."""
    circling.shaken_deg = shaken_deg
    circling.fly(20, lambda fix: replace(fix, speed_m_s=0.1))
    assert circling.estimator.is_in_flight == in_flight


def test_a_jump_of_the_yaw_changes_no_heading(circling):
    before = circling.estimator.state().heading_deg
    circling.yaw_offset_deg = 200.0
    circling.fly(0.02)
    after = circling.estimator.state()
    assert abs(math.remainder(after.heading_deg - before, 360)) < 1.0
    assert circling.fly(20).off_m < 4


def test_dead_reckoning_grows_less_certain(circling):
    sds = [circling.fly(10, lambda fix: None).estimator.state().position_sd_m for _ in range(3)]
    assert sds == sorted(sds) and sds[0] < 15 and 10 < sds[2] < 60


ANY = st.floats(allow_nan=True, allow_infinity=True)
SOME = st.none() | ANY


@settings(max_examples=60, deadline=None)
@given(
    st.lists(
        st.tuples(st.just("orientation"), ANY, ANY, ANY, ANY)
        | st.tuples(st.just("fix"), ANY, ANY, ANY, SOME, SOME, SOME, SOME)
        | st.tuples(st.sampled_from(["compass", "barometer"]), ANY, ANY)
        | st.tuples(st.just("throttle"), ANY),
        max_size=30,
    )
)
def test_absurd_input_never_becomes_an_absurd_state(inputs):
    estimator = Estimator()
    estimator.orientation(0.0, 0.0, 0.0, 0.0)
    estimator.fix(Fix(0.0, 50.0, 14.0, 300.0), 0.0)
    for name, *values in inputs:
        if name == "fix":
            estimator.fix(Fix(*values), values[0])
        else:
            getattr(estimator, name)(*values)
        assert all_finite(estimator.state())


@settings(max_examples=20, deadline=None)
@given(st.lists(st.tuples(st.floats(-1e3, 1e3), st.floats(-360, 360)), min_size=1, max_size=40))
def test_time_that_runs_backwards_or_leaps_is_survived(steps):
    circling = Circling().fly(5)
    for step_s, angle_deg in steps:
        time_s = circling.time_s + step_s
        circling.estimator.orientation(time_s, angle_deg, angle_deg / 4, angle_deg)
        circling.estimator.fix(circling.fix(time_s), time_s)
        assert all_finite(circling.estimator.state())


def test_a_turn_that_no_orientation_showed_changes_neither_airspeed_nor_motor(circling):
    """The IMU is lost for 3 s: the board's yaw continues from where it was."""
    for _ in range(round(3.0 / 0.02)):
        circling.time_s = round(circling.time_s + 0.02, 2)
        if circling.time_s % 1.0 == 0.0:
            circling.estimator.fix(circling.fix(circling.time_s - DELAY_S), circling.time_s)
    circling.yaw_offset_deg -= math.degrees(SPEED_M_S / RADIUS_M * 3.0)
    circling.fly(0.1)
    state = circling.estimator.state()
    assert state.heading_sd_deg > 10.0 and state.measured_airspeed_m_s is None
    for _ in range(12):
        state = circling.fly(1).estimator.state()
        off_deg = state.heading_deg - circling.heading_deg(circling.time_s)
        assert not state.motor_stopped
        if circling.time_s > 45.0:
            assert abs(math.remainder(off_deg, 360.0)) < 6.0
            assert state.measured_airspeed_m_s == pytest.approx(SPEED_M_S, abs=0.7)
            assert circling.off_m < 10.0


def test_an_airspeed_that_the_model_only_imagines_does_not_hide_a_stopped_motor(circling):
    """For 40 s it glides on while the modelled thrust accelerates the model, whose drag grows."""

    def feel_none(duration_s):
        for _ in range(round(duration_s / 0.2)):
            circling.estimator.acceleration(circling.fly(0.2).time_s, 0.0)
        return circling.estimator.motor.is_stopped

    assert not feel_none(11)
    airframe = AirframeModel()
    load = 1.0 / math.cos(math.radians(ROLL_DEG))
    circling.pitch_deg = airframe.glide_pitch_deg(SPEED_M_S, load)
    circling.estimator.throttle(0.6)
    circling.fly(40)
    assert feel_none(4)


@pytest.mark.parametrize("wrong_m_s", [0.0, 0.3 * SPEED_M_S, 3.0 * SPEED_M_S])
def test_a_blocked_pitot_tube_changes_no_airspeed_and_is_counted(circling, wrong_m_s):
    def sense(duration_s, airspeed_m_s):
        for _ in range(round(duration_s / 0.1)):
            circling.estimator.airspeed(circling.fly(0.1).time_s, airspeed_m_s)
        return circling.estimator.state()

    assert sense(10, 1.1 * SPEED_M_S).airspeed_m_s == pytest.approx(1.1 * SPEED_M_S, abs=0.5)
    assert "airspeed" not in circling.estimator.rejected
    state = sense(20, wrong_m_s)
    assert state.airspeed_m_s == pytest.approx(SPEED_M_S, abs=1.2)
    assert state.measured_airspeed_m_s == pytest.approx(SPEED_M_S, abs=1.2)
    assert circling.estimator.rejected == {"airspeed": 200}
