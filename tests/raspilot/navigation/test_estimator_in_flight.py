"""The estimator against the truth of flights with the compiled firmware and a phone's fixes."""

import math
from dataclasses import replace

import pytest

from tests.raspilot.navigation.recordings import (
    Flight,
    circles,
    mixed,
    off_m,
    record,
    rms,
)

WIND_M_S = 6.0


@pytest.fixture(scope="module")
def calm():
    return record(mixed, 200)


@pytest.fixture(scope="module")
def windy():
    return record(mixed, 200, WIND_M_S, "moderate", 3)


@pytest.fixture(scope="module")
def windy_flight(windy):
    return Flight(windy)


def test_the_delay_of_the_fixes_is_compensated(calm):
    pairs = Flight(calm).pairs(40)
    assert rms(off_m(*pair) for pair in pairs) < 4.0
    late = Flight(calm, change=lambda fix: replace(fix, time_s=fix.time_s + 0.8))
    assert rms(off_m(*pair) for pair in late.pairs(40)) > 6.0, "as if the fixes were current"


def test_position_and_velocity_in_wind_and_turbulence(windy_flight):
    pairs = windy_flight.pairs(40)
    assert rms(off_m(*pair) for pair in pairs) < 5.0
    assert rms(math.dist(each.velocity_m_s, velocity(true)) for each, true in pairs) < 1.2


def velocity(true):
    track = math.radians(true.track_deg)
    return true.speed_m_s * math.cos(track), true.speed_m_s * math.sin(track)


def test_the_wind_is_known_after_two_circles(windy_flight):
    (estimate, _), *_ = windy_flight.pairs(70)
    assert estimate.wind_speed_m_s == pytest.approx(WIND_M_S, abs=1.5)
    assert estimate.wind_from_deg == pytest.approx(270, abs=15)
    assert estimate.wind_sd_m_s < 1.2


def test_the_airspeed_is_known_in_a_glide_and_at_full_throttle(windy_flight):
    assert rms(each.airspeed_m_s - true.airspeed_m_s for each, true in windy_flight.pairs(40)) < 1.3


def test_the_errors_agree_with_the_stated_uncertainty(windy_flight):
    pairs = windy_flight.pairs(40)
    ratio = rms(off_m(*pair) / pair[0].position_sd_m for pair in pairs)
    assert 0.3 < ratio < 1.3
    ratio = rms((e.airspeed_m_s - t.airspeed_m_s) / e.airspeed_sd_m_s for e, t in pairs)
    assert 0.3 < ratio < 2.0
    ratio = rms((e.altitude_m - t.altitude_m) / e.altitude_sd_m for e, t in pairs)
    assert 0.2 < ratio < 1.5


@pytest.mark.parametrize("seed", range(1, 6))
def test_thirty_seconds_without_fixes_end_inside_the_stated_uncertainty(windy, seed):
    flight = Flight(windy, seed=seed, change=lambda f: None if 130 < f.time_s < 160 else f)
    last, true = flight.pairs(159, 160.5)[0]
    assert last.fix_age_s > 27
    assert off_m(last, true) < 60
    assert off_m(last, true) < last.position_sd_m
    assert last.position_sd_m < 70
    assert off_m(*flight.pairs(175)[0]) < 8, "and the position is right again soon"


def test_a_motor_that_works_is_not_suspected(windy_flight):
    assert not windy_flight.estimator.motor.is_stopped


def test_circling_takes_no_calibrated_yaw():
    flight = Flight(record(circles, 60))
    ratio = [(e.heading_deg - t.yaw_deg + 180) % 360 - 180 for e, t in flight.pairs(50)]
    assert rms(ratio) < 8


def altitude_errors(flight, from_s, to_s=math.inf):
    return [e.altitude_m - t.altitude_m for e, t in flight.pairs(from_s, to_s)]


def test_with_a_barometer_the_wander_does_not_move_the_altitude(windy, windy_flight):
    errors = altitude_errors(Flight(windy, barometer=True), 60)
    mean = sum(errors) / len(errors)
    assert rms(each - mean for each in errors) < 1.0
    errors = altitude_errors(windy_flight, 60)
    mean = sum(errors) / len(errors)
    assert 2.0 < rms(each - mean for each in errors) < 5.0, "without one it does"


def along_nose(true):
    """Return the true horizontal airspeed along the nose, in steady air."""
    north, east = velocity(true)
    yaw = math.radians(true.yaw_deg)
    return north * math.cos(yaw) + (east - WIND_M_S) * math.sin(yaw)


def test_the_measured_airspeed_does_not_follow_an_error_of_the_pitch(windy, windy_flight):
    frames = [replace(frame, pitch_deg=frame.pitch_deg + 4.0) for frame in windy]

    def off(flight):
        pairs = flight.pairs(40)
        return rms(e.measured_airspeed_m_s - along_nose(true) for e, true in pairs)

    assert off(windy_flight) < 1.1
    assert off(Flight(frames)) < 1.6


def test_no_airspeed_is_measured_without_young_fixes(windy):
    flight = Flight(windy, change=lambda f: None if 130 < f.time_s < 160 else f)
    measured = [each.measured_airspeed_m_s for each, _ in flight.pairs(134, 158)]
    assert measured == [None] * len(measured)
    assert flight.pairs(125, 130)[0][0].measured_airspeed_m_s is not None
