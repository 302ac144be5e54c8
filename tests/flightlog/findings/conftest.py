"""Flights for the checks."""

import pytest

from tests.flightlog.flights import (
    FlightMaker,
)
from up_flightlog.findings.all_checks import findings


@pytest.fixture
def maker():
    return FlightMaker()


@pytest.fixture
def found(maker, tmp_path):
    """Return a function that analyses the flight: time, level, code and length of each finding."""

    def found(is_finished=True):
        return [
            (round(each.time_s, 1), each.level, each.code, round(each.length_s, 2))
            for each in findings(maker.log(tmp_path, is_finished))
        ]

    return found


@pytest.fixture
def only(maker, tmp_path):
    """Return a function that analyses the flight and returns its single finding."""

    def only():
        (finding,) = findings(maker.log(tmp_path))
        return finding

    return only
