"""The client protocol of NATS."""

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from up_cluster import nats_protocol as nats

GOLDEN = (
    b'INFO {"server_name":"s0","headers":true}\r\n'
    b"+OK\r\nPING\r\nPONG\r\n"
    b"MSG up.t.a.down 7 5\r\na\r\nbc\r\n"
    b"MSG up.t.a.up 8 _INBOX.x.1 0\r\n\r\n"
    b"HMSG $KV.b.k 9 12 14\r\nNATS/1.0\r\n\r\nok\r\n"
    b"-ERR 'Authorization Violation'\r\n"
)
EVENTS = [
    nats.Info({"server_name": "s0", "headers": True}),
    nats.Ping(),
    nats.Pong(),
    nats.Message("up.t.a.down", 7, "", b"", b"a\r\nbc"),
    nats.Message("up.t.a.up", 8, "_INBOX.x.1", b"", b""),
    nats.Message("$KV.b.k", 9, "", b"NATS/1.0\r\n\r\n", b"ok"),
    nats.Failed("Authorization Violation"),
]


@given(st.lists(st.integers(0, len(GOLDEN)), max_size=8), st.booleans())
def test_golden_bytes_in_any_pieces(cuts, takes_payloads):
    taken = []
    # Of sid 8 the message has a reply, of sid 9 a header: both stay events.
    payloads = dict.fromkeys((b"7", b"8", b"9"), taken.append) if takes_payloads else {}
    found = []
    parser = nats.NatsParser(found.append, payloads)
    edges = [0, *sorted(cuts), len(GOLDEN)]
    for begin, end in pairwise(edges):
        parser.feed(GOLDEN[begin:end])
    assert taken == [b"a\r\nbc"] * takes_payloads
    assert found == EVENTS[:3] + EVENTS[3:4] * (not takes_payloads) + EVENTS[4:]


@given(
    st.lists(
        st.binary(max_size=200)
        | st.binary(max_size=20).map(lambda size: b"MSG a 1 %b\r\nab\r\n" % size),
        max_size=20,
    )
)
def test_any_bytes_are_events_or_a_code(pieces):
    parser = nats.NatsParser(lambda event: None, {b"1": lambda payload: None})
    try:
        for piece in pieces:
            parser.feed(piece)
    except nats.NatsProtocolError as error:
        assert error.code in ("nats_malformed", "nats_too_long")


@pytest.mark.parametrize(
    ("line", "code"),
    [
        (b"MSG a 1 x\r\n", "nats_malformed"),
        (b"MSG a 1\r\n", "nats_malformed"),
        (b"MSG a b c d 3\r\n", "nats_malformed"),
        (b"MSG a 1 -1\r\n", "nats_malformed"),
        (b"HMSG a 1 5 4\r\n", "nats_malformed"),
        (b"MSG a 1 3\r\nabcd\r\n", "nats_malformed"),
        (b"MSG a 1 %b\r\n" % (b"9" * 5000), "nats_malformed"),
        (b"INFO [1]\r\n", "nats_malformed"),
        (b"HELLO\r\n", "nats_malformed"),
        (b"MSG a 1 9999999999\r\n", "nats_too_long"),
        (b"x" * (nats.MAX_LINE_BYTES + 1), "nats_too_long"),
    ],
)
@pytest.mark.parametrize("payloads", [{}, {b"1": pytest.fail}], ids=["messages", "payloads"])
def test_malformed_lines(line, code, payloads):
    with pytest.raises(nats.NatsProtocolError) as caught:
        nats.NatsParser(pytest.fail, payloads).feed(line)
    assert caught.value.code == code


def test_golden_bytes_of_a_client():
    assert nats.connect({"verbose": False}) == b'CONNECT {"verbose":false}\r\n'
    assert nats.subscribe("up.t.*", 3) == b"SUB up.t.* 3\r\n"
    assert nats.unsubscribe(3) == b"UNSUB 3\r\n"
    assert nats.publish("a", b"xy") == b"PUB a 2\r\nxy\r\n"
    assert nats.publish("a", b"", "r.1") == b"PUB a r.1 0\r\n\r\n"
    headers = {"Nats-TTL": "15s"}
    expected = b"HPUB a 27 28\r\nNATS/1.0\r\nNats-TTL: 15s\r\n\r\nx\r\n"
    assert nats.publish("a", b"x", headers=headers) == expected
    assert nats.parse_headers(expected[14:41]) == (0, headers)
    assert nats.parse_headers(b"NATS/1.0 503\r\n\r\n") == (503, {})


@given(st.text(max_size=20), st.text(max_size=20))
def test_no_text_adds_a_line_of_the_protocol(subject, value):
    try:
        frame = nats.publish(subject, b"", headers={"K": value})
    except ValueError:
        return
    size = int(frame.split(b"\r\n")[0].split()[-1])
    assert frame[frame.index(b"\r\n") + 2 :][size:] == b"\r\n"
    assert frame.count(b"\r\n") == 5


@given(st.binary(max_size=80))
def test_any_header_block_is_values_or_a_code(block):
    try:
        status, _ = nats.parse_headers(block)
    except nats.NatsProtocolError as error:
        assert error.code == "nats_malformed"
    else:
        assert 0 <= status < 1000
