import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.up.flight_log.logs import small_log
from up.flight_log.mcap_format import MAGIC
from up.flight_log.resync import find_messages, may_follow

SMALL = small_log()
FIRST = SMALL.index(b'{"roll": 0.0') - 31


def message(size: int = 4) -> bytes:
    return struct.pack("<BQHIQQ", 5, 22 + size, 1, 0, 1, 1) + b"x" * size


def test_a_run_of_whole_records_is_found_wherever_it_begins():
    assert find_messages(SMALL, len(MAGIC)) == FIRST
    assert find_messages(b"noise" + SMALL[FIRST:], 0) == 5
    assert find_messages(SMALL, FIRST + 1) > FIRST


def test_one_or_two_lookalikes_are_no_run():
    noise = b"\xee" * 100
    assert find_messages(noise + message() + noise, 0) == -1
    assert find_messages(noise + message() * 2 + noise, 0) == -1
    assert find_messages(noise + message() * 3 + noise, 0) == 100
    assert find_messages(noise + message() * 2 + message()[:-1], 0) == -1


@pytest.mark.parametrize(
    "head",
    [
        struct.pack("<BQ", 5, 21),
        struct.pack("<BQ", 5, 65 * 1024),
        struct.pack("<BQ", 0, 22),
        struct.pack("<BQ", 16, 22),
    ],
)
def test_what_is_no_message_begins_no_run(head):
    assert find_messages(head + bytes(70 * 1024) + message() * 2, 0) == -1


def test_text_is_never_taken_for_records():
    text = b'{"roll": 1.5, "_origin": "arduino (board)"}' * 1000
    assert find_messages(text, 0) == -1
    assert find_messages(bytes(10_000), 0) == -1
    assert find_messages(b"\x05" * 10_000, 0) == -1


def test_what_follows_a_strange_record_must_be_possible():
    assert may_follow(struct.pack("<BQ", 5, 100), 109)
    assert may_follow(struct.pack("<BQ", 5, 100), 50)
    assert may_follow(b"\5\1", 2)
    assert not may_follow(struct.pack("<BQ", 0, 100), 1000)
    assert not may_follow(struct.pack("<BQ", 5, 2**63), 1000)
    assert may_follow(struct.pack("<BQ", 6, 2**30), 2**31)


@given(st.binary(max_size=200), st.integers(0, 200))
def test_any_bytes_are_searched_without_a_fault(data, begin):
    found = find_messages(data, min(begin, len(data)))
    assert found == -1 or data[found] == 5
