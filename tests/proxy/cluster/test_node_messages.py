"""Messages between the nodes, and their age."""

import json
import math
from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

from up.protocols.proxy_lines import Access
from up_proxy.cluster import node_messages as messages
from up_proxy.cluster.sender_ages import SETTLE_S, WINDOW_S, SenderAges
from up_proxy.tenant_quota import Usage

GROUND = messages.ListedGround(3, Access.COMMAND, "ab" * 16, True, False, "10.0.0.1", 0.25)


def test_golden_bytes():
    packed = messages.ENVELOPE % (b"n1", 12, 1500, 3, b"x\ny\n")
    assert packed == b"n1 12 1500 3\nx\ny\n"
    assert messages.unpack(packed) == messages.Envelope("n1", 12, 1.5, 3, b"x\ny\n")
    listed = messages.GroundList((GROUND,))
    token = "ab" * 16
    assert listed.encode() == (
        f'{{"grounds":[[3,"command","{token}",1,0,"10.0.0.1",0.25]]}}'.encode()
    )
    beacon = messages.Beacon(True, None, {"n2": [1, 3]})
    assert beacon.encode() == b'{"online":true,"owner":null,"known":{"n2":[1,3]}}'
    line = messages.GroundLine("n2", b"UP1 seat listen\n")
    for each in (listed, beacon, line):
        assert messages.parse(each.encode()) == each
    batch = messages.pack_batch([("a", 7, b"{}"), ("b", 0, b"{}")])
    assert batch == b"a 7 {}\nb 0 {}\n"
    assert list(messages.parse_batch(batch)) == [("a", 7, b"{}"), ("b", 0, b"{}")]
    heartbeat = messages.encode_usage(Usage(2, 3, 400))
    assert heartbeat == b'{"aircraft":2,"grounds":3,"hour_bytes":400}'
    assert messages.parse_usage(heartbeat) == Usage(2, 3, 400)


@given(st.binary(max_size=60))
def test_any_payload_is_an_envelope_or_malformed(payload):
    try:
        found = messages.unpack(payload)
    except messages.MalformedError:
        return
    assert found.fence >= 0 and payload.endswith(found.body)


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=4),
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(
            st.sampled_from(["grounds", "online", "owner", "known", "to", "line"]), inner
        )
    ),
    max_leaves=8,
)


@given(JSON.map(json.dumps).map(str.encode) | st.binary(max_size=40))
def test_any_body_is_a_message_or_malformed(body):
    with suppress(messages.MalformedError):
        messages.parse(body).encode()


@given(
    st.binary(max_size=40)
    | st.lists(st.sampled_from([b"a 1 {}\n", b"a x {}", b"\n"])).map(b"".join)
)
def test_any_batch_has_entries_or_is_malformed(body):
    with suppress(messages.MalformedError):
        entries = list(messages.parse_batch(body))
        assert list(messages.parse_batch(messages.pack_batch(entries))) == entries


@given(
    st.dictionaries(st.sampled_from(Usage._fields), JSON).map(json.dumps).map(str.encode)
    | st.binary(max_size=40)
)
def test_any_heartbeat_is_a_usage_or_malformed(body):
    with suppress(messages.MalformedError):
        assert min(messages.parse_usage(body)) >= 0


@pytest.mark.parametrize("number", [True, -1, 2**53, 1.0, "1", None])
def test_numbers_of_grounds(number):
    words = [number, "listen", "", 0, 0, "h", 0]
    with pytest.raises(messages.MalformedError):
        messages.parse(json.dumps({"grounds": [words]}).encode())


def test_a_new_sender_may_begin_with_old_messages():
    """A partition ends, and its delayed messages come before the next one."""
    ages = SenderAges()
    for sent_s in (1000.0, 1001.0, 1002.0):
        assert ages.age_s("n", sent_s, 2.0) > 2.0
    assert ages.age_s("n", 1000.1, 2.0 + SETTLE_S) == pytest.approx(1.9 + SETTLE_S)
    assert ages.age_s("n", 1002.4, 2.4 + SETTLE_S) == pytest.approx(SETTLE_S)


def test_the_age_needs_no_common_clock():
    ages = SenderAges()
    # The sender's clock is 1,000 s ahead, the fastest delivery takes 1 ms.
    assert ages.age_s("n", 1000.000, 0.003) == math.inf
    assert ages.age_s("n", 1000.999, 1.000) == pytest.approx(0.0)
    assert ages.age_s("n", 1001.000, 1.003) == pytest.approx(0.002)
    assert ages.age_s("n", 1002.000, 15.001) == pytest.approx(13.0)
    # The clocks drift: an offset counts for two windows at most.
    now_s = 15.0
    for _ in range(3):
        now_s += WINDOW_S + 1
        ages.age_s("n", now_s + 900, now_s)
    assert ages.age_s("n", now_s + 900, now_s) == pytest.approx(0.0)
    assert not ages.is_older(2.0, "n", now_s + 899, now_s)
    assert ages.is_older(2.0, "n", now_s + 897, now_s)
    ages.forget(now_s + 2 * WINDOW_S + 1)
    assert len(ages) == 0
    assert ages.is_older(2.0, "n", now_s + 900, now_s)
