"""The first line of a connection."""

import json
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from up.system.aircraft_name import AIRCRAFT_NAME
from up_proxy.hello import (
    CODES,
    HELLO_MAX_BYTES,
    Hello,
    HelloError,
    SeatKind,
    Side,
    error_line,
    ok_line,
    parse_hello,
)

VECTORS = json.loads(
    (Path(__file__).parents[1] / "vectors" / "proxy_hello.json").read_text(encoding="utf-8")
)["vectors"]
SIDES = {"air": Side.AIRBORNE, "ground": Side.GROUND}


@pytest.mark.parametrize("vector", VECTORS, ids=lambda vector: vector["line"][:40])
def test_golden_vectors(vector):
    line, side = vector["line"].encode("ascii"), SIDES[vector["side"]]
    if "error" in vector:
        with pytest.raises(HelloError) as refused:
            parse_hello(line, side)
        assert refused.value.code == vector["error"]
        return
    hello = parse_hello(line, side)
    assert hello.aircraft == vector["aircraft"]
    assert hello.token == vector["token"]
    assert (hello.seat and hello.seat.value) == vector["seat"]


def test_a_ground_that_names_no_seat_asks_to_command():
    assert parse_hello(b"UP1 aircraft=a\n", Side.GROUND).seat is SeatKind.COMMAND


@pytest.mark.parametrize(
    "line",
    [
        b"",
        b"\n",
        b"UP1\n",
        b"UP1 \n",
        b"UP1  aircraft=a\n",
        b"UP1 aircraft=a \n",
        b"UP1 aircraft=a aircraft=b\n",
        b"UP1 aircraft=a\x00\n",
        b"UP1 aircraft=a word\n",
        b"UP1 aircraft=a =1\n",
        b"UP1 aircraft=a x=\x07\n",
        b"UP1 aircraft=" + b"a" * 33 + b"\n",
        b"UP1 aircraft=\xc3\xa9\n",
        b"UP1 aircraft=a token=" + b"0" * 31 + b"\n",
        b"UP1 aircraft=a token=" + b"0" * 65 + b"\n",
        b"UP1 aircraft=a token=" + b"g" * 32 + b"\n",
        b"UP1 aircraft=a x=" + b"y" * HELLO_MAX_BYTES + b"\n",
        b"up1 aircraft=a\n",
    ],
)
@pytest.mark.parametrize("side", list(Side))
def test_malformed(line, side):
    with pytest.raises(HelloError) as refused:
        parse_hello(line, side)
    assert refused.value.code == "malformed"


def test_the_airborne_side_names_no_seat():
    with pytest.raises(HelloError, match="ground port"):
        parse_hello(b"UP1 aircraft=a seat=command\n", Side.AIRBORNE)


def test_the_longest_hello_is_512_bytes_with_its_line_feed():
    start = b"UP1 aircraft=a x="
    assert parse_hello(start + b"y" * (511 - len(start)) + b"\n", Side.GROUND).aircraft == "a"
    with pytest.raises(HelloError):
        parse_hello(start + b"y" * (512 - len(start)) + b"\n", Side.GROUND)


NAMES = st.from_regex(AIRCRAFT_NAME, fullmatch=True)
TOKENS = st.from_regex(r"[0-9a-fA-F]{32,64}", fullmatch=True)


@given(NAMES, st.sampled_from(["command", "listen"]), st.none() | TOKENS)
def test_what_is_well_formed_is_understood(name, seat, token):
    line = f"UP1 aircraft={name} seat={seat}" + (f" token={token}" if token else "") + "\n"
    expected = Hello(name, SeatKind(seat), token and token.lower())
    assert parse_hello(line.encode("ascii"), Side.GROUND) == expected


WORDS = st.sampled_from(
    [b"UP1", b"UP1 ", b"UP2 ", b" ", b"aircraft=", b"seat=", b"token=", b"command", b"listen",
     b"a" * 31, b"0f" * 16, b"=", b"\r", b"\n", b"\x00", b"\xff", b"{", b"x=1"]
)  # fmt: skip
LINES = st.one_of(st.binary(max_size=600), st.lists(WORDS | st.binary(max_size=4)).map(b"".join))


@settings(max_examples=2000, deadline=None)
@given(LINES, st.sampled_from(list(Side)))
def test_any_bytes_give_a_hello_or_a_refusal_of_one_line(line, side):
    try:
        hello = parse_hello(line, side)
    except HelloError as error:
        answer = error_line(error)
        assert answer.startswith(b"UP1 error code=malformed reason=")
        assert answer.count(b"\n") == 1
        assert answer.endswith(b'"\n')
        assert error.code in CODES
    else:
        assert 1 <= len(hello.aircraft) <= 32
        assert ok_line(hello.aircraft, SeatKind.AIR, "0" * 32).isascii()
