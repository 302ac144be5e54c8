"""The phone's messages and answers, in virtual time."""

import json
import math
import struct
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from twisted.internet.task import Clock

from tests.simulator.bench import StillFlight
from tests.simulator.pi import vectors
from up_simulator.aircraft.truth import record_of, truth_of
from up_simulator.phone.phone import Phone, write_orientation
from up_simulator.phone.sensors import PhoneSensors

TICK_S = 0.005


class Bench:
    def __init__(self, **options):
        self.clock, self.flight, self.logged, self.lines = Clock(), StillFlight(), [], []
        self.frames = []
        self.phone = Phone(self.flight, self.clock, log=self.log, **options)
        self.phone.connected(self.lines.append)

    def log(self, _text, /, *, code="", **fields):
        self.logged.append((code, fields))

    def run(self, duration_s):
        for _ in range(round(duration_s / TICK_S)):
            self.phone.tick()
            self.clock.advance(TICK_S)
            self.flight.state = replace(self.flight.state, time_s=self.flight.state.time_s + TICK_S)

    def take(self, name=None):
        messages = [json.loads(line) for line in self.lines]
        self.lines.clear()
        return [each for each in messages if name in (None, each["name"])]

    def receive(self, **fields):
        self.phone.line_received(json.dumps(fields).encode())
        return self.take()


@pytest.mark.parametrize(
    "vector", [each for each in vectors("orientation_forward.json") if each["values"]]
)
def test_orientation_frames_are_those_of_the_vectors(vector):
    flight = StillFlight()
    names = ("roll_deg", "pitch_deg", "yaw_deg")
    rates = ("roll_rate_deg_s", "pitch_rate_deg_s", "yaw_rate_deg_s")
    fields = {name: getattr(flight.state, name) for name in flight.state.__slots__}
    fields.update(zip(names + rates, vector["values"], strict=True))
    assert write_orientation(type(flight.state)(**fields)).hex() == vector["wire"]


def test_everything_is_sent_immediately_and_then_periodically():
    bench = Bench()
    bench.run(TICK_S)
    names = [each["name"] for each in bench.take()]
    assert names == [
        "up.altitude.change",
        "up.heading.change",
        "android.battery",
    ]
    bench.run(60.0)
    names = [each["name"] for each in bench.take()]
    assert [names.count(name) for name in sorted(set(names))] == [6, 300, 300, 60]


def test_the_truth_is_recorded_on_request_and_slowed_by_panic():
    def records(messages):
        return [each for each in messages if each["name"] == "black_box.record"]

    silent, bench = Bench(), Bench(record=record_of)
    silent.run(1.0)
    assert records(silent.take()) == []
    bench.run(10.0)
    found = records(bench.take())
    assert len(found) == 200
    state = replace(bench.flight.state, time_s=0.0)
    assert found[0]["data"] == {"topic": "simulator.truth", "content": truth_of(state)}
    assert found[0]["data"]["content"]["roll_deg"] == state.roll_deg
    assert found[0]["data"]["content"]["ground_speed_m_s"] == state.speed_m_s
    bench.receive(name="up.panic", data={"panic": True, "delay_ms": 500})
    bench.run(1.0)
    bench.take()
    bench.run(10.0)
    assert len(records(bench.take())) == 20


def test_values_that_are_not_numbers_are_omitted_from_the_log():
    state = replace(StillFlight().state, roll_deg=math.nan, alpha_deg=math.inf)
    content = truth_of(state)
    assert "roll_deg" not in content and "alpha_deg" not in content


def test_the_first_message_of_each_connection_identifies_the_phone():
    bench = Bench(identity="0badcafe")
    bench.run(1.0)
    bench.phone.disconnected()
    bench.phone.connected(bench.lines.append)
    bench.run(1.0)
    ids = [each["id"] for each in bench.take()]
    assert ids[0] == "0badcafe.1"
    assert [each for each in ids if each] == ["0badcafe.1", "0badcafe.2"]


def test_a_refusal_is_logged():
    bench = Bench()
    bench.receive(name="up.nack", data={"id": "1.1", "code": "taken", "reason": "another phone"})
    refusal = {"refusal": "taken", "reason": "another phone"}
    assert bench.logged == [("phone_refused", refusal)]


