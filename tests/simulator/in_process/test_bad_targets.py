"""Targets, homes and modes that make no sense, sent over the link to the whole daemon in flight."""

import json

import pytest
from twisted.logger import LogLevel, globalLogPublisher

from tests.support.firmware import build_firmware
from tests.support.tools import need_tool
from up.protocols.general_message import encode
from up_simulator.scenario.build import build_flight
from up_simulator.scenario.file import read_scenario

SCENARIO = {
    "title": "Bad targets",
    "board": "host",
    "duration_s": 300,
    # No position is accurate enough: home is set by a Command only.
    "raspilot": {"runs": "in process", "config": {"navigation.yml": {"home_accuracy_m": 1}}},
    "phone": {},
    "ground": {"role": "operator", "period_ms": 100},
    "sticks": [{"at_s": 0, "mode": "AUTO", "arm": True, "throttle": 0.55}],
    "expect": [{"name": "It stays armed", "signal": "board.armed", "is": True}],
}
STEP_S = 0.002
PLACE = {"latitude": 50.001, "longitude": 14.5}
PLACEHOLDER = "the number"


class Flight:
    """A flight whose ground sends whatever the test wants."""

    def __init__(self, folder):
        need_tool("g++")
        build_firmware()
        path = folder / "flight.yml"
        path.write_text(json.dumps(SCENARIO), encoding="utf-8")
        self.flight = build_flight(read_scenario(path))
        self.ground = self.flight.participants.ground
        self.flight.boot()
        self.fly(4.0)

    def fly(self, duration_s):
        for _ in range(round(duration_s / STEP_S)):
            self.flight.step()
        assert not self.flight.is_over, self.flight.record.failure

    def asked(self, name, **data):
        sent = self.ground.send(name, **data)
        self.fly(0.3)
        return self.ground.answer(sent)

    def refusal(self, name, **data):
        sent = self.ground.send(name, **data)
        self.fly(0.3)
        nack = self.ground.others["up.nack"]
        assert nack["id"] == sent and self.ground.answer(sent)
        return nack["code"], nack["detail"]

    def write(self, name, data, number):
        """Send a line with a number that JSON does not have; return the answer."""
        line = encode(name, data, "raw", self.ground.beacon)
        self.ground._link.send(line.replace(json.dumps(PLACEHOLDER).encode(), number))
        self.fly(0.3)
        return self.ground.answer("raw")

    @property
    def control(self):
        return self.ground.telemetry["flight_control"]

    @property
    def target(self):
        return self.ground.telemetry["navigation"]["target"]


@pytest.fixture(scope="module")
def flown(tmp_path_factory):
    tracebacks = []

    def observe(event):
        if event.get("log_failure") is not None or event["log_level"] is LogLevel.critical:
            tracebacks.append(event)

    globalLogPublisher.addObserver(observe)
    made = Flight(tmp_path_factory.mktemp("bad"))
    try:
        yield made
        assert tracebacks == []
    finally:
        globalLogPublisher.removeObserver(observe)
        made.flight.participants.stop()


@pytest.fixture
def flight(flown):
    """The flight in LOITER, which no bad Command may change."""
    if flown.control["mode"] != "LOITER":
        assert flown.asked("up.flight_mode.set", mode="LOITER") == ""
        flown.fly(0.5)
    before = flown.control["mode"], flown.target
    yield flown
    flown.fly(0.3)
    assert (flown.control["mode"], flown.target) == before
    assert before[0] == "LOITER"


def test_return_is_refused_and_not_offered_until_home_is_set(flight):
    assert flight.control["modes"]["RETURN"] == "no_home"
    assert flight.refusal("up.flight_mode.set", mode="RETURN") == ("refused", "no_home")
    assert (flight.control["selected"], flight.control["mode"]) == ("LOITER", "LOITER")
    assert flight.asked("up.home.set") == ""
    assert flight.control["modes"]["RETURN"] is None


def test_a_mode_without_what_it_needs_is_refused(flight):
    assert flight.control["modes"]["GUIDED"] == "no_target"
    assert flight.refusal("up.flight_mode.set", mode="GUIDED") == ("refused", "no_target")


@pytest.mark.parametrize(
    ("data", "named"),
    [
        ({"latitude": 91, "longitude": 14.5}, "latitude"),
        ({"latitude": 50, "longitude": -180.5}, "longitude"),
        ({"latitude": "50", "longitude": 14.5}, "latitude"),
        ({"latitude": None, "longitude": 14.5}, "latitude"),
        ({"latitude": True, "longitude": 14.5}, "latitude"),
        ({"latitude": [50], "longitude": 14.5}, "latitude"),
        ({"longitude": 14.5}, "latitude"),
        ({**PLACE, "radius": -50}, "radius"),
        ({**PLACE, "radius": 0}, "radius"),
        ({**PLACE, "altitude": 1e300}, "altitude"),
        ({**PLACE, "height": -1}, "height"),
        ({**PLACE, "height": 50, "altitude": 400}, "altitude"),
        ({"latitude": -50.0, "longitude": -165.5}, "km away"),
    ],
)
def test_a_target_out_of_range_is_refused_with_the_field(flight, data, named):
    assert named in flight.asked("up.navigation.target", **data)
    assert flight.asked("up.flight_mode.set", mode="GUIDED") != ""


@pytest.mark.parametrize("number", [b"NaN", b"Infinity", b"-Infinity", b"1e999"])
def test_a_number_that_is_none_does_nothing(flight, number):
    data = {"latitude": PLACEHOLDER, "longitude": 14.5}
    assert flight.write("up.navigation.target", data, number) != ""
    assert flight.write("up.home.set", data, number) != ""


@pytest.mark.parametrize(
    ("data", "named"),
    [
        ({"latitude": 91, "longitude": 14.5}, "latitude"),
        ({"latitude": 50}, "longitude"),
        ({"latitude": -50.0, "longitude": -165.5}, "km away"),
    ],
)
def test_a_home_that_cannot_be_is_refused_and_home_stays(flight, data, named):
    home = flight.ground.telemetry["home"]["latitude"]
    assert named in flight.asked("up.home.set", **data)
    assert flight.ground.telemetry["home"]["latitude"] == home


def test_a_target_that_guided_would_not_fly_to_is_refused(flight):
    far = {"latitude": 50.3, "longitude": 14.5}
    assert flight.refusal("up.navigation.target", **far) == ("refused", "target_too_far")
    assert flight.control["modes"]["GUIDED"] == "no_target"


@pytest.mark.parametrize("mode", ["", "loiter", "LOITERR", "NaN", "AUTO; rm -rf /", "X" * 5000])
def test_an_unknown_mode_is_refused(flight, mode):
    assert flight.asked("up.flight_mode.set", mode=mode)


@pytest.mark.parametrize("altitude", [1e6, -2000, "high"])
def test_an_altitude_that_cannot_be_is_refused(flight, altitude):
    assert "altitude" in flight.asked("up.altitude.change", altitude=altitude, mode="required")
