"""The path controller with a point mass in wind, and its limits for any finite state."""

import math
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from raspilot.navigation.airframe_model import STALL_MARGIN, AirframeModel
from raspilot.navigation.path_controller import PathController
from tests.raspilot.navigation.point_mass import CONFIG, FRAME, STEP_S, PointMass, distances, rms
from up.flight_modes.demand import Bank, Circle, Course, Line, PathDemand
from up.flight_modes.navigation_state import NavigationState, Point

LIMITS, SPEEDS = CONFIG.vertical, CONFIG.airspeed
CIRCLE = Circle(Point(0.0, 0.0), 50.0)


@pytest.mark.parametrize("is_clockwise", [True, False])
@pytest.mark.parametrize(("wind", "allowed_m"), [((0, 0), 0.3), ((0, -6), 1.0), ((8, 0), 1.5)])
def test_a_circle_is_flown_in_wind(wind, allowed_m, is_clockwise):
    plane = PointMass(wind=wind, north=-120.0, east=40.0)
    plane.fly(PathDemand(replace(CIRCLE, is_clockwise=is_clockwise), 300.0), 60)
    track = plane.fly(PathDemand(replace(CIRCLE, is_clockwise=is_clockwise), 300.0), 60)
    assert rms(each - 50.0 for each in distances(track)) < allowed_m
    assert rms(each.altitude_m - 300.0 for each in track) < 0.5
    assert all(abs(each.airspeed_m_s - SPEEDS.cruise_m_s) < 0.7 for each in track)


def test_the_approach_of_a_circle_does_not_overshoot():
    plane = PointMass(north=-400.0)
    nearest_m = min(distances(plane.fly(PathDemand(CIRCLE, 300.0), 90)))
    assert nearest_m > 48.0


@pytest.mark.parametrize("wind", [(0, 0), (0, 7), (-7, 0), (5, 5)])
def test_a_line_is_flown_in_wind(wind):
    plane = PointMass(wind=wind, east=60.0, heading=90.0)
    path = PathDemand(Line(Point(0.0, 0.0), 0.0), 300.0)
    across = [each.position.east_m for each in plane.fly(path, 40)]
    assert min(across) > -8.0
    assert rms(each.position.east_m for each in plane.fly(path, 40)) < 0.3


@pytest.mark.parametrize(
    ("airspeed_error", "wind_error"), [(-1.5, (0, 0)), (1.5, (0, 0)), (0, (1, 1))]
)
def test_an_error_of_airspeed_or_wind_causes_no_steady_error_of_the_track(
    airspeed_error, wind_error
):
    state = PointMass(wind=(0.0, 6.0), heading=-33.0).state
    estimate = replace(
        state,
        airspeed_m_s=state.airspeed_m_s + airspeed_error,
        wind_m_s=Point(*(a + b for a, b in zip(state.wind_m_s, wind_error, strict=True))),
    )
    demand = PathDemand(Line(Point(0.0, 0.0), state.course_deg), 300.0)
    controller = PathController(CONFIG)
    for _ in range(50):
        attitude = controller.step(demand, estimate, 0.02)
    assert attitude.roll_deg == pytest.approx(0.0, abs=0.1)


@pytest.mark.parametrize("error_m_s", [0.5, -0.5])
def test_a_velocity_that_is_slightly_wrong_leaves_no_steady_distance_to_a_line(error_m_s):
    demand = PathDemand(Line(Point(0.0, 0.0), 0.0), 300.0)
    plane = PointMass(wind=(0.0, 6.0), heading=-33.0)

    def step(state):
        north_m_s, east_m_s = state.velocity_m_s
        wrong = replace(state, velocity_m_s=Point(north_m_s, east_m_s + error_m_s))
        return plane.controller.step(demand, wrong, STEP_S)

    plane.fly(step, 40)
    assert rms(each.position.east_m for each in plane.fly(step, 20)) < 0.25


def test_the_bank_limit_of_a_demand_is_kept():
    plane = PointMass(roll=-30.0)
    plane.fly(PathDemand(Course(90.0), 300.0, bank_limit_deg=8.0), 3.0)
    assert plane.track[-1].roll_deg == pytest.approx(8.0, abs=0.1)


def test_a_course_is_a_direction_over_the_ground():
    plane = PointMass(wind=(6.0, 0.0))
    last = plane.fly(PathDemand(Course(90.0), 300.0), 30)[-1]
    assert last.course_deg == pytest.approx(90.0, abs=0.5)
    assert math.remainder(last.heading_deg - 90.0, 360.0) > 25.0


