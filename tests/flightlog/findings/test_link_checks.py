"""Faults of the links and of the readings that they deliver."""

from tests.flightlog.flights import (
    PHONE,
    AndroidBatteryLowCommand,
    LinkStateCommand,
    LocationCommand,
    OrientationCommand,
    TelemetryCommand,
)
from tests.flightlog.flights import FlightStateCommand as State
from up_flightlog.findings.all_checks import findings

ARMED = State("FBW", True, False, False)


def test_lost_links(maker, found):
    maker.quiet_flight(40.0, armed=(5, 35))
    for link, lost_s, back_s in (("mission_control", 10, 22), ("android", 6, 36)):
        maker.put(lost_s + 0.01, LinkStateCommand(link, False))
        maker.put(back_s + 0.01, LinkStateCommand(link, True))
    maker.put(31, LinkStateCommand("ground", False))
    assert found() == [(6.0, "warning", "phone_lost", 30.0), (10.0, "warning", "ground_lost", 12.0)]


def test_a_ground_that_leaves_after_landing_is_an_info(maker, found):
    maker.quiet_flight(40.0, armed=(5, 15))
    maker.put(30, LinkStateCommand("mission_control", False))
    assert found() == [(30.0, "info", "ground_lost", 9.9)]


def test_a_refused_phone_with_its_host(maker, only):
    for number, host in enumerate([None, "192.0.2.7", "192.0.2.7", None, 7]):
        maker.put(5.0 + number, TelemetryCommand({"android": {"competitor": host}}, number))
    finding = only()
    assert (finding.time_s, finding.level, finding.length_s) == (1.0, "warning", 2.0)
    assert (finding.code, finding.fields) == ("phone_refused", {"host": "192.0.2.7"})


def test_missing_readings(maker, tmp_path):
    maker.every(0, 30, 0.2, ARMED)
    for begin_s, end_s in ((0, 10), (10.8, 30)):
        maker.every(begin_s, end_s, 0.02, OrientationCommand(1.0, 2.0, 3.0))
    maker.every(0, 12, 1.0, LocationCommand(50.0, 14.0), PHONE)
    maker.every(20, 22, 1.0, LocationCommand(50.0, 14.0), PHONE)
    found = findings(maker.log(tmp_path))
    assert {each.code for each in found} == {"reading_missing"}
    assert [(round(each.time_s, 2), each.level, each.subject) for each in found] == [
        (9.98, "alarm", "attitude"),
        (11.0, "warning", "location"),
        (21.0, "warning", "location"),
    ]
    assert [each.span.is_open for each in found] == [False, False, True]


def test_a_slow_source_is_not_missing(maker, found):
    maker.every(0, 60, 0.5, ARMED)
    maker.every(0, 60, 5.0, LocationCommand(50.0, 14.0), PHONE)
    assert found() == []


def test_low_battery_once(maker, only):
    maker.put(0, AndroidBatteryLowCommand(14.5, True))
    maker.put(1, AndroidBatteryLowCommand(20, False))
    maker.line(0, 4, "AndroidBatteryProvider", "low", code="battery_low", level=14.5)
    finding = only()
    assert (finding.level, finding.code) == ("alarm", "battery_low")
    assert finding.fields == {"level": 14.5}
