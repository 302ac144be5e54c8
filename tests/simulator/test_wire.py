import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.simulator.pi import frame, vectors
from up_simulator.wire import (
    COMMAND_SIZES,
    LONGEST_ENCODED,
    CheckedReader,
    Command,
    Odd,
    ThesisReader,
    checked_frame,
    cobs_decode,
    cobs_encode,
    crc16,
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


@pytest.mark.parametrize("vector", vectors("crc16.json"))
def test_crc_is_that_of_the_vectors(vector):
    assert crc16(bytes.fromhex(vector["bytes"])) == int(vector["crc"], 16)


@pytest.mark.parametrize("vector", vectors("cobs.json"))
def test_cobs_is_that_of_the_vectors(vector):
    plain, encoded = bytes.fromhex(vector["plain"]), bytes.fromhex(vector["encoded"])
    assert cobs_encode(plain) == encoded
    assert cobs_decode(encoded) == plain


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
    assert [each for each in found if isinstance(each, Command)] == []
    assert reader.dropped >= 1
    good = list(reader.feed(bytes.fromhex("070568012cdc9000"), 0.0))
    assert good == [Command("h", bytes.fromhex("012c"), 5)]


@pytest.mark.parametrize("vector", vectors("serial_thesis.json"))
def test_thesis_commands_are_those_of_the_vectors(vector):
    if vector["direction"] == "to_arduino":
        command = Command(vector["type"], bytes.fromhex(vector["payload"]))
        assert list(ThesisReader().feed(bytes.fromhex(vector["wire"]), 0.0)) == [command]


@given(st.binary(max_size=600))
def test_cobs_comes_back_and_holds_no_zero(plain):
    encoded = cobs_encode(plain)
    assert 0 not in encoded
    assert cobs_decode(encoded) == plain


@given(st.binary(max_size=300))
def test_any_bytes_are_decoded_or_refused(encoded):
    plain = cobs_decode(encoded)
    assert plain is None or len(plain) <= len(encoded)


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
    found = [each for each in CheckedReader().feed(bytes(wire), 0.0) if isinstance(each, Command)]
    assert command not in found
    assert found == []


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
    assert len(reader._buffer) <= LONGEST_ENCODED
    assert list(reader.feed(b"\0", 0.0)) == []
    assert reader.dropped == 1


def test_gaps_in_the_sequence_are_counted_and_cost_nothing():
    reader = CheckedReader()
    stream = b"".join(wire_of(Command("s", b"", number)) for number in (254, 255, 0, 3))
    assert len(list(reader.feed(stream, 0.0))) == 4
    assert reader.missing == 2


def test_what_a_right_check_protects_wrongly_is_named():
    reader = CheckedReader()
    found = list(reader.feed(checked_frame(5, "Z") + checked_frame(6, "h", b"\x01"), 0.0))
    found += reader.feed(checked_frame(7, "s"), 0.0)
    assert found == [Odd(ord("Z"), 5, 1), Odd(ord("h"), 6, 2), Command("s", b"", 7)]
    assert (reader.dropped, reader.missing) == (2, 0)


def test_thesis_drops_an_unknown_byte_alone():
    reader = ThesisReader()
    assert list(reader.feed(b"\xffT", 0.0)) == [0xFF, Command("T", b"")]
    assert reader.dropped == 1


def test_thesis_drops_an_unfinished_command_after_100_ms():
    reader = ThesisReader()
    assert list(reader.feed(b"h\x01", 0.0)) == []
    assert not reader.expire(0.099)
    assert reader.expire(0.1)
    assert list(reader.feed(b"T", 0.2)) == [Command("T", b"")]


@given(st.binary(max_size=300))
def test_thesis_reads_any_bytes(data):
    reader = ThesisReader()
    for found in reader.feed(data, 0.0):
        assert isinstance(found, int) or len(found.payload) == COMMAND_SIZES[found.type]
