"""A million wounded frames and a hundred thousand wounded messages."""

import random

import pytest

from tests.up.protocols.golden import FROM_ARDUINO, vectors
from up.protocols.checked_framing import CheckedDecoder
from up.protocols.general_message import MalformedMessage, decode, encode
from up.protocols.thesis_framing import ThesisDecoder

MUTATIONS = 1_000_000
# Each wounded frame that reaches the CRC passes it by 1 in 65536; 15 are to be expected, more
# than 40 come once in ten million runs.
CRC_BOUND = 40


def wound(wire, draw):
    """Return `wire` with bits flipped, or bytes lost, inserted or changed."""
    wounded = bytearray(wire)
    kind = draw & 3
    draw >>= 2
    for _ in range(1 + (draw & 3)):
        draw >>= 2
        place = (draw & 0xFF) % len(wounded)
        draw >>= 8
        value = draw & 0xFF
        draw >>= 8
        if kind == 0:
            wounded[place] ^= 1 << (value & 7)
        elif kind == 1 and len(wounded) > 1:
            del wounded[place]
        elif kind == 2:
            wounded.insert(place, value)
        else:
            wounded[place] = value
    return bytes(wounded)


@pytest.mark.slow
def test_a_wounded_frame_is_not_accepted_and_takes_at_most_one_good_one_along():
    draws = random.Random(20160501)
    wires = [
        bytes.fromhex(vector["wire"])
        for vector in vectors("serial_checked.json")
        if vector["direction"] == "from_arduino" and len(vector["wire"]) < 70
    ]
    before, behind, last = (bytes.fromhex(wire) for wire in GOOD)
    line = CheckedDecoder(FROM_ARDUINO)
    expected = line.feed(before + behind + last)
    accepted = most_lost = 0
    for number in range(MUTATIONS):
        wire = wires[number % len(wires)]
        wounded = wound(wire, draws.getrandbits(76))
        frames = line.feed(before + wounded + behind + last)
        if frames == expected:
            continue
        good = [frame for frame in frames if frame in expected]
        most_lost = max(most_lost, len(expected) - len(good))
        if len(frames) > len(good) and (wounded != wire and wire not in wounded + b"\0"):
            accepted += 1
        assert frames[0] == expected[0]
        assert frames[-1] == expected[-1]
    assert most_lost <= 1
    assert 0 < accepted <= CRC_BOUND


# Three frames `K` with their own sequences, by the vectors' own road.
GOOD = ("073e4b6107afd300", "087321610708176600", "06a86d66a9b700")


@pytest.mark.slow
def test_wounded_thesis_frames_harm_nothing_beyond_the_silence():
    draws = random.Random(20170501)
    good = bytes.fromhex("7205dc05dc03e805dc")
    line = ThesisDecoder(FROM_ARDUINO)
    for number in range(MUTATIONS // 10):
        now = float(number)
        line.feed(wound(good * 3, draws.getrandbits(76)), now)
        line.expire(now + 0.2)
        assert line.feed(good, now + 0.3) == [(0x72, good[1:], 0)]


@pytest.mark.slow
def test_a_wounded_message_is_read_or_refused_and_nothing_else():
    draws = random.Random(20170720)
    lines = [
        vector["line"].encode()
        for name in ("general_message.json", "general_message_read.json")
        for vector in vectors(name)
    ]
    tokens = [b'"', b"{", b"}", b"[", b"\\u", b"NaN", b"1e999", b"\xff", b"\\", b"null", b",", b":"]
    read = 0
    for number in range(MUTATIONS // 10):
        wounded = wound(lines[number % len(lines)], draws.getrandbits(76))
        if number % 3 == 0:
            place = draws.randrange(len(wounded))
            wounded = wounded[:place] + draws.choice(tokens) + wounded[place:]
        try:
            message = decode(wounded)
        except MalformedMessage as fault:
            assert fault.reason
            assert fault.id is None or 1 <= len(fault.id) <= 64
        else:
            read += 1
            again = encode(message.name, message.data, message.id, message.beacon)
            assert decode(again) == message
    assert 0 < read < MUTATIONS // 10