@pytest.mark.parametrize("wind", [(-13.0, 0.0), (-13.0, 5.0), (0.0, 14.0)])
def test_wind_above_the_airspeed_causes_no_limit_cycle(wind):
    plane = PointMass(wind=wind, heading=30.0)
    plane.fly(PathDemand(Circle(Point(300.0, 0.0), 50.0), 300.0), 60)
    track = plane.fly(PathDemand(Circle(Point(300.0, 0.0), 50.0), 300.0), 60)
    assert max(abs(each.roll_deg) for each in track) < 5.0
    upwind = math.degrees(math.atan2(-wind[1], -wind[0]))
    assert abs(math.remainder(track[-1].heading_deg - upwind, 360.0)) < 45.0


@pytest.mark.parametrize("wind", [(0, 0), (0, 6)])
def test_altitude_is_changed_within_the_climb_limits(wind):
    plane = PointMass(wind=wind)
    plane.fly(PathDemand(CIRCLE, 300.0), 30)
    for altitude in (340.0, 310.0):
        track = plane.fly(PathDemand(CIRCLE, altitude), 40)
        assert max(abs(each.climb_m_s) for each in track) < LIMITS.climb_limit_m_s + 1.0
        assert track[-1].altitude_m == pytest.approx(altitude, abs=0.5)
        # Idle does not descend fast enough: the rest of the energy is airspeed.
        most = SPEEDS.maximum_m_s + 0.5 if altitude == 340.0 else SPEEDS.cruise_m_s + 2.7
        assert all(SPEEDS.cruise_m_s - 0.7 < each.airspeed_m_s < most for each in track)


def test_a_climb_rate_is_held_without_an_altitude():
    plane = PointMass()
    track = plane.fly(PathDemand(Course(0.0), None, 1.0), 30)
    assert track[-1].climb_m_s == pytest.approx(1.0, abs=0.15)


@pytest.mark.parametrize("drag", [0.8, 1.25])
@pytest.mark.parametrize("thrust", [0.85, 1.15])
def test_wrong_numbers_of_the_airframe_are_corrected(drag, thrust):
    plane = PointMass(drag=drag, thrust=thrust)
    plane.fly(PathDemand(CIRCLE, 300.0), 60)
    track = plane.fly(PathDemand(CIRCLE, 300.0), 20)
    assert rms(each.altitude_m - 300.0 for each in track) < 0.5
    assert rms(each.airspeed_m_s - SPEEDS.cruise_m_s for each in track) < 0.5


def test_height_is_given_up_before_speed():
    plane = PointMass(thrust=0.45)
    track = plane.fly(PathDemand(CIRCLE, 400.0, airspeed_m_s=14.0), 90)
    assert min(each.airspeed_m_s for each in track) > SPEEDS.minimum_m_s - 0.3


@pytest.mark.parametrize("airspeed_m_s", [8.0, 9.5, 13.0])
def test_a_glider_holds_its_airspeed_by_pitch(airspeed_m_s):
    plane = PointMass()
    plane.fly(PathDemand(CIRCLE, 300.0, airspeed_m_s=airspeed_m_s, motor=False), 40)
    track = plane.fly(PathDemand(CIRCLE, 300.0, airspeed_m_s=airspeed_m_s, motor=False), 20)
    assert plane.attitude.throttle == 0.0
    load = 1.0 / math.cos(math.radians(track[-1].roll_deg))
    wanted = max(airspeed_m_s, SPEEDS.minimum_m_s * math.sqrt(load))
    assert track[-1].airspeed_m_s == pytest.approx(wanted, abs=0.3)
    assert track[-1].altitude_m < 290.0


def test_an_airframe_without_motor_is_a_glider():
    config = replace(CONFIG, performance=replace(CONFIG.performance, motor=False))
    plane = PointMass(config)
    track = plane.fly(PathDemand(CIRCLE, 300.0), 40)
    assert plane.attitude.throttle == 0.0
    assert track[-1].airspeed_m_s == pytest.approx(SPEEDS.cruise_m_s, abs=0.3)


def test_after_the_motor_has_stopped_the_airspeed_stays():
    plane = PointMass()
    demand = PathDemand(CIRCLE, 300.0)
    plane.fly(demand, 40)
    plane.thrust = 0.0
    plane.fly(demand, 3.0)
    plane.motor_stopped = True
    track = plane.fly(demand, 60)
    assert min(each.airspeed_m_s for each in plane.track) > 1.15 * SPEEDS.stall_m_s
    assert track[-1].airspeed_m_s > 1.1 * SPEEDS.best_glide_m_s
    assert track[-1].climb_m_s == pytest.approx(-0.7, abs=0.2)


