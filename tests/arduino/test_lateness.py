"""A line full of Commands never delays the control loop."""

import pytest

from bench.firmware import BUSY, LATE_US, SERVOS
from bench.firmware import Flight as BusyFlight
from tests.support.firmware import build_firmware

MIN_UNTOUCHED_RAM = 330


@pytest.mark.parametrize("mix", ["vvvvS", "g", "v", "vvvva"])
def test_the_loop_is_on_time_under_the_worst_mixes(mix):
    flight = BusyFlight(build_firmware(), mix="v", aux1_us=2000, seed=4)
    flight.moving = set(SERVOS)
    assert 0 < flight.latest_us(mix) <= LATE_US


def test_a_slot_that_must_take_its_sample_is_on_time():
    # Among these, a slot that gave its sample up is followed by one that lacks time as well.
    flight = BusyFlight(build_firmware(), mix="v", aux1_us=2000, seed=11)
    flight.moving = set(SERVOS)
    late_us = [flight.latest_us(mix) for mix in ("G", "vvvvG", "vvvve", "G", "vvvvG", "vvvve", "G")]
    assert max(late_us) <= LATE_US


def test_the_stack_leaves_room_at_its_deepest():
    flight = BusyFlight(build_firmware(), mix=BUSY, aux1_us=1500, seed=3)
    for mix in (BUSY, "G", "C"):
        flight.latest_us(mix)
    assert flight.rig.untouched_ram() >= MIN_UNTOUCHED_RAM
