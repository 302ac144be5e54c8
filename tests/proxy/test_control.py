"""Control lines, and how they differ from relayed ones."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from up_proxy import control
from up_proxy.control import SeatGive, SeatRelease, SeatRequest, parse_control, without_control


@pytest.mark.parametrize(
    ("line", "meaning"),
    [
        (b"UP1 seat request\n", SeatRequest()),
        (b"UP1 seat request\r\n", SeatRequest()),
        (b"UP1 seat release\n", SeatRelease()),
        (b"UP1 seat give to=12\n", SeatGive(12)),
        (b"UP1 seat give to=\n", None),
        (b"UP1 seat give to=-1\n", None),
        (b"UP1 seat give to=1234567890\n", None),
        (b"UP1 seat give to=1 2\n", None),
        (b"UP1 seat command token=0\n", None),
        (b"UP1 \n", None),
    ],
)
def test_what_a_ground_may_ask(line, meaning):
    assert parse_control(line) == meaning


def test_lines_of_the_proxy():
    assert control.asked_line(3) == b"UP1 seat asked by=3\n"
    assert control.command_line("ab") == b"UP1 seat command token=ab\n"
    assert control.holder_line(4) == b"UP1 seat holder=4\n"
    assert control.holder_line(None) == b"UP1 seat holder=none\n"


@given(st.binary(max_size=100))
def test_parsing_never_raises(line):
    parse_control(line)


PIECES = st.sampled_from([b"UP1 ", b"UP1", b"\r", b"\n", b"x UP1 ", b"{}", b""])


@given(st.lists(PIECES | st.binary(max_size=5)).map(b"".join))
def test_lines_are_told_apart_by_their_beginning_alone(text):
    lines = text + b"\n"
    relayed, found = without_control(lines)
    every = [line + b"\n" for line in lines.split(b"\n")[:-1]]
    assert found == [line for line in every if line.startswith(b"UP1 ")]
    assert relayed == b"".join(line for line in every if not line.startswith(b"UP1 "))
