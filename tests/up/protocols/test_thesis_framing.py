import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.up.protocols.golden import FROM_ARDUINO, SIZES, cut, places, vectors
from up.protocols.thesis_framing import ThesisDecoder, ThesisEncoder

R = b"r\x05\xdc\x05\xdc\x03\xe8\x05\xdc"
R_FRAME = (ord("r"), R[1:], 0)
OLD_FIRMWARE = {ord(letter): FROM_ARDUINO[ord(letter)] for letter in "ro!TsadhbBlpt"}


def decoder():
    return ThesisDecoder(OLD_FIRMWARE)


@pytest.mark.parametrize(
    "vector", vectors("serial_thesis.json"), ids=lambda v: f"{v['direction']}-{v['type']}"
)
def test_frames_are_as_the_vectors_say(vector):
    wire, payload = bytes.fromhex(vector["wire"]), bytes.fromhex(vector["payload"])
    assert ThesisEncoder().encode(ord(vector["type"]), payload) == wire
    sizes = SIZES[vector["direction"]]
    assert ThesisDecoder(sizes).feed(wire) == [(ord(vector["type"]), payload, 0)]


def test_an_unknown_byte_is_dropped_alone_and_counted():
    line = decoder()
    assert line.feed(b"\xff\x00" + R + b"Z" + R) == [R_FRAME, R_FRAME]
    assert line.counters.unknown_types == 3


def test_an_unfinished_command_is_dropped_after_100_ms():
    line = decoder()
    line.feed(R[:4], 1.0)
    assert line.expire(1.09) == []
    assert line.counters.timeouts == 0
    assert line.expire(1.1) == []
    assert line.counters.timeouts == 1
    assert line.feed(R, 1.2) == [R_FRAME]


def test_an_unfinished_command_is_dropped_when_the_next_byte_comes_late():
    line = decoder()
    line.feed(R[:4], 1.0)
    assert line.feed(R, 1.101) == [R_FRAME]
    assert line.counters.timeouts == 1
    assert line.counters.unknown_types == 0


def test_a_refusal_names_an_unknown_type():
    line = decoder()
    assert line.feed(b"!M" + R) == [(0x21, b"M", 0), R_FRAME]


def test_a_bare_refusal_swallows_no_frame():
    line = decoder()
    assert line.feed(b"!" + R) == [(0x21, b"", 0), R_FRAME]
    assert line.feed(b"!!" + R) == [(0x21, b"", 0), (0x21, b"", 0), R_FRAME]


def test_a_refusal_whose_next_byte_arrives_without_a_full_payload_names_it():
    line = decoder()
    assert line.feed(b"!T", 1.0) == []
    assert line.expire(1.1) == [(0x21, b"T", 0)]
    assert line.feed(R, 1.2) == [R_FRAME]
    assert line.counters.timeouts == 0


def test_a_bare_refusal_at_the_end_is_told_after_the_silence():
    line = decoder()
    assert line.feed(b"!", 1.0) == []
    assert line.expire(1.05) == []
    assert line.expire(1.1) == [(0x21, b"", 0)]
    assert line.counters.timeouts == 0


@pytest.mark.parametrize("letter", "sad")
def test_a_refused_arm_is_never_read_as_armed(letter):
    line = decoder()
    assert line.feed(b"!" + letter.encode() + R) == [(0x21, letter.encode(), 0), R_FRAME]


def test_nothing_survives_a_reopened_line():
    line = decoder()
    line.feed(R[:5])
    line.reset()
    assert line.feed(R) == [R_FRAME]


def test_plain_text_of_an_old_firmware_is_survived():
    line = decoder()
    line.feed(b"FIFO overflow!\r\n" + R * 20, 1.0)
    line.expire(1.2)
    assert line.feed(R * 3, 1.3) == [R_FRAME] * 3


frames_of_any_type = st.lists(
    st.sampled_from(sorted(set(OLD_FIRMWARE) - {0x21})).flatmap(
        lambda type_: st.tuples(
            st.just(type_),
            st.binary(min_size=OLD_FIRMWARE[type_], max_size=OLD_FIRMWARE[type_]),
            st.just(0),
        )
    ),
    max_size=10,
)


@given(frames_of_any_type, places)
def test_any_chunking_gives_the_same_frames(frames, cuts):
    line = decoder()
    wire = b"".join(ThesisEncoder().encode(type_, payload) for type_, payload, _ in frames)
    assert [frame for piece in cut(wire, cuts) for frame in line.feed(piece)] == frames


@given(st.binary(max_size=300), places)
def test_any_bytes_in_any_chunking_end_the_same_and_silence_ends_them(data, cuts):
    whole, pieces = decoder(), decoder()
    expected = whole.feed(data, 1.0) + whole.expire(1.2)
    found = [frame for piece in cut(data, cuts) for frame in pieces.feed(piece, 1.0)]
    assert found + pieces.expire(1.2) == expected
    assert whole.counters == pieces.counters
    assert pieces.feed(R, 1.3) == [R_FRAME]


@given(st.binary(max_size=3000))
def test_little_is_held_whatever_comes(data):
    line = decoder()
    line.feed(data)
    assert len(line._tail) <= 1 + 1 + 48