@pytest.mark.parametrize("climbing_s", [2.0, 5.0, 15.0])
def test_a_stop_in_a_long_climb_may_be_seen_late(climbing_s):
    plane = PointMass()
    plane.fly(PathDemand(CIRCLE, 300.0), 40)
    climb = PathDemand(Circle(Point(900.0, 0.0), 50.0), 420.0)
    plane.fly(climb, climbing_s)
    plane.thrust = 0.0
    plane.fly(climb, 3.5)
    plane.motor_stopped = True
    plane.fly(climb, 10)
    assert min(each.airspeed_m_s for each in plane.track) > 1.15 * SPEEDS.stall_m_s


def test_a_false_alarm_costs_no_height_and_little_airspeed():
    plane = PointMass()
    demand = PathDemand(CIRCLE, 300.0)
    plane.fly(demand, 40)
    plane.motor_stopped = True
    track = plane.fly(demand, 6)
    assert max(abs(each.altitude_m - 300.0) for each in track) < 10.0
    assert 1.15 * SPEEDS.stall_m_s < min(each.airspeed_m_s for each in track)
    assert max(each.airspeed_m_s for each in track) < SPEEDS.maximum_m_s


def test_the_throttle_after_a_stop_shows_whether_the_motor_works():
    """Some, but not full: a motor that works must not accelerate an aircraft that glides."""
    state = replace(PointMass().state, motor_stopped=True)
    climb = PathDemand(Bank(0.0), 400.0)
    throttle = stepped(PathController(CONFIG), climb, state, 10).throttle
    assert CONFIG.performance.level_throttle < throttle < 0.65


def test_the_sums_are_frozen_at_the_limits():
    """An unreachable altitude for two minutes does not delay the descent."""
    plane = PointMass(thrust=0.7, drag=1.3)
    plane.fly(PathDemand(CIRCLE, 1000.0), 120)
    begin = plane.altitude
    track = plane.fly(PathDemand(CIRCLE, begin - 20.0), 20)
    assert track[-1].altitude_m == pytest.approx(begin - 20.0, abs=2.0)
    assert max(each.altitude_m for each in track) < begin + 6.0


def stepped(controller, demand, state, duration_s):
    """Step with a state that does not change; return the last attitude."""
    for _ in range(round(duration_s / 0.02)):
        attitude = controller.step(demand, state, 0.02)
    return attitude


def test_pitch_does_not_climb_at_the_least_airspeed():
    state = replace(PointMass().state, airspeed_m_s=SPEEDS.minimum_m_s - 0.5)
    climb = PathDemand(Bank(0.0), 305.0, airspeed_m_s=SPEEDS.minimum_m_s)
    assert stepped(PathController(CONFIG), climb, state, 1.0).pitch_deg < 5.0
    fast = replace(state, airspeed_m_s=SPEEDS.cruise_m_s)
    assert stepped(PathController(CONFIG), climb, fast, 1.0).pitch_deg > 6.0


def test_a_long_climb_has_the_pitch_from_which_a_stop_is_survived():
    """The airspeed that it has counts, not the one that it should have."""
    controller, state = PathController(CONFIG), PointMass().state
    highest_deg = AirframeModel(CONFIG).climb_pitch_deg(SPEEDS.cruise_m_s, 1.0)
    pitch_deg = stepped(controller, PathDemand(Bank(0.0), 400.0), state, 5.0).pitch_deg
    assert pitch_deg == pytest.approx(highest_deg)
    unwatched = replace(state, motor_watched=False)
    slow = stepped(PathController(CONFIG), PathDemand(Bank(0.0), 400.0), unwatched, 5.0)
    level_deg = AirframeModel(CONFIG).level_pitch_deg(SPEEDS.cruise_m_s, 1.0)
    climb_m_s = SPEEDS.cruise_m_s * math.radians(slow.pitch_deg - level_deg)
    assert climb_m_s == pytest.approx(1.0), "a stop would not be noticed"
    near = PathDemand(Bank(0.0), 305.0)
    assert stepped(controller, near, state, 5.0).pitch_deg > highest_deg + 1.5, "against a gust"


def test_pitch_answers_an_updraft_at_once():
    still = replace(PointMass().state, climb_m_s=0.0)
    level = PathDemand(Bank(0.0), 300.0)
    base_deg = stepped(PathController(CONFIG), level, still, 0.2).pitch_deg
    rising = replace(still, climb_m_s=1.0)
    pitch_deg = stepped(PathController(CONFIG), level, rising, 0.2).pitch_deg
    slope_deg = math.degrees(1.0 / SPEEDS.cruise_m_s)
    assert pitch_deg == pytest.approx(base_deg - LIMITS.pitch_p * slope_deg, abs=0.6)


