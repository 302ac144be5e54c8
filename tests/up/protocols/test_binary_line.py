"""Binary lines: any data come back as they were, and no line has an LF within."""

import contextlib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from up.protocols.binary_line import TYPES, to_body, to_line

BINARY = st.builds(
    lambda first, rest: bytes((first,)) + rest, st.sampled_from(sorted(TYPES)), st.binary()
)


@given(BINARY)
def test_binary_data_come_back_and_have_no_line_end(body):
    line = to_line(body)
    assert line.index(b"\n") == len(line) - 1
    assert to_body(line[:-1]) == body


def test_json_is_a_line_as_it_is():
    assert to_line(b'{"a": "\x1b"}') == b'{"a": "\x1b"}\n'
    assert to_body(b'{"a": "\x1b"}') == b'{"a": "\x1b"}'


def test_what_is_escaped():
    assert to_line(b"\x01a\nb\x1bc") == b"\x01a\x1bJb\x1b[c\n"


@pytest.mark.parametrize("line", [b"\x01\x1b", b"\x02a\x1bxb", b"\x01\x1b\x1b"])
def test_a_wrong_escape_is_refused(line):
    with pytest.raises(ValueError):
        to_body(line)


@given(st.binary())
def test_any_line_is_read_or_refused(line):
    with contextlib.suppress(ValueError):
        to_body(line)
