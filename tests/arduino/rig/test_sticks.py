"""The stick scripts of ``--sticks``."""

import itertools

from hypothesis import given
from hypothesis import strategies as st

from up_rig.sticks import SticksError, read_sticks


@given(
    st.lists(
        st.one_of(
            st.text(max_size=12),
            st.tuples(
                st.sampled_from(["t", "aileron", "aux2", "receiver", "throttle", ""]),
                st.sampled_from(["1500", "on", "off", "-1", "1e9", "nan", "9" * 5000, "²", ""]),
            ).map("=".join),
        ),
        max_size=6,
    )
)
def test_any_script_is_read_or_refused_in_one_sentence(words):
    try:
        moves = read_sticks(" ".join(words))
    except SticksError as error:
        assert str(error).startswith("sticks: ")
    else:
        assert all(earlier.time_s <= later.time_s for earlier, later in itertools.pairwise(moves))
