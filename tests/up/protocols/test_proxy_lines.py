import json
import random
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from up.protocols.proxy_lines import (
    CODES,
    HELLO_MAX_BYTES,
    Accepted,
    Access,
    AircraftPresence,
    ControlGive,
    ControlGranted,
    ControlLost,
    ControlOwner,
    ControlRelease,
    ControlRequest,
    ControlRequested,
    Hello,
    HelloError,
    KeyRequest,
    Refused,
    Side,
    Watchers,
    parse_hello,
    parse_line,
)
from up.system.aircraft_name import AIRCRAFT_NAME

VECTORS = json.loads(
    (Path(__file__).parents[2] / "vectors" / "proxy_hello.json").read_text(encoding="utf-8")
)["vectors"]
SIDES = {"air": Side.AIRBORNE, "ground": Side.GROUND}
TOKEN = "0123456789abcdef" * 2


@pytest.mark.parametrize("vector", VECTORS, ids=lambda vector: vector["line"][:40])
def test_golden_vectors(vector):
    line, side = vector["line"].encode("ascii"), SIDES[vector["side"]]
    if "error" in vector:
        with pytest.raises(HelloError) as refused:
            parse_hello(line, side)
        assert refused.value.code == vector["error"]
        return
    access = vector["seat"] and Access(vector["seat"])
    reads = (vector.get(each, False) for each in ("packed", "attitude"))
    hello = Hello(vector["aircraft"], access, vector["token"], *reads)
    assert parse_hello(line, side) == hello
    if "future" not in vector["line"]:
        assert hello.encode() == line


def test_a_ground_that_names_no_access_requests_control():
    assert parse_hello(b"UP1 aircraft=a\n", Side.GROUND).access is Access.COMMAND


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
def test_malformed_hellos(line, side):
    with pytest.raises(HelloError) as refused:
        parse_hello(line, side)
    assert refused.value.code == "malformed"


def test_the_airborne_side_names_no_access():
    with pytest.raises(HelloError) as refused:
        parse_hello(b"UP1 aircraft=a seat=command\n", Side.AIRBORNE)
    assert refused.value.code == "malformed"


def test_the_longest_hello_has_512_bytes_with_its_line_feed():
    start = b"UP1 aircraft=a x="
    assert parse_hello(start + b"y" * (511 - len(start)) + b"\n", Side.GROUND).aircraft == "a"
    with pytest.raises(HelloError):
        parse_hello(start + b"y" * (512 - len(start)) + b"\n", Side.GROUND)


NAMES = st.from_regex(AIRCRAFT_NAME, fullmatch=True)
TOKENS = st.from_regex(r"[0-9a-fA-F]{32,64}", fullmatch=True)


@given(NAMES, st.sampled_from([Access.COMMAND, Access.LISTEN]), st.none() | TOKENS)
def test_a_hello_reads_back(name, access, token):
    expected = Hello(name, access, token and token.lower())
    assert parse_hello(Hello(name, access, token).encode(), Side.GROUND) == expected


WORDS = st.sampled_from(
    [b"UP1", b"UP1 ", b"UP2 ", b" ", b"aircraft=", b"seat=", b"token=", b"command", b"listen",
     b"a" * 31, b"0f" * 16, b"=", b"\r", b"\n", b"\x00", b"\xff", b"{", b"x=1"]
)  # fmt: skip
LINES = st.one_of(st.binary(max_size=600), st.lists(WORDS | st.binary(max_size=4)).map(b"".join))


@given(LINES, st.sampled_from(list(Side)))
def test_any_bytes_give_a_hello_or_a_refusal_of_one_line(line, side):
    try:
        hello = parse_hello(line, side)
    except HelloError as error:
        answer = Refused(error.code, error.reason).encode()
        assert parse_line(answer) == Refused("malformed", error.reason)
        assert answer.count(b"\n") == 1
        assert error.code in CODES
    else:
        assert 1 <= len(hello.aircraft) <= 32


SEEDS = (
    b"UP1 aircraft=good seat=command token=00112233445566778899aabbccddeeff\n",
    b"UP1 aircraft=good\n",
    b"UP1 aircraft=other seat=listen x=1\nUP1 seat request\n",
    b'{"name": "up.arm", "data": {}}\n',
)


