from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

from up_simulator.harness.uplink import UplinkError, read_link
from up_simulator.link.model import LinkSettings


def test_words_become_a_link():
    assert read_link("delay=80 jitter=20, loss=1.5 rate=20000") == LinkSettings(80, 20, 1.5, 20000)
    assert read_link("") == LinkSettings()


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("delay", "'delay'"),
        ("lag=3", "'lag=3'"),
        ("loss=95", "loss=95:"),
        ("delay=nan", "delay=nan:"),
        ("rate=-1", "rate=-1:"),
    ],
)
def test_an_invalid_link_is_refused_by_its_word(text, word):
    with pytest.raises(UplinkError) as caught:
        read_link(text)
    assert word in str(caught.value) and "\n" not in str(caught.value)


@given(st.text(max_size=40) | st.from_regex(r"(delay|loss|rate)=[-+.eEinf0-9_]{0,9}"))
def test_any_text_is_a_link_or_refused(text):
    with suppress(UplinkError):
        assert isinstance(read_link(text), LinkSettings)
