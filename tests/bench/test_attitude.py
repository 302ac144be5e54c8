"""The flight of make run in fast mode: the attitude stays true, whatever time is skipped."""

import pytest

from bench.attitude import fly, worst
from tests.support.firmware import build_firmware
from up_simulator.firmware.imu_errors import ImuErrors

MAX_DEG = 5.0
"""The benchmark's target is 2 deg; a filter that learns no bias reaches 11 in this flight."""


@pytest.fixture(scope="module", autouse=True)
def firmware():
    build_firmware()


def test_skipped_time_changes_nothing_of_the_flight():
    steady = fly(1, 1, errors=ImuErrors())
    starved = fly(1, 1, is_starved=True, errors=ImuErrors())
    assert [*map(list, starved)] == [pytest.approx(each, abs=0.05) for each in steady]


def test_the_attitude_stays_true_with_a_drifting_gyro_and_skipped_time():
    assert max(worst(fly(2, 3, is_starved=True))) <= MAX_DEG
