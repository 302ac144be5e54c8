"""Frames beside those of Betaflight's and EdgeTX's own tests."""

import pytest
from crsf_cog.frames import (
    CHANNELS,
    LINK_STATISTICS,
    CrsfDecoder,
    LinkStatistics,
    channels_us,
    crc8,
    frame,
)
from crsf_cog.transmitter import telemetry_frames
from hypothesis import given
from hypothesis import strategies as st

from up.telemetry_frame import Frame

# Betaflight, rx_crsf_unittest: a captured frame (0x00 is replaced by the address), a subset frame.
CAPTURED = bytes.fromhex(
    "C8 18 16 BD089FF4AEF7BDEF7DEFFBADFD452B5A010000000000 6C",
)
SUBSET = bytes.fromhex("C8 09 17 2400A0D9E9FF0F D1")
# EdgeTX, tests/crossfire.cpp, with the same address.
STATISTICS = bytes.fromhex("C8 0C 14 00000000FF01030000 00 F4")
# Betaflight, telemetry_crsf_unittest: its values, packed as it asserts; unknown fuel is all ones.
GPS = bytes.fromhex("C8 11 02 2160EC00 6127D380 024B 39C6 0D11 09 6B")
BATTERY = bytes.fromhex("C8 0A 08 0021 0128 FFFFFF FF 65")
ATTITUDE = bytes.fromhex("C8 08 1E 2E39 65EC 855A 05")
ACRO_DISARMED = bytes.fromhex("C8 08 21 41 43 52 4F 2A 00 14")
ANGLE = bytes.fromhex("C8 07 21 41 4E 47 4C 00 A7")

KNOWN = {
    "orientation": {"roll": 149.5, "pitch": 67.8, "yaw": 180.1},
    "location": {"altitude": 2345.4, "satellites": 9},
    "navigation": {"latitude": 56.0, "longitude": 163.0, "speed": 16.3, "course": 147.9},
    "age_ms": {"orientation": 20, "navigation": 100, "location": 100},
    "arduino": {"flight_battery_v": 3.3, "flight_battery_a": 29.6},
    "flight_mode": "ACRO",
    "armed": False,
}


def test_captured_frames_are_understood():
    (type_, payload), (subset, _), (statistics, _) = CrsfDecoder().feed(
        CAPTURED + SUBSET + STATISTICS
    )
    assert (type_, subset, statistics) == (CHANNELS, 0x17, LINK_STATISTICS)
    # Betaflight's values; its scale differs by less than 1 us.
    assert channels_us(payload)[:4] == pytest.approx([999, 1501, 1492, 1495], abs=1)
    bits = sum(value << 11 * place for place, value in enumerate([172, 992, 1811, 0, 2047]))
    wanted = [988, 1500, 2012, 880, 2159]
    assert channels_us(bits.to_bytes(22, "little"))[:5] == pytest.approx(wanted, abs=1)


def test_link_statistics_are_those_of_the_active_antenna():
    sent = [bytes([92, 105, 88, 0xFB, antenna, 6, 8, 40, 99, 0xFE]) for antenna in (0, 1)]
    assert LinkStatistics.of(sent[0]) == (88, -92, -5, 6, 50, -40, 99, -2)
    assert LinkStatistics.of(sent[1]).rssi_dbm == -105
    assert LinkStatistics.of(bytes([0] * 6 + [99] + [0] * 3)).power_mw is None


def test_telemetry_is_that_of_betaflight_for_the_same_values():
    assert telemetry_frames(Frame(KNOWN)) == ATTITUDE + GPS + BATTERY + ACRO_DISARMED
    assert telemetry_frames(Frame({"flight_mode": "ANGL", "armed": True})) == ANGLE


def test_a_stale_or_unknown_value_is_not_sent():
    old = {**KNOWN, "age_ms": {"orientation": 9000, "navigation": 9000, "location": 9000}}
    assert telemetry_frames(Frame(old)) == BATTERY + ACRO_DISARMED
    assert telemetry_frames(Frame({})) == b""
    position = {"navigation": {"latitude": -1.5, "longitude": -2.0}, "age_ms": {"navigation": 1}}
    ((_, payload),) = CrsfDecoder().feed(telemetry_frames(Frame(position)))
    assert payload[8:] == b"\xff" * 7


def test_a_long_name_keeps_the_star_and_extreme_values_their_frames():
    content = {
        "orientation": {"roll": 1e9, "pitch": -1e9, "yaw": 0},
        "navigation": {"latitude": 90, "longitude": -180, "speed": 1e9, "altitude": -1e9},
        "age_ms": {"orientation": 0},
        "arduino": {"flight_battery_v": 1e9, "flight_battery_a": -1e9},
        "flight_mode": "A_VERY_LONG_NAME\xfc",
    }
    frames = dict(CrsfDecoder().feed(telemetry_frames(Frame(content))))
    assert frames[0x21] == b"A_VERY_LONG_*\0"
    assert frames[0x08] == bytes.fromhex("FFFE 0000 FFFFFFFF")
    assert frames[0x02][8:14] == bytes.fromhex("FFFE FFFF 0000")


@pytest.mark.parametrize(
    ("spoilt", "counter"),
    [
        (CAPTURED[:-1] + b"\x6d", "checksum"),
        (b"\xc8\x01\xc8\x3f\x00", "noise"),
        (frame(CHANNELS, bytes(21)), "invalid"),
        (frame(LINK_STATISTICS, bytes(11)), "invalid"),
    ],
)
def test_bad_bytes_are_counted_and_the_next_frame_is_found(spoilt, counter):
    decoder = CrsfDecoder()
    assert decoder.feed(spoilt + SUBSET) == [(0x17, SUBSET[3:-1])]
    assert decoder.counters[counter] >= 1


frames = st.builds(frame, st.integers(0, 255), st.binary(max_size=60))


@given(st.lists(frames, max_size=5), st.integers(1, 9), st.binary(max_size=40))
def test_frames_are_found_in_pieces_of_any_size_and_no_bytes_raise(sent, size, noise):
    data = b"".join(sent)
    whole, cut = CrsfDecoder(), CrsfDecoder()
    found = [each for at in range(0, len(data), size) for each in cut.feed(data[at : at + size])]
    assert found == whole.feed(data)
    assert len(found) + cut.counters["invalid"] == len(sent)
    whole.feed(noise)
    assert len(whole._tail) <= 64


def test_the_checksum_is_that_of_dvb_s2():
    assert crc8(b"123456789") == 0xBC
