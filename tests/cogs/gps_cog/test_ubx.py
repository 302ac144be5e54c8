"""NAV-PVT becomes fixes; the set-up reaches receivers of both kinds."""

from itertools import pairwise

import pytest
from gps_cog.ubx import UbxDecoder
from hypothesis import given
from hypothesis import strategies as st

from tests.cogs.gps_cog.frames import SPEED_M_S, state_at, ubx_recording
from up_simulator.sensors.ubx_receiver import NAV_PVT, UbxReceiver, frame

FLIGHT = b"".join(data for _, data in ubx_recording(3))
# From the interface description of the M8: a poll of MON-VER, and its checksum.
MON_VER_POLL = bytes.fromhex("b562 0a04 0000 0e34")


def decoder():
    return UbxDecoder(10, 38400)


def test_the_recording_and_the_description_agree_on_a_frame():
    assert frame((0x0A, 0x04), b"") == MON_VER_POLL


def test_a_flight_is_a_fix_each_tenth_of_a_second_with_all_values():
    recording = ubx_recording(3)
    found = list(decoder().feed(FLIGHT))
    assert len(found) == len(recording) == 29
    stamps = [each.stamp_s for each in found]
    assert [b - a for a, b in pairwise(stamps)] == pytest.approx([0.1] * 28)
    fix, truth = found[-1], state_at(recording[-1][0] - 0.1)
    assert (fix.kind, fix.satellites, fix.pdop, fix.accuracy_m) == ("3d", 12, 1.4, 2.0)
    assert fix.latitude_deg == pytest.approx(truth.latitude_deg, abs=1e-7)
    assert fix.longitude_deg == pytest.approx(truth.longitude_deg, abs=1e-7)
    assert fix.altitude_m == pytest.approx(truth.altitude_m, abs=0.051)
    assert fix.speed_m_s == pytest.approx(SPEED_M_S, abs=0.006)
    assert fix.course_deg == pytest.approx(truth.track_deg, abs=0.06)
    assert fix.climb_m_s == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("offset", "value", "kind"),
    [
        (20, 0, None), (20, 1, None), (20, 2, "2d"), (20, 3, "3d"), (20, 4, "3d"), (20, 5, None),
        (21, 0, None), (21, 0x03, "dgps"), (21, 0x43, "rtk"), (21, 0x81, "rtk"), (78, 1, None),
    ],
)  # fmt: skip
def test_the_kind_of_a_fix(offset, value, kind):
    payload = bytearray(FLIGHT[6:98])
    payload[offset] = value
    (fix,) = decoder().feed(frame(NAV_PVT, bytes(payload)))
    assert fix.kind == kind
    assert (fix.altitude_m is None) == (kind == "2d")


def test_damaged_frames_are_counted_and_cost_no_other():
    reader = decoder()
    one, two = FLIGHT[:100], FLIGHT[100:200]
    damaged = one[:50] + bytes((one[50] ^ 1,)) + one[51:]
    assert len(list(reader.feed(one + damaged + two))) == 2
    assert len(list(reader.feed(one[:60] + two + one))) == 2, "cut"
    assert len(list(reader.feed(b"$GNRMC,1*00\r\n\xb5\xb5" + one + b"\xb5"))) == 1
    assert reader.counters == {"checksum": 2}


@given(at=st.integers(0, 2000), cut=st.integers(0, 150), noise=st.binary(max_size=120),
       pieces=st.lists(st.integers(1, 300), max_size=20))  # fmt: skip
def test_damage_anywhere_costs_the_frames_that_it_touches(at, cut, noise, pieces):
    data = FLIGHT[:at] + noise + FLIGHT[at + cut :]
    reader, found = decoder(), []
    for size in pieces:
        found += reader.feed(data[:size])
        data = data[size:]
    found += reader.feed(data)
    assert 29 - len(found) <= cut // 100 + 2
    assert all(fix.latitude_deg == pytest.approx(50.0, abs=0.01) for fix in found)


@given(st.binary(min_size=92, max_size=92))
def test_any_payload_gives_a_valid_command_or_none(payload):
    for fix in decoder().feed(frame(NAV_PVT, payload)):
        if fix.kind is not None:
            fix.command(0.1)


@pytest.mark.parametrize(("generation", "refused"), [(8, 1), (10, 4)])
def test_the_set_up_reaches_a_receiver_of_either_generation(generation, refused):
    receiver, reader = UbxReceiver(generation=generation), decoder()
    assert list(reader.feed(receiver.feed(reader.set_up))) == []
    assert (receiver.is_set_up, receiver.period_s, receiver.baud_rate) == (True, 0.1, 38400)
    assert reader.counters == {"set_up_refused": refused}
    assert reader.understood == 5
