"""A line full of Commands never delays the control loop."""

import pytest

from bench.firmware import LATE_US, SERVOS
from bench.firmware import Flight as BusyFlight
from tests.support.firmware import build_firmware


@pytest.mark.parametrize("mix", ["vvvvS", "t", "v", "vvvva"])
def test_the_loop_is_on_time_under_the_worst_mixes(mix):
    flight = BusyFlight(build_firmware(), mix="v", aux1_us=2000, seed=4)
    flight.moving = set(SERVOS)
    assert 0 < flight.latest_us(mix) <= LATE_US
