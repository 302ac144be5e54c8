"""Frames on the line, as Betaflight sends them, and whatever else comes."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from msp_cog import messages
from msp_cog.codec import MspDecoder, encode

from tests.cogs.msp_cog.recorded import ANSWERS, STREAM
from tests.cogs.msp_cog.rig import reply

NOISE = st.binary(max_size=40).map(lambda data: data.replace(b"$", b"#"))
FRAMES = st.lists(st.tuples(st.integers(0, 255), st.binary(max_size=255)), max_size=6)


def test_requests_byte_for_byte():
    assert encode(messages.VARIANT) == bytes.fromhex("244d3c000202")
    # Ailerons, elevator (down above 1500), throttle, rudder; the checksum last.
    sticks = messages.pack_sticks((1510, 1480, 1300, 1500))
    assert encode(messages.SET_RAW_RC, sticks) == bytes.fromhex("244d3c08c8e605f0051405dc051e")
    with pytest.raises(ValueError, match="255 bytes"):
        encode(200, bytes(255))


def test_what_the_board_sent():
    decoder = MspDecoder()
    wanted = (messages.VARIANT, messages.VERSION, messages.RECEIVER_MAP)
    assert decoder.feed(STREAM) == [(each, ANSWERS[each]) for each in wanted]
    assert (decoder.counters.frames, decoder.counters.dropped_bytes) == (3, 0)


@given(frames=FRAMES, noise=NOISE, pieces=st.lists(st.integers(1, 300), max_size=20))
def test_every_whole_frame_is_found_however_the_bytes_arrive(frames, noise, pieces):
    stream = b"".join(noise + reply(number, payload) for number, payload in frames)
    decoder, found = MspDecoder(), []
    for size in [*pieces, len(stream)]:
        found += decoder.feed(stream[:size])
        stream = stream[size:]
    assert found == frames
    assert decoder.counters.dropped_bytes == len(noise) * len(frames)


@given(st.lists(st.binary(max_size=300), max_size=5))
def test_noise_never_raises_and_does_not_accumulate(chunks):
    decoder = MspDecoder()
    for chunk in chunks:
        decoder.feed(chunk)
    for _ in range(3):
        # An announced frame may wait for as many bytes as its size says.
        decoder.feed(bytes(300))
    assert decoder.feed(reply(2, b"BTFL")) == [(2, b"BTFL")]


def test_a_damaged_frame_is_dropped_and_the_next_one_is_found():
    damaged = bytearray(reply(messages.RC, bytes(12)))
    damaged[8] ^= 1
    decoder = MspDecoder()
    assert decoder.feed(bytes(damaged) + reply(2, b"BTFL")) == [(2, b"BTFL")]
    assert decoder.counters.bad_checksums == 1


def test_a_refused_request_is_counted():
    decoder = MspDecoder()
    assert decoder.feed(reply(199, b"", b"!")) == [] and decoder.counters.refused == 1
