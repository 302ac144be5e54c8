"""The arithmetic of the navigation's figures; the flights themselves are not tested."""

import math
from dataclasses import replace

import pytest

from bench.navigation import TARGETS, height_errors, line_errors, radius_errors, rms, rows_of
from bench.navigation_flight import Flown, Sample
from bench.navigation_random import Outcome, random_rows
from up.flight_modes.demand import Bank, Circle, Line, PathDemand
from up.flight_modes.navigation_state import LocalFrame, NavigationState, Point
from up_simulator.aircraft.flight import FlightState

FRAME = LocalFrame(50.0, 14.0)
NUMBERS = {name: 0.0 for name in NavigationState.__slots__}
STATE = NavigationState(
    **{
        **NUMBERS,
        "frame": FRAME,
        "position": Point(0.0, 0.0),
        "velocity_m_s": Point(0.0, 0.0),
        "wind_m_s": Point(0.0, 0.0),
    }
)
TRUTH = FlightState(*(0.0 for _ in range(14)))


def sample(north_m, east_m, path, wander_m=(0.0, 0.0, 0.0), altitude_m=100.0, time_s=0.0):
    latitude_deg, longitude_deg = FRAME.degrees(Point(north_m, east_m))
    truth = replace(
        TRUTH, latitude_deg=latitude_deg, longitude_deg=longitude_deg, altitude_m=altitude_m
    )
    return Sample(time_s, truth, wander_m, "LOITER", STATE, PathDemand(path, 98.0))


def test_a_leg_is_judged_by_the_commanded_line_not_by_the_one_that_fits_best():
    # It flies straight, 10 m to the right of a line to the east.
    leg = [sample(-10.0, east_m, Line(Point(0.0, 0.0), 90.0)) for east_m in (0.0, 50.0, 200.0)]
    assert line_errors(leg, 0.0) == pytest.approx([10.0] * 3, abs=1e-6)
    wandered = [sample(-10.0, 50.0, Line(Point(0.0, 0.0), 90.0), wander_m=(4.0, 9.0, 0.0))]
    assert line_errors(wandered, 1.0) == pytest.approx([6.0], abs=1e-6)


def test_the_radius_and_the_height_are_judged_by_what_is_demanded():
    circle = Circle(Point(100.0, 0.0), 50.0)
    circling = [sample(160.0, 0.0, circle, (-3.0, 0.0, -1.5)), sample(100.0, -48.0, circle)]
    assert radius_errors(circling, 0.0) == pytest.approx([10.0, -2.0], abs=1e-6)
    assert radius_errors(circling, 1.0) == pytest.approx([7.0, -2.0], abs=1e-6)
    assert height_errors(circling, 0.0) == pytest.approx([2.0, 2.0])
    assert height_errors(circling, 1.0) == pytest.approx([0.5, 2.0])


def test_a_leg_with_another_path_in_it_meets_no_target():
    mixed = [sample(0.0, 0.0, Line(Point(0.0, 0.0), 0.0)), sample(0.0, 0.0, Bank(10.0))]
    assert rms(line_errors(mixed, 0.0)) == math.inf


@pytest.mark.parametrize(
    ("what", "values", "text", "met"),
    [
        ("height rms, GPS frame", (1.0, 2.4, 1.1), "1.50, worst 2.40 (seed 8)", True),
        ("height rms, GPS frame", (1.0, 4.0, 1.0), "2.00, worst 4.00 (seed 8)", False),
        ("position error after 30 s without fixes", (1, 31, 1), "worst 31.00 (seed 8)", False),
        ("RETURN, least airspeed over stall", (1.3, 1.4, 1.19), "worst 1.19 (seed 9)", False),
        ("RETURN, least airspeed over stall", (1.3, 1.4, 1.21), "worst 1.21 (seed 9)", True),
    ],
)
def test_a_row_names_the_worst_seed_and_judges_the_mean_or_the_worst(what, values, text, met):
    assert what in TARGETS
    (row,) = rows_of("arduino, calm", [7, 8, 9], [{what: value} for value in values])
    assert text in row.ours
    assert row.met is met


def test_a_code_that_is_never_logged_is_infinitely_late():
    flown = Flown([], [(3.0, "motor_without_thrust"), (12.5, "motor_without_thrust")], None, [])
    assert flown.after("motor_without_thrust", 10.0) == 2.5
    assert flown.after("motor_without_thrust", 13.0) == math.inf


def test_random_flights_are_counted_with_the_seeds_that_fail():
    good = Outcome(1, "", None, 1.3, False, 2.0, 0)
    bad = Outcome(2, "drawn", "hit the ground", 0.9, True, 120.0, 1)
    rows = {row.what: row for row in random_rows([good, bad])}
    for what in ("crashes", "stalls", "fly-aways", "overruns"):
        row = rows[f"2 random flights, {what}"]
        assert (row.ours, row.met) == ("1 (seeds 2)", False)
    assert "0.90 (seed 2" in rows["2 random flights, least airspeed over stall"].ours
    assert all(row.met is not False for row in random_rows([good]))
