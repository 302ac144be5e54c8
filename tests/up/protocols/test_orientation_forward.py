import math
import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.up.protocols.golden import cut, places, vectors
from up.protocols.orientation_forward import (
    OrientationDecoder,
    OrientationFrame,
    decode_datagram,
    encode,
)


def expected(values):
    """Return what docs/protocols.md 3 makes of six values."""
    angles = all(math.isfinite(value) and abs(value) <= 360 for value in values[:3])
    rates = all(math.isfinite(value) and abs(value) <= 4000 for value in values[3:])
    return [tuple(values)] if angles and rates else []


@pytest.mark.parametrize("vector", vectors("orientation_forward.json"), ids=lambda v: v["wire"])
def test_frames_are_as_the_vectors_say(vector):
    wire = bytes.fromhex(vector["wire"])
    decoder = OrientationDecoder()
    if vector["values"] is None:
        assert decoder.feed(wire) == []
        assert decoder.feed(wire * 3) == []
        assert decoder.dropped == 4
        assert decode_datagram(wire) is None
    else:
        values = tuple(vector["values"])
        assert decoder.feed(wire) == [values]
        assert decode_datagram(wire) == OrientationFrame(*values)
        assert encode(OrientationFrame(*values)) == wire


def test_the_fields_have_the_order_of_the_wire():
    frame = decode_datagram(struct.pack(">6f", 1, 2, 3, 4, 5, 6))
    assert (frame.roll_deg, frame.pitch_deg, frame.yaw_deg) == (1, 2, 3)
    assert (frame.roll_rate_deg_s, frame.pitch_rate_deg_s, frame.yaw_rate_deg_s) == (4, 5, 6)


@pytest.mark.parametrize("size", [0, 1, 23, 25, 48])
def test_a_datagram_of_another_size_is_no_frame(size):
    assert decode_datagram(bytes(size)) is None


NEXT_ABOVE = {360: 0x43B40001, 4000: 0x457A0001}


@pytest.mark.parametrize("field", range(6))
@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("count", [1, 2, 200])
def test_the_limits_are_exact(field, sign, count):
    limit = 360 if field < 3 else 4000
    above = struct.unpack(">f", NEXT_ABOVE[limit].to_bytes(4, "big"))[0]
    for value, is_good in ((limit, True), (above, False), (math.inf, False), (math.nan, False)):
        values = [0.0] * 6
        values[field] = sign * value
        decoder = OrientationDecoder()
        good = struct.pack(">6f", 1, 2, 3, 4, 5, 6) * (count - 1)
        frames = decoder.feed(good + struct.pack(">6f", *values))
        assert len(frames) == count - (not is_good)
        assert decoder.dropped == (not is_good)


floats = st.floats(width=32) | st.sampled_from([360.0, -360.0, 4000.0, 0.0, -0.0])
frames_of_floats = st.lists(st.tuples(floats, floats, floats, floats, floats, floats), max_size=6)


@given(frames_of_floats, places, st.integers(1, 60))
def test_any_chunking_gives_the_same_frames(frames, cuts, repeats):
    frames = frames * repeats
    wire = b"".join(struct.pack(">6f", *values) for values in frames)
    decoder = OrientationDecoder()
    found = []
    for piece in cut(wire, cuts):
        found += decoder.feed(piece)
        assert len(decoder._remainder) < 24
    assert found == [good for values in frames for good in expected(values)]
    assert decoder.dropped == len(frames) - len(found)


@given(st.binary(max_size=200))
def test_any_bytes_become_frames_within_the_limits(data):
    decoder = OrientationDecoder()
    found = decoder.feed(data)
    assert len(found) + decoder.dropped == len(data) // 24
    assert all(expected(values) for values in found)
