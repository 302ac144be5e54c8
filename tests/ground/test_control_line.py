"""The proxy's lines as the ground reads them, against the proxy's own code."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from up.system.aircraft_name import AIRCRAFT_NAME
from up_ground import control_line as ground
from up_ground.settings import Seat
from up_proxy import control as proxy
from up_proxy.hello import HelloError, SeatKind, Side, error_line, ok_line, parse_hello

TOKEN = "0123456789abcdef" * 2


@pytest.mark.parametrize(
    ("line", "meaning"),
    [
        (ok_line("glider", SeatKind.COMMAND, TOKEN), ground.Accepted(Seat.COMMAND, TOKEN)),
        (ok_line("glider", SeatKind.LISTEN, TOKEN), ground.Accepted(Seat.LISTEN, TOKEN)),
        (error_line(HelloError("full", "no room")), ground.Rejected("full", "no room")),
        (proxy.command_line(TOKEN), ground.SeatGained(TOKEN)),
        (proxy.LISTEN, ground.SeatLost()),
        (proxy.asked_line(7), ground.SeatAsked(7)),
        (proxy.holder_line(12), ground.SeatHolder(12)),
        (proxy.holder_line(None), ground.SeatHolder(None)),
        (proxy.ONLINE, ground.AircraftPresence(True)),
        (proxy.OFFLINE, ground.AircraftPresence(False)),
    ],
)
def test_every_line_of_the_proxy_is_understood(line, meaning):
    assert ground.parse_proxy_line(line.rstrip(b"\n")) == meaning


def test_unknown_words_are_ignored():
    line = b"UP1 ok colour=red aircraft=a seat=listen token=" + TOKEN.encode()
    assert ground.parse_proxy_line(line) == ground.Accepted(Seat.LISTEN, TOKEN)


@pytest.mark.parametrize(
    "line",
    [
        b"UP1 ",
        b"UP1 ok seat=command token=short",
        b"UP1 ok seat=air token=" + TOKEN.encode(),
        b"UP1 seat command token=xyz",
        b"UP1 seat asked by=-1",
        b"UP1 seat asked by=99999999999",
        b"UP1 seat holder=1\x1b[2J",
        b"UP1 aircraft maybe",
        b"UP1 dance",
        b"UP1 \xff",
    ],
)
def test_other_lines_say_nothing(line):
    assert ground.parse_proxy_line(line) is None


@given(st.binary(max_size=200).map(lambda tail: b"UP1 " + tail))
def test_no_line_breaks_it(line):
    said = ground.parse_proxy_line(line)
    if isinstance(said, ground.Rejected):
        assert said.reason.isprintable() or said.reason == ""


@given(
    st.from_regex(AIRCRAFT_NAME, fullmatch=True),
    st.sampled_from(Seat),
    st.none() | st.just(TOKEN),
)
def test_the_proxy_understands_our_hello(aircraft, seat, token):
    hello = parse_hello(ground.hello_line(aircraft, seat, token), Side.GROUND)
    assert (hello.aircraft, hello.seat.value, hello.token) == (aircraft, seat.value, token)


def test_the_proxy_understands_what_we_ask():
    assert proxy.parse_control(ground.SEAT_REQUEST) == proxy.SeatRequest()
    assert proxy.parse_control(ground.SEAT_RELEASE) == proxy.SeatRelease()
    assert proxy.parse_control(ground.give_line(3)) == proxy.SeatGive(3)