def test_measurements_are_near_the_truth_but_not_the_truth():
    bench = Bench()
    bench.run(300.0)
    messages = bench.take()
    by_name = {}
    for each in messages:
        by_name.setdefault(each["name"], []).append(each["data"])
    places = by_name["up.location.update"]
    north_m = [(each["latitude"] - 50.0) * 111_320 for each in places]
    assert 0.3 < max(map(abs, north_m)) < 12.0
    assert abs(sum(north_m) / len(north_m)) < 2.0
    assert all(abs(each["altitude"] - 650.0) < 20.0 for each in places)
    assert all(each["accuracy"] > 0 and 0 <= each["bearing"] < 360 for each in places)
    assert all(abs(each["speed"] - 9.0) < 1.8 for each in places)
    assert all(abs(each["altitude"] - 650.0) < 3.0 for each in by_name["up.altitude.change"])
    headings = by_name["up.heading.change"]
    assert all(each["mode"] == "actual" and abs(each["heading"] - 10.5) < 10 for each in headings)
    assert len({each["heading"] for each in headings}) > 10


def test_the_battery_falls():
    bench = Bench()
    bench.run(TICK_S)
    assert bench.take("android.battery")[0]["data"] == {"level": 95}
    state = bench.flight.state
    fields = {name: getattr(state, name) for name in state.__slots__} | {"time_s": 3000.0}
    bench.flight.state = type(state)(**fields)
    bench.run(10.1)
    assert bench.take("android.battery")[0]["data"] == {"level": 65}


def test_speech_is_logged_and_acknowledged():
    bench = Bench()
    (answer,) = bench.receive(name="android.speak", data={"text": "Hej\nhou"}, id="abc")
    assert answer == {"name": "up.ack", "data": {"id": "abc"}, "id": None}
    assert bench.logged == [("phone_speech", {"speech": "Hej\nhou"})]
    assert bench.receive(name="android.speak", data={"text": "no id"}) == []


@pytest.mark.parametrize("text", ["", "x" * 201, None, 7])
def test_invalid_speech_is_refused(text):
    bench = Bench()
    (answer,) = bench.receive(name="android.speak", data={"text": text}, id="abc")
    assert answer["name"] == "up.nack"
    assert answer["data"]["code"] == "invalid"
    assert bench.logged == []


def test_an_unknown_command_is_refused_and_telemetry_ignored():
    bench = Bench()
    (answer,) = bench.receive(name="android.dance", data={}, id=7)
    assert answer["data"]["code"] == "unknown"
    assert answer["data"]["id"] == "7"
    assert bench.receive(name="up.telemetry.update", data={}, id="t", beacon=1) == []
    assert bench.receive(name="up.ack", data={"id": "x"}, id="y") == []


@pytest.mark.parametrize("name", ["up.panic", "load_guard.panic"])
def test_panic_slows_every_faster_stream(name):
    bench = Bench()
    bench.phone.send_orientation = bench.frames.append
    bench.run(1.0)
    bench.receive(name=name, data={"panic": True, "delay_ms": 400, "utilization": 91.5})
    bench.run(1.0)
    bench.take()
    bench.frames.clear()
    bench.run(8.0)
    names = [each["name"] for each in bench.take()]
    assert names.count("up.altitude.change") == 20
    assert names.count("up.heading.change") == 20
    assert 7 <= names.count("up.location.update") <= 8
    assert len(bench.frames) == 20
    bench.receive(name=name, data={"panic": False, "delay_ms": 50})
    bench.run(1.0)
    bench.take()
    bench.frames.clear()
    bench.run(8.0)
    assert len(bench.take("up.altitude.change")) == 40
    assert len(bench.frames) == 400


@pytest.mark.parametrize(
    "data",
    [{}, {"panic": True}, {"panic": 1, "delay_ms": 5}, {"panic": True, "delay_ms": "1"},
     {"panic": True, "delay_ms": -1}, {"panic": True, "delay_ms": 10_001},
     {"panic": True, "delay_ms": True}],
)  # fmt: skip
def test_an_invalid_panic_changes_nothing(data):
    bench = Bench()
    (answer,) = bench.receive(name="up.panic", data=data, id="p")
    assert answer["data"]["code"] == "invalid"
    assert bench.phone.panic_s == 0.0


def test_a_lost_link_ends_panic_mode_and_sending():
    bench = Bench()
    bench.receive(name="up.panic", data={"panic": True, "delay_ms": 1000})
    bench.phone.disconnected()
    bench.run(5.0)
    assert bench.lines == []
    bench.phone.connected(bench.lines.append)
    bench.run(2.0)
    assert len(bench.take("up.altitude.change")) == 10


