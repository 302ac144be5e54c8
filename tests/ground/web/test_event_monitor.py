"""Events of an aircraft: each change once, no flood, true ages."""

import copy

import pytest

from tests.ground.aircraft import frame
from up.commands.event_rules import Report
from up.protocols.general_message import GeneralMessage
from up_ground.telemetry import NAME, Telemetry
from up_ground.web.event_monitor import EVENTS_KEPT, EventMonitor
from up_ground.web.event_rules import LinkSnapshot

QUIET = LinkSnapshot(True, "", True, True, False)


class Bench:
    def __init__(self):
        self.told, self.now_s, self.telemetry = [], 100.0, Telemetry()
        self.monitor = EventMonitor("kite", self.told.append)
        self.data = frame()
        self.data["arduino"] |= {"receiver_valid": True, "imu_valid": True}

    def see(self, after_s=0.1, **changes):
        """Take a frame with changes such as `arduino__connected=False`."""
        self.now_s += after_s
        for path, value in changes.items():
            place, steps = self.data, path.split("__")
            for step in steps[:-1]:
                place = place[step]
            place[steps[-1]] = value
        message = GeneralMessage(NAME, copy.deepcopy(self.data))
        self.telemetry.update(message, self.now_s)
        self.monitor.update(self.telemetry, QUIET, self.now_s)
        return self

    def wait(self, for_s, link=QUIET):
        for _ in range(round(for_s / 0.25)):
            self.now_s += 0.25
            self.monitor.update(self.telemetry, link, self.now_s)
        return self

    @property
    def codes(self):
        return [each["code"] for each in self.told if each["type"] == "event"]

    @property
    def alarms(self):
        found = [each["active"] for each in self.told if each["type"] == "alarms"]
        return [[each["kind"] for each in active] for active in found]


@pytest.fixture
def bench():
    return Bench().see()


def test_another_phone_is_an_event_once(bench):
    for competitor in ("192.0.2.7", "192.0.2.7", None, "192.0.2.7"):
        bench.see(android__competitor=competitor)
    (event,) = (each for each in bench.told if each["type"] == "event")
    assert (event["code"], event["fields"]) == ("phone_refused", {"value": "192.0.2.7"})


def test_a_healthy_aircraft_is_no_news(bench):
    for _ in range(50):
        bench.see()
    assert bench.told == []


@pytest.mark.parametrize(
    ("change", "kind", "level", "code", "fields"),
    [
        (
            {"flight_mode": "AUTO"},
            "mode",
            "info",
            "flight_mode",
            {"value": "AUTO", "before": "FBW"},
        ),
        ({"armed": True}, "armed", "warning", "armed", {}),
        ({"arduino__failsafe": True}, "failsafe", "alarm", "failsafe", {}),
        ({"arduino__imu_valid": False}, "source", "alarm", "imu_invalid", {}),
        ({"arduino__connected": False}, "link", "alarm", "board_lost", {}),
        ({"android__connected": False}, "link", "warning", "phone_lost", {}),
        ({"load__panic": True, "load__cpu": 99.4}, "panic", "info", "panic", {}),
        (
            {"vetoes": ["throttle not low"]},
            "veto",
            "info",
            "vetoes",
            {"value": ["throttle not low"]},
        ),
        (
            {"source__location": "gpsd"},
            "source",
            "warning",
            "source_changed",
            {"value": "gpsd", "before": "android"},
        ),
        ({"android__batteryLevel": 15}, "battery", "warning", "battery_low", {}),
        ({"arduino__restored": True}, "source", "alarm", "board_reset", {}),
    ],
)
def test_a_change_is_reported_once_and_immediately(bench, change, kind, level, code, fields):
    bench.see(**change)
    for _ in range(20):
        bench.see()
    (event,) = [each for each in bench.told if each["type"] == "event"]
    assert (event["kind"], event["level"], event["age_ms"]) == (kind, level, 0)
    assert (event["code"], event["fields"]) == (code, fields)
    assert event["aircraft"] == "kite"
    assert event["text"]


def test_what_is_wrong_from_the_beginning_is_told():
    bench = Bench().see(arduino__failsafe=True)
    assert bench.codes == ["failsafe"]
    assert bench.alarms == [["failsafe"]]


def test_a_replaced_mode_is_named_and_its_end_and_its_return_are_events(bench):
    control = {"mode": "CIRCLE", "selected": "LOITER", "fallback": "navigation"}
    over = {"mode": "LOITER", "selected": "LOITER", "fallback": None}
    for each in (over, control, over, control):
        bench.see(after_s=5.0, flight_control=each).wait(3.0)
    assert bench.codes == ["fallback", "fallback_over", "fallback"]
    first = next(each for each in bench.told if each["type"] == "event")
    assert first["text"].startswith("CIRCLE replaces LOITER")


