"""NMEA sentences become fixes; damaged ones are dropped and counted."""

import math

import pytest
from gps_cog.nmea import NmeaDecoder
from hypothesis import given
from hypothesis import strategies as st

from tests.cogs.gps_cog.frames import ALTITUDE_M, SPEED_M_S, nmea_epoch, sentence, state_at


def fixes_of(data, decoder=None):
    return list((decoder or NmeaDecoder()).feed(data))


def flight(seconds):
    return b"".join(nmea_epoch(step / 10) for step in range(seconds * 10))


def test_a_flight_is_one_fix_for_each_time_with_all_values():
    decoder = NmeaDecoder()
    found = fixes_of(flight(6), decoder)
    assert len(found) == 60
    fix, truth = found[-1], state_at(5.9)
    assert (fix.kind, fix.satellites, fix.pdop) == ("3d", 11, 1.4)
    assert fix.stamp_s == pytest.approx(36005.9)
    assert fix.latitude_deg == pytest.approx(truth.latitude_deg, abs=2e-7)
    assert fix.longitude_deg == pytest.approx(truth.longitude_deg, abs=2e-7)
    assert fix.altitude_m == pytest.approx(ALTITUDE_M + 2.95, abs=0.06)
    assert fix.speed_m_s == pytest.approx(SPEED_M_S, abs=1e-3)
    assert fix.course_deg == pytest.approx(truth.track_deg, abs=0.01)
    assert fix.accuracy_m == pytest.approx(1.0)
    assert found[0].accuracy_m == pytest.approx(2.0), "of HDOP, before the first GST"
    assert set(+decoder.counters) == set()


@pytest.mark.parametrize(
    ("given", "kind"),
    [
        ({"quality": 1}, "3d"),
        ({"quality": 2}, "dgps"),
        ({"quality": 4}, "rtk"),
        ({"quality": 0, "status": "V"}, None),
        ({"quality": 1, "status": "V"}, None),
        ({"quality": 1, "mode": "E"}, None),
        ({"quality": 6}, None),
        ({"quality": 8}, None),
    ],
)
def test_only_what_is_measured_is_a_fix(given, kind):
    found = fixes_of(nmea_epoch(1.0) + nmea_epoch(1.1, **given))
    assert found[-1].kind == kind


def test_a_receiver_that_sends_one_of_the_two_has_fixes():
    rmc = [part for part in flight(1).split(b"\r\n") if part[3:6] == b"RMC"]
    found = fixes_of(b"\r\n".join(rmc) + b"\r\n")
    assert [round(each.stamp_s - 36000, 2) for each in found] == pytest.approx(
        [each / 10 for each in range(1, 10)]
    )
    assert {each.kind for each in found} == {"2d"} and found[0].altitude_m is None


@pytest.mark.parametrize(
    ("line", "counter"),
    [
        (b"$GNGGA,100000.00,5000.0,N,01430.0,E,1,11,0.8,300,M,,M,,*00\r\n", "checksum"),
        (b"$GNGGA,100000.00,5000.0,N\r\n", "noise"),
        (b"\xff\xfe\x00 no sentence\n", "noise"),
        (b"$GNGGA," + b"1" * 300 + b"\r\n", "noise"),
        (sentence("GNGGA,996199.00,5000.0,N,01430.0,E,one,11,0.8,300,M,,M,,"), "invalid"),
    ],
)
def test_a_damaged_sentence_is_counted_and_the_next_fix_is_found(line, counter):
    decoder = NmeaDecoder()
    found = fixes_of(nmea_epoch(0.0) + line + nmea_epoch(0.1), decoder)
    assert len(found) == 2
    assert (+decoder.counters) == {counter: 1}


@given(at=st.integers(0, 2000), cut=st.integers(0, 80), noise=st.binary(max_size=40),
       pieces=st.lists(st.integers(1, 200), max_size=30))  # fmt: skip
def test_damage_anywhere_costs_the_fixes_around_it(at, cut, noise, pieces):
    data = flight(2)
    data = data[:at] + noise + data[at + cut :]
    decoder = NmeaDecoder()
    found = []
    for size in pieces:
        found += fixes_of(data[:size], decoder)
        data = data[size:]
    found += fixes_of(data, decoder)
    assert len(found) >= 16
    for fix in found[:-1]:
        if fix.kind:
            assert fix.latitude_deg == pytest.approx(50.0, abs=0.01)


@given(st.text(alphabet="0123456789.,-NEASVnainfe+ ", max_size=90), st.sampled_from(
    ["GNGGA", "GPRMC", "GNGSA", "GNGST"]))  # fmt: skip
def test_any_fields_give_a_valid_command_or_none(fields, kind):
    line = sentence(f"{kind},{fields}")
    for fix in fixes_of(nmea_epoch(0.0) + line + nmea_epoch(0.1) + line):
        command = fix.command(0.1)
        if fix.kind and command:
            numbers = [value for value in command.data.values() if isinstance(value, float)]
            assert all(map(math.isfinite, numbers))
