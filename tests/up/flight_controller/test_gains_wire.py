import math
import struct
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from up.flight_controller.gains_wire import pack_gains, read_gains, without_rudder

GAIN = st.floats(min_value=0, max_value=50, width=32)


@given(st.lists(GAIN, min_size=18, max_size=18), st.sampled_from([12, 18]))
def test_the_gains_of_two_or_three_axes_come_back_bit_for_bit(values, size):
    payload = struct.pack(f">{size}f", *(abs(each) for each in values[:size]))
    gains = read_gains(payload)
    assert gains.has_rudder is (size == 18)
    assert pack_gains(gains) == payload


@given(st.integers(0, 5000))
def test_a_gain_that_was_typed_is_shown_as_it_was_typed(hundredths):
    typed = hundredths / 100
    assert read_gains(struct.pack(">12f", *[typed] * 12)).rate.ailerons.p == typed


@pytest.mark.parametrize("bad", [math.nan, math.inf, -0.001, 50.01])
@pytest.mark.parametrize("place", range(18))
def test_a_set_with_one_gain_out_of_range_is_refused_whole(bad, place):
    values = [1.0] * 18
    values[place] = bad
    with pytest.raises(ValueError, match="not within 0 to 50"):
        read_gains(struct.pack(">18f", *values))


@pytest.mark.parametrize("bad", [math.nan, math.inf, -0.001, 50.01])
def test_a_set_out_of_range_is_never_packed(bad):
    good = read_gains(struct.pack(">18f", *[1.0] * 18))
    rate = replace(good.rate, elevator=replace(good.rate.elevator, d=bad))
    with pytest.raises(ValueError, match="not within 0 to 50"):
        pack_gains(replace(good, rate=rate))


def test_a_set_with_half_a_rudder_is_never_packed():
    good = read_gains(struct.pack(">18f", *[1.0] * 18))
    with pytest.raises(ValueError, match="not complete"):
        pack_gains(replace(good, stabilize=replace(good.stabilize, rudder=None)))


def test_the_two_axis_form_leaves_the_rudder_out():
    good = read_gains(struct.pack(">18f", *range(18)))
    values = struct.unpack(">12f", pack_gains(without_rudder(good)))
    assert values == (0, 1, 2, 3, 4, 5, 9, 10, 11, 12, 13, 14)