def test_unknown_is_no_change(bench):
    bench.see(flight_mode=None).see(flight_mode=["x"]).see(flight_mode="FBW")
    assert bench.codes == []


def test_an_alarm_begins_at_once_and_ends_a_little_later(bench):
    bench.see(arduino__imu_valid=False)
    assert bench.alarms == [["imu"]]
    bench.see(arduino__imu_valid=True).wait(1.5)
    assert bench.alarms == [["imu"]]
    bench.wait(1.0)
    assert bench.alarms == [["imu"], []]


def test_a_busy_raspberry_pi_is_an_event_and_no_alarm(bench):
    for percent in (99, 85, 91):
        bench.see(load__panic=True, load__cpu=percent).wait(1.0)
    bench.see(load__panic=False).wait(3.0)
    assert bench.codes == ["panic", "panic_over"]
    assert bench.alarms == []


def test_a_battery_that_wavers_is_one_alarm(bench):
    for level in (21, 19, 20, 21, 22, 19, 22.5):
        bench.see(1.0, android__batteryLevel=level)
    assert bench.alarms == [["battery"]]
    bench.see(1.0, android__batteryLevel=24).wait(3)
    assert bench.alarms == [["battery"], []]
    bench.see(1.0, android__batteryLevel=9)
    assert bench.told[-1]["active"][0]["level"] == "alarm"


def test_silence_is_an_alarm_and_news_end_it(bench):
    silent = LinkSnapshot(True, "", True, True, True)
    bench.wait(0.25, silent)
    assert bench.alarms == [["silent"]]
    bench.wait(60, silent)
    assert bench.alarms == [["silent"]]
    bench.see().wait(2.5)
    assert bench.alarms == [["silent"], []]
    assert bench.codes == ["silent", "heard"]


def test_an_unknown_level_ends_the_hysteresis_with_the_alarm(bench):
    bench.see(1.0, android__batteryLevel=19)
    bench.see(1.0, android__batteryLevel=None).wait(3)
    bench.see(1.0, android__batteryLevel=22)
    assert bench.alarms == [["battery"], []]


def test_silence_over_a_lost_link_does_not_blame_the_aircraft(bench):
    bench.wait(3, LinkSnapshot(False, "connection lost", None, True, True))
    assert bench.alarms == [["silent"]]
    assert bench.codes == ["no_link"]


def test_nothing_was_ever_heard_is_no_silence():
    bench = Bench()
    bench.wait(5, LinkSnapshot(True, "", False, False, True))
    assert bench.told == []


@pytest.mark.parametrize("path", ["arduino__failsafe", "arduino__connected", "load__panic"])
def test_what_flaps_for_ten_minutes_is_no_flood(bench, path):
    for number in range(1500):
        bench.see(0.4, **{path: number % 2 == 0})
    assert 2 <= len(bench.codes) <= 40
    assert len(bench.alarms) <= 40


def test_a_link_that_flaps_is_no_flood(bench):
    for number in range(3000):
        is_open = number % 2 == 0
        bench.now_s += 0.3
        link = LinkSnapshot(is_open, "reset", True if is_open else None, True, not is_open)
        bench.monitor.on_link(link, bench.now_s)
        bench.monitor.update(bench.telemetry, link, bench.now_s)
    assert 2 <= len(bench.codes) <= 60
    assert len(bench.alarms) <= 4


def test_a_flap_ends_with_what_is_true(bench):
    for number in range(11):
        bench.see(0.1, armed=number % 2 == 0)
    bench.wait(40)
    assert bench.codes[-1] == "armed"


def test_who_comes_later_hears_what_was_and_how_long_ago(bench):
    bench.see(armed=True)
    bench.wait(10)
    event, alarms = bench.monitor.past(bench.now_s)
    assert event["is_past"] is True
    assert event["age_ms"] == 10_000
    assert alarms["active"] == []


def test_the_past_is_bounded(bench):
    for number in range(1000):
        bench.monitor.report("mark", Report("info", "mark", f"{number}"), bench.now_s)
    past = list(bench.monitor.past(bench.now_s))
    assert len(past) == EVENTS_KEPT + 1
    assert past[-2]["number"] == 1000


def test_telemetry_that_comes_too_late_is_an_alarm(bench):
    late = LinkSnapshot(True, "", True, True, True, is_late=True)
    bench.wait(0.25, late)
    assert bench.codes == ["late"]
    (alarm,) = [each["active"] for each in bench.told if each["type"] == "alarms"][-1]
    assert (alarm["kind"], alarm["code"]) == ("silent", "late")
    bench.wait(3)
    assert bench.codes[-1] == "heard"
