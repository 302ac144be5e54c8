"""Packed telemetry: frames come back, nothing else passes, and memory stays bounded."""

import json
import tracemalloc
import zlib
from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.up.protocols.golden import vectors
from up.protocols.binary_line import PACKED, to_body, to_line
from up.protocols.line_decoder import MAX_LINE_BYTES, LineDecoder
from up.protocols.packed_dictionary import DICTIONARY
from up.protocols.packed_telemetry import (
    KEY_AGE_S,
    PackedError,
    Packer,
    UnknownKeyError,
    Unpacker,
    number_of,
)

FRAMES = st.lists(st.binary(min_size=1, max_size=300), min_size=1, max_size=30)


def raw(data, key=DICTIONARY):
    coder = zlib.compressobj(6, zlib.DEFLATED, -13, 8, 0, key)
    return coder.compress(data) + coder.flush()


def body(data, number=None):
    number = number_of(DICTIONARY) if number is None else number
    return bytes((PACKED,)) + number.to_bytes(3, "big") + data


@pytest.mark.parametrize("vector", vectors("packed_telemetry.json"), ids=lambda v: v["about"])
def test_golden(vector):
    """The bytes are those of zlib 1.2.13; another zlib may pack otherwise, and must read these."""
    unpacker = Unpacker()
    for line, frame in zip(vector["lines"], vector["frames"], strict=True):
        (received,) = LineDecoder().feed(bytes.fromhex(line) + b"\n")
        assert unpacker.unpack(to_body(received)) == frame.encode("ascii")


def test_the_dictionary_is_a_part_of_the_wire():
    assert json.loads(DICTIONARY)["name"] == "up.telemetry.update"
    assert number_of(DICTIONARY) == int(vectors("packed_telemetry.json")[0]["dictionary"], 16)


@given(FRAMES, st.lists(st.floats(0, 2), min_size=30, max_size=30), st.integers(0, 29))
def test_every_frame_comes_back_through_lines(frames, pauses_s, restart_at):
    packer, unpacker, lines = Packer(), Unpacker(), LineDecoder()
    now_s = 0.0
    for index, frame in enumerate(frames):
        now_s += pauses_s[index]
        if index == restart_at:
            packer.restart()
        (line,) = lines.feed(to_line(packer.pack(frame, now_s)))
        assert unpacker.unpack(to_body(line)) == frame


def test_frames_between_keys_can_be_left_out():
    packer, unpacker = Packer(), Unpacker()
    bodies = [packer.pack(b"frame %d" % number, number * 0.031) for number in range(25)]
    keys = {0, 10, 20}
    for number, each in enumerate(bodies):
        assert bool(each[1] & 0x80) is (number in keys)
        if number in keys or number % 3 == 0:
            assert unpacker.unpack(each) == b"frame %d" % number


def test_a_frame_that_changes_much_is_a_key_before_its_time():
    """With a data budget most frames repeat most values: a renewal is paid for once."""
    held, renewed = (bytes(range(low, low + 100)) * 4 for low in (0, 100))
    packer, unpacker, sizes = Packer(), Unpacker(), []
    for number, content in enumerate((held, held, held, renewed, renewed)):
        frame = content + b"%d" % number
        packed = packer.pack(frame, number * KEY_AGE_S / 10)
        sizes.append(len(packed))
        assert unpacker.unpack(packed) == frame
    assert max(sizes[2], sizes[4]) < sizes[3] / 2


def test_a_frame_without_its_key_is_refused_until_a_restart():
    packer, unpacker = Packer(), Unpacker()
    packer.pack(b"lost key", 0.0)
    with pytest.raises(UnknownKeyError):
        unpacker.unpack(packer.pack(b"a", 0.1))
    with pytest.raises(UnknownKeyError):
        unpacker.unpack(packer.pack(b"a key against a lost key", KEY_AGE_S))
    packer.restart()
    assert unpacker.unpack(packer.pack(b"b", 1.2)) == b"b"
    assert unpacker.unpack(packer.pack(b"c", 1.3)) == b"c"


def test_another_aircrafts_key_is_not_taken_for_ours():
    first, second, unpacker = Packer(), Packer(), Unpacker()
    unpacker.unpack(first.pack(b"the key of one run", 0.0))
    second.pack(b"the key of the next run", 0.0)
    with pytest.raises(UnknownKeyError):
        unpacker.unpack(second.pack(b"frame", 0.1))


@pytest.mark.parametrize(
    "data",
    [
        raw(bytes(10_000_000)),
        raw(bytes(MAX_LINE_BYTES)),
        raw(b"whole") + b"more",
        raw(b"cut off")[:-1],
        b"\xff\xff",
        b"",
    ],
    ids=["bomb", "a byte too long", "continued", "cut off", "no deflate", "empty"],
)
def test_what_is_no_frame_is_refused(data):
    unpacker = Unpacker()
    with pytest.raises(PackedError) as refused:
        unpacker.unpack(body(data))
    assert not isinstance(refused.value, UnknownKeyError)
    assert unpacker.unpack(body(raw(bytes(MAX_LINE_BYTES - 1)))) == bytes(MAX_LINE_BYTES - 1)


def test_a_bomb_is_never_inflated_whole():
    bomb = body(raw(bytes(50_000_000)))
    tracemalloc.start()
    try:
        with pytest.raises(PackedError):
            Unpacker().unpack(bomb)
        assert tracemalloc.get_traced_memory()[1] < 1_000_000
    finally:
        tracemalloc.stop()


def test_only_the_newest_key_is_kept():
    packer, unpacker = Packer(), Unpacker()
    for number in range(50):
        unpacker.unpack(packer.pack(bytes([number]) * 9000, 2.0 * number))
    assert len(unpacker._keys) == 2


@given(st.data())
def test_a_changed_frame_is_read_or_refused(data):
    packer, unpacker = Packer(), Unpacker()
    for number in range(3):
        packed = bytearray(packer.pack(DICTIONARY[number:], 0.7 * number))
        for place in data.draw(st.lists(st.integers(0, len(packed) - 1), max_size=3)):
            packed[place] = data.draw(st.integers(0, 255))
        cut = data.draw(st.integers(0, len(packed)))
        with suppress(PackedError):
            assert len(unpacker.unpack(bytes(packed[:cut] if cut % 3 else packed))) < MAX_LINE_BYTES


@given(st.binary(max_size=200))
def test_any_body_is_read_or_refused(junk):
    unpacker = Unpacker()
    for each in (junk, body(junk), body(junk, number_of(DICTIONARY) | 1 << 23)):
        with suppress(PackedError):
            assert len(unpacker.unpack(each)) < MAX_LINE_BYTES
