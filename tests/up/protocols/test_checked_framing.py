import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.up.protocols.golden import FROM_ARDUINO, SIZES, TO_ARDUINO, cut, load, places, vectors
from up.protocols.checked_framing import (
    CheckedDecoder,
    CheckedEncoder,
    checked_frame,
    cobs_decode,
    cobs_encode,
    crc16,
)
from up.protocols.framing import make_framing

H = ord("h")
BAD = load("serial_checked_bad.json")
GOOD = bytes.fromhex(BAD["good"])
GOOD_FRAME = (ord("p"), b"\x01\x01\x2c", 5)

frames_of_any_type = st.lists(
    st.sampled_from(sorted(FROM_ARDUINO)).flatmap(
        lambda type_: st.tuples(
            st.just(type_), st.binary(min_size=FROM_ARDUINO[type_], max_size=FROM_ARDUINO[type_])
        )
    ),
    max_size=8,
)


def decoder():
    return CheckedDecoder(TO_ARDUINO)


@pytest.mark.parametrize("vector", vectors("cobs.json"), ids=lambda v: v["plain"][:16])
def test_cobs_is_as_the_vectors_say(vector):
    plain, encoded = bytes.fromhex(vector["plain"]), bytes.fromhex(vector["encoded"])
    # A frame has at most 100 bytes; the code of a full run is for longer data.
    if len(plain) < 254:
        assert cobs_encode(plain) == encoded
        assert cobs_decode(encoded) == plain


@pytest.mark.parametrize("vector", vectors("crc16.json"), ids=lambda v: v["bytes"][:16])
def test_crc_is_as_the_vectors_say(vector):
    assert crc16(bytes.fromhex(vector["bytes"])) == int(vector["crc"], 16)


@given(st.binary(max_size=253))
def test_any_bytes_are_encoded_without_zero_and_decoded(plain):
    encoded = cobs_encode(plain)
    assert 0 not in encoded
    assert len(encoded) == len(plain) + 1
    assert cobs_decode(encoded) == plain


@given(st.binary(min_size=1, max_size=254))
def test_any_bytes_decode_or_are_refused(data):
    plain = cobs_decode(data)
    assert plain is None or cobs_encode(plain) == data


@pytest.mark.parametrize("encoded", ["05", "0300", "00", "0200", "ff01"])
def test_broken_cobs_is_refused(encoded):
    assert cobs_decode(bytes.fromhex(encoded)) is None


@pytest.mark.parametrize(
    "vector", vectors("serial_checked.json"), ids=lambda v: f"{v['direction']}-{v['type']}"
)
def test_frames_are_as_the_vectors_say(vector):
    wire, payload = bytes.fromhex(vector["wire"]), bytes.fromhex(vector["payload"])
    encoder = CheckedEncoder()
    for _ in range(vector["sequence"]):
        encoder.encode(H, b"\0\0")
    assert encoder.encode(ord(vector["type"]), payload) == wire
    assert encoder.last_sequence == vector["sequence"]
    frames = CheckedDecoder(SIZES[vector["direction"]]).feed(wire)
    assert frames == [(ord(vector["type"]), payload, vector["sequence"])]


@pytest.mark.parametrize("vector", BAD["vectors"], ids=lambda v: v["why"])
def test_a_bad_frame_is_dropped_and_counted_and_harms_no_good_one(vector):
    line = decoder()
    assert line.feed(bytes.fromhex(vector["wire"]) + GOOD) == [GOOD_FRAME]
    counters = line.counters
    assert counters.frames == 1
    assert counters.crc_errors + counters.format_errors + counters.unknown_types >= 1


def test_each_fault_has_its_counter():
    line = decoder()
    line.feed(bytes.fromhex("070569012cdc9000"))
    assert line.counters.crc_errors == 1
    line.feed(bytes.fromhex("05055a194500"))
    assert line.counters.unknown_types == 1
    line.feed(bytes.fromhex("06056801b5ce00"))
    assert line.counters.format_errors == 1
    line.feed(bytes.fromhex("0500"))
    assert line.counters.format_errors == 2


def test_the_sequence_counts_round_and_an_encoder_refuses_what_fits_no_frame():
    encoder = CheckedEncoder()
    assert encoder.last_sequence == 255
    line = decoder()
    sequences = [line.feed(encoder.encode(H, b"\0\0"))[0][2] for _ in range(300)]
    assert sequences == [number % 256 for number in range(300)]
    assert line.counters.lost_by_sequence == 0
    with pytest.raises(ValueError, match="97 bytes"):
        encoder.encode(H, bytes(97))


def test_a_gap_in_the_sequence_counts_what_was_lost_but_drops_nothing():
    line = decoder()
    for sequence in (250, 254, 2, 2):
        assert len(line.feed(checked_frame(sequence, H, b"ab"))) == 1
    assert line.counters.lost_by_sequence == 3 + 3 + 255


