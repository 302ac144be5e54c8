"""The Java phone flies: a real JVM, in step, and the daemon, in one simulated time."""

import math
import os
import signal

import pytest

from tests.simulator.in_process.flying import Flying
from tests.support.java import java_program
from up_simulator.aircraft.dynamics import Start

METRES_PER_DEG = 111_320.0


@pytest.fixture
def fly(tmp_path):
    program, flown = java_program(), []

    def begin(files=None, folder=tmp_path, **options):
        flown.append(Flying(folder, files, java=program, **options))
        return flown[-1]

    yield begin
    for flying in flown:
        flying.phone.stop()
        flying.raspilot.kill()


def newest(flying, class_name):
    provider = flying.raspilot.module(class_name)
    return provider.usable(provider.MAX_AGE_S)


def test_what_arrives_is_the_truth_within_the_noise(fly):
    """Pressure, rotation and rate have gone through a crooked mounting and back."""
    flying = fly(orientation="udp", start=Start(roll_deg=20, heading_deg=75))
    flying.start()
    flying.board.set_stick("ailerons", 1650)
    flying.fly(1.5)
    assert flying.ground.telemetry["source"]["orientation"] == "arduino"
    # Without the board's own attitude the phone's is what there is.
    flying.board.wires.is_plugged = False
    flying.until(lambda: flying.ground.telemetry["source"]["orientation"] == "android", 2.0)
    found = {name: [] for name in ("roll", "pitch", "yaw", "altitude", "heading", "place", "rate")}

    def look():
        told, truth = flying.ground.telemetry, flying.state
        found["roll"].append(told["orientation"]["roll"] - truth.roll_deg)
        found["pitch"].append(told["orientation"]["pitch"] - truth.pitch_deg)
        found["rate"].append(told["rates"]["roll"] - truth.roll_rate_deg_s)
        found["yaw"].append(shorter(told["orientation"]["yaw"] - truth.yaw_deg))
        found["heading"].append(shorter(told["heading"]["actual"] - truth.yaw_deg))
        found["altitude"].append(told["altitude"] - truth.altitude_m)
        north = (told["location"]["latitude"] - truth.latitude_deg) * METRES_PER_DEG
        east = (told["location"]["longitude"] - truth.longitude_deg) * METRES_PER_DEG
        east *= math.cos(math.radians(truth.latitude_deg))
        found["place"].append(math.hypot(north, east))

    flying.ask("up.telemetry.frequency", frequency=20)
    flying.fly(4.0, look)
    assert flying.state.roll_deg > 8 and flying.state.yaw_deg > 80
    # A frame is up to 20 ms, a reading of GPS 500 ms (at 10 m/s) older than the truth beside it.
    assert max(map(abs, found["roll"])) < 2 and max(map(abs, found["pitch"])) < 2
    assert max(map(abs, found["rate"])) < 15
    assert max(map(abs, found["yaw"])) < 7 and max(map(abs, found["heading"])) < 10
    assert max(map(abs, found["altitude"])) < 2.5
    assert max(found["place"]) < 20
    assert len(set(found["altitude"])) > 10, "it has noise"


def shorter(difference_deg):
    return (difference_deg + 180.0) % 360.0 - 180.0


def test_the_battery_is_what_was_set_and_told_at_once(fly):
    flying = fly()
    flying.start()
    # A level is reported immediately, but not twice within a second.
    flying.fly(1.1)
    flying.phone.set_battery(12)
    flying.until(lambda: flying.ground.telemetry["android"]["batteryLevel"] == 12, 0.5)
    assert any("battery is low: 12 percent" in line for line in flying.raspilot.log)


def test_it_speaks_and_the_answer_travels_back(fly):
    flying = fly()
    flying.start()
    assert flying.ask("android.speak", text="mind the trees") == ""
    assert any("says: 'mind the trees'" in line for line in flying.phone.said)


def test_panic_slows_it_until_it_is_over(fly):
    flying = fly(orientation="off")
    flying.start()
    flying.fly(1.0)

    def sent(duration_s):
        counter = Counter(flying)
        flying.fly(duration_s, counter.look)
        return counter.count

    before = sent(4.0)
    flying.raspilot.meter.load = 100.0
    flying.until(lambda: any("busy: nothing quicker" in line for line in flying.phone.said), 30.0)
    delay_ms = flying.ground.telemetry["load"]["delay_ms"]
    flying.fly(1.0)
    slowed = sent(4.0)
    flying.raspilot.meter.load = 5.0
    flying.until(lambda: any("not busy any more" in line for line in flying.phone.said), 60.0)
    flying.fly(1.0)
    assert before == pytest.approx(20, abs=1)
    assert slowed <= min(20, 4000 / delay_ms) + 1
    assert sent(4.0) == pytest.approx(before, abs=1)


class Counter:
    """Counts the altitudes that come, each of them another one by its noise."""

    def __init__(self, flying):
        self.provider = flying.raspilot.module("UpAltitudeProvider")
        self.count = 0
        self.last = self.value()

    def value(self):
        reading = self.provider.usable(60.0)
        return None if reading is None else reading.value

    def look(self):
        value = self.value()
        self.count += value != self.last
        self.last = value


def test_an_unplugged_phone_is_stale_and_fresh_again_when_it_is_back(fly):
    flying = fly(orientation="udp")
    flying.start()
    flying.fly(1.5)
    names = ("UpAltitudeProvider", "UpHeadingProvider", "UpLocationProvider")
    assert all(newest(flying, name) is not None for name in names)
    flying.phone.unplug()
    providers = [flying.raspilot.module(name) for name in names]
    flying.until(lambda: all(each.usable(1.5) is None for each in providers), 1.6)
    flying.until(lambda: not flying.ground.telemetry["android"]["connected"], 5.0)
    flying.phone.plug()
    flying.until(lambda: all(each.usable(1.5) is not None for each in providers), 5.0)


def test_a_cable_that_tells_ends_its_links_at_once(fly):
    flying = fly()
    flying.start()
    flying.fly(0.5)
    flying.phone.unplug(is_told=True)
    flying.until(lambda: not flying.ground.telemetry["android"]["connected"], 0.3)
    assert any("lost" in line for line in flying.phone.said)


def test_a_jvm_that_is_killed_in_flight_is_a_sentence_and_the_flight_goes_on(fly):
    flying = fly()
    flying.start()
    flying.fly(0.5)
    os.kill(flying.phone.handset.pid, signal.SIGKILL)
    flying.until(lambda: not flying.ground.telemetry["android"]["connected"], 5.0)
    (said,) = [line for line in flying.phone.said if "phone ended by itself" in line]
    assert "with signal 9" in said and said.endswith("the phone is gone, and all else flies on")
    frames = flying.ground.frames
    flying.phone.set_battery(5)
    flying.fly(1.0)
    assert flying.ground.frames > frames


def test_the_same_seed_gives_the_same_flight_twice(fly, tmp_path):
    def flown(number, seed):
        folder = tmp_path / str(number)
        folder.mkdir()
        flying = fly(folder=folder, seed=seed, orientation="udp")
        flying.start()
        flying.fly(1.0)
        flying.phone.unplug()
        flying.fly(2.5)
        flying.phone.plug()
        flying.fly(2.5)
        ended = flying.state, flying.ground.telemetry, flying.phone.said, flying.raspilot.log
        return repr(ended), flying.board.digest.hexdigest()

    first = flown(1, seed=4)
    assert flown(2, seed=4) == first
    assert flown(3, seed=5)[0] != first[0]
