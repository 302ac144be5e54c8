"""The Java phone's readings at the real daemon: found by Discovery, right in telemetry."""

import itertools
import time

import pytest

from tests.android.console_program import ConsoleProgram, number_in
from tests.android.numbered_motion import numbers_of
from tests.android.phone_program import ALTITUDE_M, FIX, PhoneProgram
from tests.android.real_daemon import RealDaemon
from tests.support.waiting import until

FRAMES = 200
ORIENTATION = "up.orientation.update"


@pytest.fixture
def daemon(tmp_path):
    made = RealDaemon(tmp_path / "daemon")
    yield made
    made.end()


def test_a_phone_finds_the_daemon_by_discovery_and_all_readings_arrive(daemon):
    place = (*daemon.place_at("192.0.2.1"), "--discover", f"127.0.0.1:{daemon.ports.discovery}")
    with PhoneProgram(*place) as phone:
        phone.until(lambda: phone.all("notice"), "a notice without an answer")
        assert phone.all("notice")[0]["code"] == "not_found"
        ground = daemon.start()
        assert phone.connected() == {
            "event": "connected", "host": "127.0.0.1",
            "general": daemon.ports.general, "orientation": daemon.ports.orientation,
        }  # fmt: skip
        ground.sees(
            "location and battery",
            location__latitude=FIX["latitude"],
            location__longitude=FIX["longitude"],
            location__altitude=FIX["altitude"],
            location__satellites=9,
            android__batteryLevel=87,
            android__connected=True,
        )
        ground.comes("altitude", ALTITUDE_M, 0.1)
        ground.sees("sources", source__altitude="android", source__heading="android")
        assert ground.at("source.location") == "android"
        # The heading is sent after the rotation was read: it turns here all the time.
        phone.is_turning = False
        wanted = phone.number * 91 % 719 / 2
        ground.comes("heading.actual", wanted, 0.1)
        assert ground.at("source.orientation") != "android", "orientation is off by default"
        # Changes are reported.
        phone.readings["battery"] = 41
        phone.readings["fix"] = {**FIX, "latitude": 50.1}
        ground.sees("the change", location__latitude=50.1, android__batteryLevel=41)
        assert ground.at("counters.core.nacks") in (None, 0)
        assert "nack_received" not in [each["code"] for each in phone.all("notice")]


@pytest.mark.parametrize(("transport", "hz"), [("tcp", 200), ("udp", 50)])
def test_every_attitude_that_arrives_is_one_that_the_sensors_said(daemon, transport, hz):
    ground = daemon.start()
    options = ("--orientation", transport, "--orientation-hz", hz)
    direct = ("--direct", f"127.0.0.1:{daemon.listener_port}", "--seat", "listen")
    with PhoneProgram(*daemon.place, *options) as phone, ConsoleProgram(*direct) as console:
        phone.connected()
        console.until(lambda: console.number() is not None, "an attitude")
        assert ground.ask("up.telemetry.frequency", frequency=20) == ""

        def frames():
            return ground.at("counters.android.orientation_frames") or 0

        begun, begun_s = until(frames, "frames"), time.monotonic()
        until(lambda: frames() >= begun + FRAMES, "frames enough")
        took_s = time.monotonic() - begun_s
        assert (frames() - begun) / (took_s + 0.2) < hz * 1.15, "not more than was asked for"
        assert ground.at("counters.android.orientation_dropped") == 0
        assert ground.at("source.orientation") == "android"
        # The phone stands still, and the display equals the sensors' readings.
        phone.is_turning = False
        console.until(lambda: console.number() == phone.number, "the newest attitude")
        shown = [number_in(frame) for frame in console.frames]
        said = phone.number
    seen = [number for number in shown if number is not None]
    assert seen == sorted(seen) and len(set(seen)) > 10
    assert daemon.end() == 0
    numbers = numbers_of(daemon.log_of(ORIENTATION))
    assert len(numbers) >= FRAMES
    assert all(b - a >= 0 for a, b in itertools.pairwise(numbers)), "none overtakes another"
    assert max(numbers) == said
    print(f"{transport} {hz} Hz: {FRAMES / took_s:.0f} a second, {len(set(numbers))} of {said}")
