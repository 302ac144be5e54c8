"""The attitude compared with the truth of a simulated flight: figures, and findings."""

import math

import pytest

from tests.flightlog.flights import BOARD, PHONE, FlightMaker, OrientationCommand
from up_flightlog.findings.all_checks import findings
from up_flightlog.findings.flight_context import FlightContext
from up_flightlog.findings.summary import summarise

FLOWN_S = 20.0


def flown(folder, true, estimate, late_s=0.0):
    """Return the log of a flight: (roll, pitch) by the time, true and estimated."""
    maker = FlightMaker()
    found = []
    for tick in range(round(FLOWN_S * 50)):
        time_s = tick / 50
        found.append((time_s + late_s, OrientationCommand(*estimate(time_s), 0.0, 0, 0, 0)))
    truth = [(tick / 20, true(tick / 20)) for tick in range(round(FLOWN_S * 20))]
    for time_s, what in sorted([*found, *truth], key=lambda each: each[0]):
        if isinstance(what, tuple):
            maker.add(time_s, "simulator.truth", roll_deg=what[0], pitch_deg=what[1])
        else:
            maker.put(time_s, what, BOARD)
    return maker.log(folder)


def level(time_s):
    return 0.0, 0.0


def rolling(time_s):
    """Up to 100 deg/s."""
    return 50 * math.sin(2 * time_s), 0.0


def test_worst_and_rms_of_each_axis_with_code_and_fields(tmp_path):
    def estimate(time_s):
        return 3.0 if 4 <= time_s < 9 else 0.0, -4.0 if time_s > 15 else -1.0

    log = flown(tmp_path, level, estimate)
    roll, pitch = summarise(log).estimate_errors
    assert (roll.axis, roll.worst_deg, roll.worst_s) == ("roll", 3.0, 4.0)
    assert roll.rms_deg == pytest.approx(1.5, abs=0.02)
    assert (pitch.axis, pitch.worst_deg) == ("pitch", 4.0)
    found = [each for each in findings(log) if each.code == "estimate_error"]
    assert [(each.level, each.time_s, dict(each.fields)) for each in found] == [
        (
            "warning",
            each.worst_s,
            {
                "axis": each.axis,
                "rms_deg": each.rms_deg,
                "worst_deg": each.worst_deg,
                "worst_s": each.worst_s,
            },
        )
        for each in (roll, pitch)
    ]


def test_an_error_up_to_two_degrees_is_not_a_finding(tmp_path):
    log = flown(tmp_path, level, lambda time_s: (2.0, -1.9))
    assert [each.worst_deg for each in FlightContext(log).estimate_errors] == pytest.approx(
        [2.0, 1.9]
    )
    assert [each for each in findings(log)] == []


def test_a_late_estimate_is_not_an_error(tmp_path):
    roll, _ = FlightContext(flown(tmp_path, rolling, rolling, late_s=0.04)).estimate_errors
    assert roll.worst_deg < 0.1
    roll, _ = FlightContext(flown(tmp_path, rolling, rolling, late_s=0.2)).estimate_errors
    assert roll.worst_deg > 10


def test_an_error_across_180_degrees(tmp_path):
    log = flown(tmp_path, lambda time_s: (179.5, 0.0), lambda time_s: (-178.5, 0.0))
    assert [each.worst_deg for each in FlightContext(log).estimate_errors] == [2.0, 0.0]


def test_an_error_of_180_degrees_is_not_zero(tmp_path):
    def upside_down(time_s):
        return 100 * time_s + 180, 0.0

    # The error itself passes 180 deg within the time that is compared.
    roll, _ = FlightContext(
        flown(tmp_path, lambda time_s: (100 * time_s, 0.0), upside_down)
    ).estimate_errors
    assert roll.worst_deg > 170


def test_only_the_selected_source_counts(tmp_path):
    maker = FlightMaker()
    for tick in range(200):
        maker.add(tick / 20, "simulator.truth", roll_deg=0.0, pitch_deg=0.0)
        maker.put(tick / 20, OrientationCommand(1.0, 0.0, 0.0, 0, 0, 0), BOARD)
        maker.put(tick / 20, OrientationCommand(9.0, 0.0, 0.0), PHONE)
    roll, _ = FlightContext(maker.log(tmp_path)).estimate_errors
    assert roll.worst_deg == 1.0


def test_a_flight_without_truth_has_no_errors(tmp_path):
    maker = FlightMaker()
    maker.quiet_flight()
    assert FlightContext(maker.log(tmp_path)).estimate_errors == []