def mutated(chance):
    """Return a hello with random damage; also for tests over sockets."""
    line = bytearray(chance.choice(SEEDS))
    for _ in range(chance.randrange(1, 6)):
        where = chance.randrange(len(line) + 1)
        what = chance.randrange(4)
        if what == 0:
            line[where:where] = chance.randbytes(chance.choice((1, 2, 8, 600)))
        elif what == 1:
            del line[where : where + chance.randrange(1, 9)]
        elif what == 2 and where < len(line):
            line[where] ^= 1 << chance.randrange(8)
        else:
            line[where:where] = chance.choice((b"\n", b" ", b"=", b"UP1 ", b"token=", b"\0"))
    return bytes(line)


def test_mutated_hellos():
    chance = random.Random(2026)
    accepted = 0
    for _ in range(20_000):
        line = mutated(chance).partition(b"\n")[0] + b"\n"
        for side in Side:
            try:
                parse_hello(line, side)
                accepted += 1
            except HelloError as error:
                assert error.code == "malformed"
    assert 0 < accepted < 40_000


@pytest.mark.parametrize(
    ("line", "message"),
    [
        (f"ok aircraft=g seat=command token={TOKEN}", Accepted("g", Access.COMMAND, TOKEN)),
        (f"ok aircraft=g seat=air token={TOKEN}", Accepted("g", Access.AIR, TOKEN)),
        ('error code=full reason="no room"', Refused("full", "no room")),
        (f"seat command token={TOKEN}", ControlGranted(TOKEN)),
        ("seat listen", ControlLost()),
        ("seat asked by=7", ControlRequested(7)),
        ("seat holder=12", ControlOwner(12)),
        ("seat holder=none", ControlOwner(None)),
        ("aircraft online", AircraftPresence(True)),
        ("aircraft offline", AircraftPresence(False)),
        ("seat request", ControlRequest()),
        ("seat release", ControlRelease()),
        ("seat give to=12", ControlGive(12)),
        ("watch grounds=0 packed=1 attitude=1", Watchers(0, 1, 1)),
        ("watch grounds=12 packed=0 attitude=0", Watchers(12, 0)),
        ("key", KeyRequest()),
    ],
)
def test_every_line_is_written_and_read(line, message):
    line = b"UP1 " + line.encode()
    assert message.encode() == line + b"\n"
    for ending in (b"", b"\n", b"\r\n", b" future=1"):
        assert parse_line(line + ending) == message


def test_unknown_words_of_an_answer_are_ignored():
    line = f"UP1 ok colour=red aircraft=a seat=listen token={TOKEN}"
    assert parse_line(line.encode()) == Accepted("a", Access.LISTEN, TOKEN)


@pytest.mark.parametrize(
    "line",
    [
        b"",
        b"{}",
        b"UP1 ",
        b"UP1 okay",
        b"UP1 ok aircraft=g seat=air",
        b"UP1 ok aircraft=g seat=command token=short",
        b"UP1 ok aircraft=g seat=pilot token=" + TOKEN.encode(),
        b"UP1 error code=x",
        b"UP1 seat command token=xyz",
        b"UP1 seat asked by=-1",
        b"UP1 seat asked by=99999999999",
        b"UP1 seat holder=1\x1b[2J",
        b"UP1 seat give to=",
        b"UP1 seat give to=1234567890",
        b"UP1 seat give to=1 2",
        b"UP1 aircraft maybe",
        b"UP1 watch grounds=-1 packed=1",
        b"UP1 watch grounds=1",
        b"UP1 dance",
        b"UP1 \xff",
    ],
)
def test_other_lines_are_unknown(line):
    assert parse_line(line) is None


@given(st.binary(max_size=200).map(lambda tail: b"UP1 " + tail))
def test_any_bytes_give_a_printable_message_or_none(line):
    message = parse_line(line)
    if isinstance(message, Refused):
        assert message.reason.isprintable()
    if isinstance(message, Accepted | ControlGranted):
        assert set(message.token) <= set("0123456789abcdef")
