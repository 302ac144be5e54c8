import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.simulator.pi import frame, vectors
from up_simulator.firmware.wire import (
    COMMAND_SIZES,
    MAX_ENCODED,
    CheckedReader,
    Command,
    checked_frame,
)

LETTERS = st.sampled_from(sorted(COMMAND_SIZES))


@st.composite
def commands(draw):
    letter = draw(LETTERS)
    size = COMMAND_SIZES[letter]
    payload = draw(st.binary(min_size=size, max_size=size))
    return Command(letter, payload, draw(st.integers(0, 255)))


def wire_of(command):
    return checked_frame(command.sequence, command.type, command.payload)


@pytest.mark.parametrize("vector", vectors("serial_checked.json"))
def test_checked_frames_are_those_of_the_vectors(vector):
    wire, payload = bytes.fromhex(vector["wire"]), bytes.fromhex(vector["payload"])
    command = Command(vector["type"], payload, vector["sequence"])
    assert wire_of(command) == wire
    if vector["direction"] == "to_arduino":
        assert list(CheckedReader().feed(wire, 0.0)) == [command]


@pytest.mark.parametrize("vector", vectors("serial_checked_bad.json"))
def test_a_bad_frame_is_dropped_and_counted_and_the_next_one_read(vector):
    reader = CheckedReader()
    found = list(reader.feed(bytes.fromhex(vector["wire"]), 0.0))
    assert found == []
    assert reader.dropped >= 1
    good = list(reader.feed(bytes.fromhex("08057001012c91c100"), 0.0))
    assert good == [Command("p", bytes.fromhex("01012c"), 5)]


@given(st.lists(commands(), max_size=5), st.data())
def test_frames_are_found_however_they_are_cut(sent, data):
    stream = b"".join(map(wire_of, sent))
    assert stream == b"".join(frame(each.sequence, each.type, each.payload) for each in sent)
    reader, found = CheckedReader(), []
    while stream:
        cut = data.draw(st.integers(1, len(stream)))
        found += reader.feed(stream[:cut], 0.0)
        stream = stream[cut:]
    assert found == sent
    assert reader.dropped == 0


@given(st.binary(max_size=400), commands())
def test_garbage_costs_no_frame_after_its_zero(garbage, command):
    reader = CheckedReader()
    list(reader.feed(garbage + b"\0", 0.0))
    assert list(reader.feed(wire_of(command), 0.0)) == [command]


@given(commands(), st.data())
def test_a_flipped_bit_is_never_taken(command, data):
    wire = bytearray(wire_of(command))
    bit = data.draw(st.integers(0, 8 * (len(wire) - 1) - 1))
    wire[bit // 8] ^= 1 << bit % 8
    assert list(CheckedReader().feed(bytes(wire), 0.0)) == []


def test_an_unfinished_frame_is_dropped_100_ms_after_its_first_byte():
    reader, wire = CheckedReader(), wire_of(Command("s", b"", 1))
    assert list(reader.feed(wire[:3], 1.0)) == []
    reader.expire(1.099)
    assert reader.dropped == 0
    reader.expire(1.1)
    assert reader.dropped == 1
    assert list(reader.feed(wire, 1.2)) == [Command("s", b"", 1)]


def test_a_frame_in_time_is_not_dropped():
    reader, wire = CheckedReader(), wire_of(Command("s", b"", 1))
    assert list(reader.feed(wire[:3], 1.0)) == []
    assert list(reader.feed(wire[3:], 1.09)) == [Command("s", b"", 1)]


def test_a_frame_that_is_too_long_is_dropped_once_and_holds_no_memory():
    reader = CheckedReader()
    assert list(reader.feed(b"\x01" * 1_000_000, 0.0)) == []
    assert len(reader._buffer) <= MAX_ENCODED + 1
    assert list(reader.feed(b"\0", 0.0)) == []
    assert reader.dropped == 1


def test_an_unknown_type_and_a_wrong_size_are_dropped():
    reader = CheckedReader()
    found = list(reader.feed(checked_frame(5, "Z") + checked_frame(6, "h", b"\x01"), 0.0))
    found += reader.feed(checked_frame(7, "s"), 0.0)
    assert found == [Command("s", b"", 7)]
    assert reader.dropped == 2
