"""Receivers as sources of the location: priorities, faults, ports."""

from itertools import cycle

import pytest
from gps_cog.config import GPS
from gps_cog.fix import GpsFix
from gps_cog.modules.gps_provider import GpsProvider

from tests.cogs.gps_cog.frames import RATE_HZ, nmea_epoch, state_at
from tests.cogs.gps_cog.rig import Aboard, Rig
from up.config import ConfigErrors
from up_simulator.sensors.ubx_receiver import UbxReceiver

TWO_TIMES = cycle((2.0, 2.1))
UBX = "  gps: {{source: ubx, port: {0}/ubx, rate_hz: 10}}\n"
NMEA = "  spare: {{source: nmea, port: {0}/nmea, priority: 10}}\n"


@pytest.fixture
def rig(tmp_path):
    """Return a maker of a rig with receivers of a configuration."""
    made = []

    def make(text):
        made.append(Rig(tmp_path / "config", "receivers:\n" + text.format(tmp_path)))
        return made[-1]

    yield make
    for each in made:
        each.stop()


def ubx(tmp_path, **given):
    twin = UbxReceiver(is_exact=True, **given)
    return Aboard(tmp_path / "ubx", None, twin)


def nmea_at(time_s, late_s=0.2):
    """Return what a receiver of 10 Hz sends at a moment."""
    step = round((time_s - late_s) * 100)
    return nmea_epoch(step / 100) if step >= 0 and step % (100 // RATE_HZ) == 0 else b""


def test_a_fix_is_published_with_its_time_and_quality(rig, tmp_path):
    flight = rig(UBX)
    flight.aboard.append(ubx(tmp_path))
    flight.advance(4.0)
    late = [each for each in flight.heard if each[0] > 2.0]
    assert len(late) in (19, 20, 21)
    for time_s, source, location in late:
        truth = state_at(time_s - location.age_ms / 1000)
        assert source == "gps" and location.age_ms == pytest.approx(100, abs=15)
        assert location.latitude_deg == pytest.approx(truth.latitude_deg, abs=5e-6)
        assert (location.fix, location.satellites, location.pdop) == ("3d", 12, 1.4)
    content = flight.up.telemetry_controller.collect()
    assert content["source"]["location"] == "gps"
    assert content["location"]["fix"] == "3d" and content["location"]["accuracy"] == 2.0
    assert content["gps"]["gps"]["satellites"] == 12


@pytest.mark.parametrize("generation", [8, 10])
def test_a_receiver_is_found_at_its_speed_and_set_up(rig, tmp_path, generation):
    flight = rig(UBX.replace("rate", "baud_rate: 115200, rate"))
    flight.aboard.append(ubx(tmp_path, generation=generation))
    flight.advance(9.0)
    assert flight.aboard[0].twin.baud_rate == 115200 == flight.opened[-1][1]
    assert flight.aboard[0].twin.period_s == 0.1
    assert flight.source == "gps"
    count = len(flight.opened)
    flight.advance(6.0)
    assert len(flight.opened) == count, "it stays there"


def test_an_nmea_receiver_is_followed_at_its_speed(rig, tmp_path):
    flight = rig(NMEA.replace("priority", "baud_rate: 57600, priority"))
    spare = Aboard(tmp_path / "nmea", lambda time_s: b"")
    flight.aboard.append(spare)
    right = [(str(spare.path), 9600)]
    spare.send = lambda t: nmea_at(t) if flight.opened[-1:] == right else b"\xff" * 9
    flight.advance(7.0)
    assert flight.opened[-1:] == right and flight.source == "spare"


def test_the_phone_takes_over_and_back_while_the_receiver_is_unplugged(rig, tmp_path):
    flight = rig(UBX)
    flight.aboard.append(ubx(tmp_path))
    flight.has_phone = True
    flight.advance(4.0)
    assert flight.source == "gps"
    flight.aboard[0].unplug()
    flight.advance(3.0)
    assert flight.source == "android"
    flight.aboard[0].plug()
    flight.advance(4.0)
    assert flight.source == "gps"


def test_of_two_receivers_the_higher_priority_is_followed_and_then_the_other(rig, tmp_path):
    flight = rig(UBX + NMEA)
    flight.aboard += [ubx(tmp_path), Aboard(tmp_path / "nmea", nmea_at)]
    flight.has_phone = True
    flight.advance(4.0)
    assert {source for _, source, _ in flight.heard} == {"gps", "spare", "android"}
    assert flight.source == "gps"
    flight.aboard[0].unplug()
    flight.advance(3.0)
    assert flight.source == "spare"
    flight.aboard[1].unplug()
    flight.advance(3.0)
    assert flight.source == "android"


def test_a_receiver_without_a_fix_gives_none(rig, tmp_path):
    flight = rig(UBX)
    flight.aboard.append(ubx(tmp_path, cold_s=4.0))
    flight.has_phone = True
    flight.advance(3.0)
    assert flight.source == "android" and flight.counters()["no_fix"] > 10
    assert flight.up.telemetry_controller.collect()["gps"]["gps"]["fix"] == "none"
    flight.advance(4.0)
    assert flight.source == "gps"
    flight.aboard[0].twin.set_state("lost")
    flight.advance(4.0)
    assert flight.source == "android"


@pytest.mark.parametrize(
    ("spoil", "counter"),
    [
        (lambda data: data.replace(b",N,", b",S,"), "checksum"),
        (lambda data: data[::2], "noise"),
        # The same characters: the checksum is right.
        (lambda data: data.replace(b",0.6,0.8,", b",60.,80.,"), "inaccurate"),
        (lambda data: nmea_epoch(next(TWO_TIMES)) if data else b"", "past"),
        (lambda data: data.replace(data[7:16], b"") if data else b"", "checksum"),
        (lambda data: b"", None),
    ],
)
def test_a_receiver_that_cannot_be_used_lets_the_phone_take_over(rig, tmp_path, spoil, counter):
    flight = rig(NMEA)
    flight.aboard.append(Aboard(tmp_path / "nmea", nmea_at))
    flight.has_phone = True
    flight.advance(3.0)
    assert flight.source == "spare"
    flight.aboard[0].send = lambda time_s: spoil(nmea_at(time_s))
    flight.advance(4.0)
    assert flight.source == "android"
    if counter:
        assert flight.counters("spare")[counter] > 10


def test_a_receiver_that_claims_the_point_zero_has_no_position():
    assert GpsFix("3d", 1.0, 0.0, 0.0).command(0.1) is None
    assert GpsFix("3d", 1.0, 0.0, 9.5).command(0.1).longitude_deg == 9.5


def test_an_inaccurate_fix_is_dropped(rig, tmp_path):
    flight = rig(UBX.replace("rate", "max_accuracy_m: 1.5, rate"))
    flight.aboard.append(ubx(tmp_path))
    flight.advance(3.0)
    assert not flight.heard and flight.counters()["inaccurate"] > 10


def test_without_a_receiver_the_module_is_not_loaded(tmp_path):
    module = GpsProvider()
    module.bind(type("Context", (), {"config": lambda self, file: file.cls()})())
    assert not module.load()


@pytest.mark.parametrize(
    "text",
    [
        "receivers: {Main: {}}\n",
        "receivers: {a: {port: /dev/ttyUSB0}, b: {port: /dev/ttyUSB0}}\n",
        "receivers: {a: {rate_hz: 20}}\n",
        "receivers: {a: {source: sirf}}\n",
    ],
)
def test_what_cannot_be_meant_is_refused(text):
    with pytest.raises(ConfigErrors):
        GPS.parse(text, GPS.filename)