def test_in_rising_air_at_idle_the_altitude_comes_before_the_airspeed():
    """Pitch leaves the airspeed as it is, up to 2 m/s too much; farther above it slows down."""
    airspeed_m_s = SPEEDS.cruise_m_s + 1.5
    level_deg = AirframeModel(CONFIG).level_pitch_deg(airspeed_m_s, 1.0)
    rising = replace(
        PointMass().state, airspeed_m_s=airspeed_m_s, climb_m_s=1.0, pitch_deg=level_deg
    )
    slopes_deg = []
    for above_m in (2.0, 20.0):
        demand = PathDemand(Bank(0.0), rising.altitude_m - above_m)
        attitude = stepped(PathController(CONFIG), demand, rising, 0.7)
        assert attitude.throttle == 0.0
        wanted_m_s = max(-LIMITS.sink_limit_m_s, -LIMITS.height_gain * above_m) - 1.0
        slope_deg = math.degrees(LIMITS.pitch_p * wanted_m_s / airspeed_m_s)
        slopes_deg.append(attitude.pitch_deg - level_deg - slope_deg)
    assert slopes_deg[0] == pytest.approx(0.0, abs=2.0)
    assert slopes_deg[1] > slopes_deg[0] + 2.0


def test_the_throttle_is_not_wound_up_by_an_unreachable_climb():
    controller, state = PathController(CONFIG), replace(PointMass().state, climb_m_s=1.0)
    assert stepped(controller, PathDemand(Bank(0.0), 400.0, 0.0, 15.0), state, 60).throttle == 1.0
    level = replace(state, climb_m_s=0.0)
    throttle = stepped(controller, PathDemand(Bank(0.0), 300.0), level, 3).throttle
    assert throttle == pytest.approx(CONFIG.performance.level_throttle, abs=0.15)


def test_it_begins_from_the_present_attitude():
    plane = PointMass(roll=-30.0, pitch=10.0)
    first = plane.controller.step(PathDemand(CIRCLE, 350.0), plane.state, 0.02)
    assert first.roll_deg == pytest.approx(-30.0, abs=1.3)
    assert first.pitch_deg == pytest.approx(10.0, abs=0.7)


finite = st.floats(allow_nan=False, allow_infinity=False)
points = st.builds(Point, finite, finite)
states = st.builds(
    NavigationState, finite, st.just(FRAME), points, points, finite, finite, points,
    *[finite] * 10,
)  # fmt: skip
radii = st.floats(min_value=0.1, max_value=1e9)
paths = st.one_of(
    st.builds(Line, points, finite), st.builds(Circle, points, radii, st.booleans()),
    st.builds(Course, finite), st.builds(Bank, finite),
)  # fmt: skip
demands = st.builds(
    PathDemand, paths, st.none() | finite, finite, st.none() | finite, st.booleans()
)


@given(demands, st.lists(states, min_size=1, max_size=4), finite)
def test_limits_are_kept_for_any_finite_state(demand, flown, dt_s):
    controller = PathController(CONFIG)
    model = AirframeModel(CONFIG)
    for state in flown:
        attitude = controller.step(demand, state, dt_s)
        assert abs(attitude.roll_deg) <= CONFIG.lateral.bank_limit_deg
        assert -LIMITS.pitch_down_limit_deg <= attitude.pitch_deg <= LIMITS.pitch_up_limit_deg
        assert 0.0 <= attitude.throttle <= 1.0
        if 0.1 < state.airspeed_m_s < 100.0:
            # The stall speed of the demanded turn, with its margin, is below the airspeed.
            stall = SPEEDS.stall_m_s / math.sqrt(math.cos(math.radians(attitude.roll_deg)))
            assert attitude.roll_deg == 0.0 or stall * STALL_MARGIN <= state.airspeed_m_s + 1e-6
        if not demand.motor:
            assert attitude.throttle == 0.0
    assert model.bank_limit_deg(SPEEDS.stall_m_s) == 0.0


@settings(max_examples=40, deadline=None)
@given(
    st.floats(0, 10), st.floats(0, 360), st.floats(0, 360), st.floats(-40, 40), st.floats(15, 200),
    st.floats(-60, 60), st.floats(0.7, 1.3), st.sampled_from([0.0, 0.5, 1.0]), st.booleans(),
)  # fmt: skip
def test_it_never_stalls(speed, wind_from, heading, roll, radius, climb, drag, thrust, motor):
    wind = (speed * math.cos(wind_from), speed * math.sin(wind_from))
    plane = PointMass(wind=wind, heading=heading, roll=roll, drag=drag, thrust=thrust)
    circle = Circle(Point(100.0, 0.0), radius)
    track = plane.fly(PathDemand(circle, 300.0 + climb, motor=motor), 25)
    assert min(each.airspeed_m_s for each in track) > 1.1 * SPEEDS.stall_m_s
