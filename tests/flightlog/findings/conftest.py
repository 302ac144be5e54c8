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
    def found(is_finished=True):
        return [
            (round(each.time_s, 1), each.level, each.code, round(each.length_s, 2))
            for each in findings(maker.log(tmp_path, is_finished))
        ]

    return found


@pytest.fixture
def only(maker, tmp_path):
    def only():
        (finding,) = findings(maker.log(tmp_path))
        return finding

    return only