def test_a_frame_of_unknown_type_did_arrive():
    line = decoder()
    line.feed(
        checked_frame(0, H, b"ab") + checked_frame(1, ord("Z"), b"") + checked_frame(2, H, b"ab")
    )
    assert line.counters.lost_by_sequence == 0


def test_empty_frames_are_ignored():
    line = decoder()
    assert line.feed(b"\0\0\0" + GOOD + b"\0\0") == [GOOD_FRAME]
    assert line.counters.format_errors == 0
    assert CheckedEncoder().opening == b"\0"


def test_the_longest_frame_passes_and_a_longer_one_does_not():
    line = CheckedDecoder({1: 96, 2: 97})
    longest = checked_frame(0, 1, bytes(range(1, 97)))
    assert len(longest) == 102
    assert len(line.feed(longest)) == 1
    assert line.feed(checked_frame(1, 2, bytes(97)) + GOOD) == []
    assert line.counters.format_errors == 1


def test_a_frame_without_end_is_dropped_while_it_streams_by():
    line = decoder()
    for _ in range(1000):
        assert line.feed(b"\x55" * 1000) == []
        assert len(line._tail) <= 101
    assert line.feed(b"\x55\x55\0" + GOOD) == [GOOD_FRAME]
    assert line.counters.format_errors == 1


def test_an_unfinished_frame_is_dropped_100_ms_after_its_newest_byte():
    line = decoder()
    line.feed(GOOD[:3], 10.0)
    line.expire(10.09)
    line.feed(GOOD[3:5], 10.09)
    line.expire(10.18)
    assert line.counters.timeouts == 0
    line.expire(10.191)
    assert line.counters.timeouts == 1
    line.expire(11.0)
    assert line.counters.timeouts == 1
    assert line.feed(GOOD, 11.0) == [GOOD_FRAME]
    assert line.counters.crc_errors == line.counters.format_errors == 0


@given(st.floats(0, 1e9))
def test_a_timer_for_the_end_of_the_100_ms_finds_it_reached(heard):
    line = decoder()
    line.feed(GOOD[:3], heard)
    line.expire(heard + 0.1)
    assert line.counters.timeouts == 1


def test_silence_ends_the_dropping_of_a_frame_without_end():
    line = decoder()
    line.feed(b"\x55" * 500, 1.0)
    line.expire(1.2)
    assert line.feed(GOOD, 1.3) == [GOOD_FRAME]


def test_nothing_survives_a_reopened_line():
    line = decoder()
    line.feed(checked_frame(7, H, b"ab") + GOOD[:4])
    line.reset()
    assert line.feed(GOOD[4:]) == []
    assert line.feed(checked_frame(99, H, b"ab")) == [(H, b"ab", 99)]
    assert line.counters.lost_by_sequence == 0
    assert line.counters.frames == 2


@given(frames_of_any_type, places)
def test_any_chunking_gives_the_same_frames(frames, cuts):
    encoder, line = make_framing("checked", FROM_ARDUINO)
    wire = encoder.opening + b"".join(encoder.encode(*frame) for frame in frames)
    expected = [(type_, payload, number) for number, (type_, payload) in enumerate(frames)]
    assert [frame for piece in cut(wire, cuts) for frame in line.feed(piece)] == expected
    assert line.counters.frames == len(frames)


@given(st.binary(max_size=400), places)
def test_any_bytes_in_any_chunking_end_the_same(data, cuts):
    whole, pieces = decoder(), decoder()
    expected = whole.feed(data)
    assert [frame for piece in cut(data, cuts) for frame in pieces.feed(piece)] == expected
    assert len(pieces._tail) <= 101
    assert whole.counters.frames == pieces.counters.frames
    assert whole.counters.crc_errors == pieces.counters.crc_errors


@given(st.binary(max_size=300), places)
def test_garbage_between_good_frames_loses_at_most_one(garbage, cuts):
    line = decoder()
    wire = (
        checked_frame(1, H, b"ab")
        + garbage
        + checked_frame(2, H, b"cd")
        + checked_frame(3, H, b"ef")
    )
    frames = [frame for piece in cut(wire, cuts) for frame in line.feed(piece)]
    assert (H, b"ab", 1) in frames
    assert (H, b"ef", 3) in frames


def test_framings_are_made_by_name():
    assert make_framing("thesis", TO_ARDUINO)[0].encode(H, b"ab") == b"hab"


@pytest.mark.parametrize(("size", "frames"), [(19, 0), (20, 1), (22, 1), (40, 1)])
def test_a_type_with_a_least_size_may_be_longer_and_shorter(size, frames):
    reader = CheckedDecoder({ord("x"): 22, H: 2}, {ord("x"): 20})
    payload = bytes(range(1, size + 1))
    assert reader.feed(checked_frame(0, ord("x"), payload)) == [(ord("x"), payload, 0)] * frames
    assert reader.feed(checked_frame(1, H, b"\1\2\3")) == []
    assert reader.counters.format_errors == 2 - frames
