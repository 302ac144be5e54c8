"""A number within bounds: as ``max`` and ``min`` have it, also where it is not a number."""

import math

from hypothesis import given
from hypothesis import strategies as st

from raspilot.navigation.limits import limited

BOUNDS = st.tuples(st.floats(allow_nan=False), st.floats(allow_nan=False)).map(sorted)


@given(st.floats(), BOUNDS)
def test_it_is_within_the_bounds(value, bounds):
    lowest, highest = bounds
    assert limited(value, lowest, highest) == max(lowest, min(highest, value))


def test_what_is_not_a_number_is_the_highest():
    assert limited(math.nan, -1.0, 2.0) == 2.0
