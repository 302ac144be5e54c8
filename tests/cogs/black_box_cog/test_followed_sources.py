"""The log has the reading that its provider used, whichever source came first."""

import pytest
from black_box_cog.export.log_track import points_of
from black_box_cog.report.report_data import read_report_data
from twisted.internet.task import Clock

from tests.cogs.black_box_cog.flights import PHONE, Flight
from tests.support.system import build_up
from up.commands.location_command import LocationCommand
from up.commands.origin import Origin
from up.commands.roles import Role
from up.flight_log.flight_log import FlightLog
from up.flight_log.summary import summarise
from up.flight_log.telemetry_frames import frames
from up.flight_log.track_statistics import fixes
from up.providers.up_location_provider import UpLocationProvider

GPS = Origin("gps", Role.SENSOR)
GPS_AWAY_S = (30, 40)
TENTHS = 600
STEP_DEG = 1e-5


@pytest.fixture
def flown(tmp_path):
    """Return the log of a flight with phone and GPS, and the places that the provider used."""
    clock = Clock()
    flight = Flight(tmp_path)
    up = build_up((), clock, tmp_path / "c", config={"providers.yml": "location: [gps, android]\n"})
    up.command_executor.add_observer(flight.queue.observe)
    provider = up.get_module(UpLocationProvider)
    used = []

    def publish(origin, latitude_deg, speed_m_s):
        command = LocationCommand(
            latitude_deg, 14 + STEP_DEG * tenth, altitude_m=300.0, speed_m_s=speed_m_s
        )
        up.command_executor.execute_command(command, origin)
        if provider.reading.value is command:
            used.append((origin.link, command.latitude_deg, command.longitude_deg))

    for tenth in range(TENTHS):
        if tenth % 5 == 0:
            publish(PHONE, 50.001, 10.0)
        if tenth % 2 == 1 and not GPS_AWAY_S[0] <= tenth / 10 < GPS_AWAY_S[1]:
            publish(GPS, 50.0, 20.0)
        clock.advance(0.1)
        flight.pass_s(0.1)
        flight.recorder.work()
    flight.recorder.finish()
    assert [link for link, *_ in used].count("gps") > 200
    return FlightLog.read(flight.files), used


def test_the_track_follows_the_provider(flown):
    log, used = flown
    places = [place for _, *place in used]
    assert [[each.latitude_deg, each.longitude_deg] for each in fixes(log)] == places
    assert [[each.latitude_deg, each.longitude_deg] for each in points_of(log)] == places


def test_the_report_and_the_replay_follow_it_too(flown):
    log, used = flown
    assert list(read_report_data(log).speed.values) == [
        {"gps": 20.0, "android": 10.0}[link] for link, *_ in used
    ]
    # 20 m aside the phone would add 111 m for every change of the source.
    assert summarise(log).track_m < 2 * STEP_DEG * TENTHS * 111_195
    told = {round(each.time_s, 1): each.data["source"]["location"] for each in frames(log)}
    assert (told[20.0], told[38.0], told[50.0]) == ("gps", "android", "gps")
    # Begun in the middle it is the same: the selection was long before.
    first = next(frames(log, since_s=20.0))
    assert first.data["source"]["location"] == "gps"


def test_without_a_selection_the_first_source_is_followed(flown, monkeypatch):
    log, _ = flown
    monkeypatch.setattr("up.flight_log.followed.SELECTED", "some.other")
    assert {each.latitude_deg for each in fixes(log)} == {50.001}
