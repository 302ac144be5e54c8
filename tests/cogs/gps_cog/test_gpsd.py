import json

import pytest
from gps_cog.gpsd import GpsdDecoder
from hypothesis import given
from hypothesis import strategies as st

TPV = {
    "class": "TPV", "device": "/dev/pts/3", "mode": 3, "time": "2026-11-24T10:00:05.900Z",
    "lat": 50.0, "lon": 14.5, "altMSL": 301.5, "alt": 345.0, "eph": 10.0,
    "speed": 12.0, "track": 40.0, "climb": 0.5,
}  # fmt: skip
SKY = {"class": "SKY", "device": "/dev/pts/3", "pdop": 1.4, "uSat": 9}


def fixes_of(*reports, device=""):
    decoder = GpsdDecoder(device)
    lines = [each if isinstance(each, bytes) else json.dumps(each).encode() for each in reports]
    return list(decoder.feed(b"\r\n".join(lines) + b"\r\n")), +decoder.counters


def test_a_report_has_all_values():
    (fix,), counters = fixes_of({"class": "VERSION", "release": "3.22"}, SKY, TPV)
    assert (fix.kind, fix.satellites, fix.pdop, fix.accuracy_m) == ("3d", 9, 1.4, 5.0)
    assert (fix.latitude_deg, fix.longitude_deg, fix.altitude_m) == (50.0, 14.5, 301.5)
    assert (fix.speed_m_s, fix.course_deg, fix.climb_m_s) == (12.0, 40.0, 0.5)
    assert fix.stamp_s == pytest.approx(1795514405.9)
    assert not counters


@pytest.mark.parametrize(
    ("change", "kind"),
    [({"mode": 0}, None), ({"mode": 1}, None), ({"mode": 2}, "2d"), ({"mode": True}, None),
     ({"mode": "3"}, None), ({"status": 2}, "dgps"), ({"status": 3}, "rtk"), ({}, "3d")],
)  # fmt: skip
def test_the_kind_of_a_fix(change, kind):
    (fix,), _ = fixes_of({**TPV, **change})
    assert fix.kind == kind


def test_of_several_devices_one_is_followed():
    other = {**TPV, "device": "/dev/pts/4", "lat": 51.0}
    found, _ = fixes_of(other, TPV, {**SKY, "device": "/dev/pts/4"}, TPV, device="/dev/pts/3")
    assert [(fix.latitude_deg, fix.satellites) for fix in found] == [(50.0, None)] * 2
    assert json.loads(GpsdDecoder("/dev/pts/3").watch[7:-2])["device"] == "/dev/pts/3"


def test_a_receiver_that_reports_its_error_is_believed():
    (fix,), _ = fixes_of({"class": "GST", "device": "/dev/pts/3", "lat": 0.6, "lon": 0.8}, TPV)
    assert fix.accuracy_m == pytest.approx(1.0)


def test_noise_is_counted():
    found, counters = fixes_of(b"{", b"[1]", b"[" * 5000, b"\xff", b"{" + b"1" * 20000, TPV)
    assert len(found) == 1 and counters == {"noise": 4}


JSON = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=9),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=3), inner),
    max_leaves=5,
)


@given(st.dictionaries(st.sampled_from([*TPV, "status"]), JSON),
       st.dictionaries(st.sampled_from([*SKY, "satellites"]), JSON))  # fmt: skip
def test_any_report_gives_a_valid_command_or_none(position, sky):
    found, _ = fixes_of({**SKY, **sky, "class": "SKY"}, {**TPV, **position, "class": "TPV"})
    for fix in found:
        if fix.kind is not None:
            fix.command(0.1)
