import unicodedata

import pytest
from hypothesis import given
from hypothesis import strategies as st

from up.sanitize_text import sanitize_text


@pytest.mark.parametrize(
    ("given_text", "shown"),
    [
        ("throttle not low", "throttle not low"),
        ("\x1b[2J", "\\x1b[2J"),
        ("a\r\nb\tc\x00", "a\\r\\nb\\tc\\x00"),
        ("\x9b31m\x7f", "\\x9b31m\\x7f"),
        ("křídlo", "křídlo"),
        ("\u202egnp", "\\u202egnp"),
        ("e\u0301", "e\\u0301"),
        ("\u7ffc", "\\u7ffc"),
        ("\ud800", "\\ud800"),
        (12, "12"),
    ],
)
def test_what_is_shown(given_text, shown):
    assert sanitize_text(given_text) == shown


@given(st.text(), st.integers(1, 60))
def test_every_text_becomes_as_many_columns_as_letters(text, limit):
    shown = sanitize_text(text, limit)
    assert len(shown) <= limit
    assert shown.isprintable() or shown == ""
    for letter in shown:
        assert unicodedata.combining(letter) == 0
        assert unicodedata.east_asian_width(letter) not in "WF"
    shown.encode("utf-8")