@given(st.binary(max_size=120))
def test_the_phone_survives_any_line(line):
    bench = Bench()
    bench.phone.line_received(line)
    bench.take()
    bench.run(TICK_S)
    assert len(bench.take()) == 3


def test_orientation_is_24_bytes_at_50_hz():
    bench = Bench()
    bench.phone.send_orientation = bench.frames.append
    bench.run(2.0)
    assert len(bench.frames) == 100
    assert struct.unpack(">6f", bench.frames[0]) == (3.25, -5.5, 10.5, 0.5, -0.25, 1.0)


class Gps:
    """The sensors of a phone that flies 111 m a second to the north, and its fixes."""

    def __init__(self, seed=1):
        self.sensors = PhoneSensors(seed)
        self.time_s = 0.0

    def fly(self, duration_s):
        """Return the fixes, each with the time at which it came and the one it is of."""
        found = []
        for _ in range(round(duration_s / 0.1)):
            self.time_s += 0.1
            latitude_deg = 50 + self.time_s / 1000
            state = replace(StillFlight().state, time_s=self.time_s, latitude_deg=latitude_deg)
            fix = self.sensors.location(state)
            if fix is not None:
                found.append((self.time_s, (fix["latitude"] - 50) * 1000, fix))
        return found


@pytest.mark.parametrize("seed", range(5))
def test_a_fix_comes_once_a_second_with_the_delay_of_the_seed_and_says_how_old_it_is(seed):
    gps = Gps(seed)
    assert 0.3 <= gps.sensors.gps_delay_s <= 1.5
    fixes = gps.fly(60)
    assert 57 <= len(fixes) <= 60
    for came_s, _, fix in fixes:
        assert fix["age_ms"] / 1000 == pytest.approx(gps.sensors.gps_delay_s, abs=0.5)
        taken_s = came_s - fix["age_ms"] / 1000
        assert taken_s % 1.0 == pytest.approx(0.1, abs=1e-3)
    # 10 m are 0.09 s here.
    assert max(abs(came - fix["age_ms"] / 1000 - at) for came, at, fix in fixes) < 0.12
    assert len({fix["age_ms"] for *_, fix in fixes}) > 1, "the delay has jitter"


def test_an_exact_receiver_has_no_error_and_a_fix_at_each_of_its_periods():
    gps = Gps()
    gps.sensors.use_receiver(0.1)
    fixes = gps.fly(5)
    assert len(fixes) >= 48
    for came_s, at_s, fix in fixes:
        assert fix["age_ms"] == 200
        # The latitude is rounded to 1 cm, which is 0.1 ms here.
        assert at_s == pytest.approx(came_s - 0.2, abs=2e-4)
    assert gps.sensors.wander_m == (0.0, 0.0, 0.0)


def test_without_a_barometer_the_phone_sends_no_altitude():
    bench = Bench()
    bench.phone.sensors.has_barometer = False
    bench.run(2.0)
    assert not bench.take("up.altitude.change")
    bench.run(2.0)
    assert bench.take("up.heading.change")


def test_a_gps_is_lost_jumps_and_freezes():
    gps = Gps()
    gps.fly(5)
    gps.sensors.gps = "lost"
    gps.fly(2)
    assert not gps.fly(5)
    gps.sensors.gps = "jumped"
    gps.fly(2)
    # 300 m are 2.7 s here.
    for came_s, at_s, fix in gps.fly(4):
        assert at_s - (came_s - fix["age_ms"] / 1000) == pytest.approx(2.7, abs=0.2)
    gps.sensors.gps = "frozen"
    gps.fly(2)
    frozen = gps.fly(5)
    assert len({at for _, at, _ in frozen}) == 1 and len(frozen) >= 4
    gps.sensors.gps = "back"
    gps.fly(2)
    assert len({at for _, at, _ in gps.fly(5)}) >= 4


def test_without_satellites_only_the_fix_is_missing():
    bench = Bench()
    bench.run(1)
    bench.take()
    bench.phone.sensors.gps = "lost"
    bench.run(2)
    names = {each["name"] for each in bench.take()}
    assert "up.location.update" not in names and "up.altitude.change" in names
    bench.phone.sensors.gps = "back"
    bench.run(3)
    assert bench.take("up.location.update")
